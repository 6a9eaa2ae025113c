// OpenMesh: a half-edge mesh. The kernel keeps flat lists of its own instead (docs/solidify.md).
// Trap: its points are floats unless the traits say otherwise: 5403766.115 becomes 5403766.
// Trap: it refuses a third face on an edge, and only the invalid handle says so.
// Trap: after find_package(CGAL) it must be looked up as find_package(OpenMesh CONFIG).
#include <cstdio>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;
using FloatMesh = OpenMesh::PolyMesh_ArrayKernelT<>;

int main() {
  Mesh mesh;
  const auto add = [&](double x, double y, double z) { return mesh.add_vertex({x, y, z}); };
  const auto a = add(0, 0, 5403766.115), b = add(1, 0, 0), c = add(0, 1, 0), d = add(0, -1, 0);
  const auto e = add(0, 0, 1);
  mesh.add_face(a, b, c);
  mesh.add_face(b, a, d);
  const bool is_third_refused = !mesh.add_face(a, b, e).is_valid();

  int boundary = 0;
  for (const auto& edge : mesh.edges()) boundary += edge.is_boundary() ? 1 : 0;

  FloatMesh floats;
  const auto rounded = floats.point(floats.add_vertex(FloatMesh::Point(0.0F, 0.0F, 5403766.115F)));
  std::printf("%d boundary edges; a third face on an edge is %s; as float %.3f, as double %.3f\n",
              boundary, is_third_refused ? "refused" : "taken", static_cast<double>(rounded[2]),
              mesh.point(a)[2]);
  return boundary == 4 && is_third_refused && mesh.point(a)[2] == 5403766.115 ? 0 : 1;
}
