#include "kernel/mesh/hausdorff.h"

#include "kernel/mesh/triangulate.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>

namespace oriel {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// The triangles of all facets, which share no vertices: only where they lie matters.
Mesh mesh_of(const Solid& solid) {
  std::vector<Vec3> points;
  for (const Vertex& vertex : solid.vertices) points.push_back(vertex.point);
  Mesh mesh;
  for (const Facet& facet : solid.facets)
    for (const auto& triangle :
         detail::triangulate(points, facet.loops, solid.planes[facet.plane.index()].normal)) {
      std::array<Mesh::Vertex_index, 3> corners;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 p = points[static_cast<std::size_t>(triangle[i])];
        corners[i] = mesh.add_vertex({p.x, p.y, p.z});
      }
      mesh.add_face(corners[0], corners[1], corners[2]);
    }
  return mesh;
}

}  // namespace

double hausdorff_m(const Solid& a, const Solid& b, double error_m) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  return pmp::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(
      mesh_of(a), mesh_of(b), error_m, CGAL::parameters::match_faces(false),
      CGAL::parameters::match_faces(false));
}

}  // namespace oriel
