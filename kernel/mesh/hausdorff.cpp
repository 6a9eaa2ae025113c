#include "kernel/mesh/hausdorff.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>

namespace oriel {

namespace {

using Surface = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

bool is_of_triangles(const Mesh& mesh) {
  for (int f = 0; f < mesh.faces(); ++f)
    if (mesh.corners(f).size() != 3) return false;
  return true;
}

/// The triangles, which share no vertices: only where they lie matters.
Surface surface_of(const Mesh& mesh) {
  if (!is_of_triangles(mesh)) return surface_of(Mesh(mesh_source(mesh), MeshFaces::triangles));
  Surface surface;
  for (int f = 0; f < mesh.faces(); ++f) {
    std::vector<Surface::Vertex_index> corners;
    for (const int v : mesh.corners(f)) {
      const Vec3 p = mesh.point(v);
      corners.push_back(surface.add_vertex({p.x, p.y, p.z}));
    }
    surface.add_face(corners[0], corners[1], corners[2]);
  }
  return surface;
}

}  // namespace

double hausdorff_m(const Mesh& a, const Mesh& b, double error_m) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  return pmp::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(
      surface_of(a), surface_of(b), error_m, CGAL::parameters::match_faces(false),
      CGAL::parameters::match_faces(false));
}

double hausdorff_m(const Solid& a, const Solid& b, double error_m) {
  return hausdorff_m(to_mesh(a), to_mesh(b), error_m);
}

}  // namespace oriel
