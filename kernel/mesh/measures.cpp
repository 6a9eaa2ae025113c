#include "kernel/mesh/measures.h"

#include "kernel/base/index.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "kernel/geometry/shared_area.h"
#include "kernel/mesh/half_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>

namespace oriel {

namespace {

using detail::PolyMesh;
using detail::vec3_of;
using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;

constexpr double kDegrees = 180 / 3.14159265358979323846;

/// The signed angle between the normals of an edge's faces in degrees: below 0 in a valley.
double dihedral_deg(const PolyMesh& mesh, EdgeHandle edge) {
  const HalfedgeHandle half_edge = mesh.halfedge_handle(edge, 0);
  const Vec3 n = vec3_of(mesh.normal(mesh.face_handle(half_edge)));
  const Vec3 m = vec3_of(mesh.normal(mesh.opposite_face_handle(half_edge)));
  const Vec3 along = vec3_of(mesh.calc_edge_vector(half_edge));
  const Vec3 turn = cross(n, m);
  const double angle = std::atan2(length(turn), dot(n, m)) * kDegrees;
  return dot(turn, along) < 0 ? -angle : angle;
}

/// Twice the vector area of a face.
Vec3 twice_area(const PolyMesh& mesh, FaceHandle face) {
  Vec3 sum, first, last;
  int count = 0;
  for (const auto vertex : mesh.fv_range(face)) {
    const Vec3 p = vec3_of(mesh.point(vertex));
    if (count == 0) first = p;
    if (count > 1) sum = sum + cross(last - first, p - first);
    last = p;
    ++count;
  }
  return sum;
}

/// The angle of the corner at the end of `half_edge`.
double corner_angle(const PolyMesh& mesh, HalfedgeHandle half_edge) {
  const Vec3 in = vec3_of(mesh.calc_edge_vector(half_edge));
  const Vec3 out = vec3_of(mesh.calc_edge_vector(mesh.next_halfedge_handle(half_edge)));
  return std::atan2(length(cross(in, out)), -dot(in, out));
}

class CornerNormals {
 public:
  CornerNormals(const PolyMesh& mesh, double crease_deg) : mesh_(mesh), crease_deg_(crease_deg) {}

  /// The normal at the end of `half_edge`, within its face.
  [[nodiscard]] Vec3 at_end(HalfedgeHandle half_edge) const {
    Vec3 sum = weighted(half_edge);
    HalfedgeHandle at = half_edge;
    // Round the vertex one way; where that ends at a crease, the other way as well.
    while (is_smooth(mesh_.next_halfedge_handle(at))) {
      at = mesh_.opposite_halfedge_handle(mesh_.next_halfedge_handle(at));
      if (at == half_edge) return normalised(sum);
      sum = sum + weighted(at);
    }
    for (at = half_edge; is_smooth(at);) {
      at = mesh_.prev_halfedge_handle(mesh_.opposite_halfedge_handle(at));
      sum = sum + weighted(at);
    }
    return normalised(sum);
  }

 private:
  [[nodiscard]] bool is_smooth(HalfedgeHandle half_edge) const {
    const EdgeHandle edge = mesh_.edge_handle(half_edge);
    return !mesh_.is_boundary(edge) && std::abs(dihedral_deg(mesh_, edge)) <= crease_deg_;
  }

  [[nodiscard]] Vec3 weighted(HalfedgeHandle half_edge) const {
    return corner_angle(mesh_, half_edge) * vec3_of(mesh_.normal(mesh_.face_handle(half_edge)));
  }

  const PolyMesh& mesh_;
  double crease_deg_;
};

}  // namespace

MeshMeasures measure(const Mesh& mesh) {
  const PolyMesh& half_edges = mesh.half_edges().mesh;
  MeshMeasures sizes;
  sizes.edges = mesh.edges();
  sizes.faces = mesh.faces();
  for (const auto vertex : half_edges.vertices())
    if (!half_edges.is_isolated(vertex)) ++sizes.vertices;
  for (const auto face : half_edges.faces()) {
    const Vec3 area = twice_area(half_edges, face);
    const Vec3 corner = vec3_of(half_edges.point(*half_edges.cfv_iter(face)));
    sizes.area_m2 += length(area) / 2;
    sizes.volume_m3 += dot(corner, area) / 6;
  }
  sizes.is_closed = mesh.findings().open_edges == 0;
  sizes.euler = sizes.vertices - sizes.edges + sizes.faces;
  return sizes;
}

std::vector<FeatureEdge> feature_edges(const Mesh& mesh, double angle_deg) {
  const PolyMesh& half_edges = mesh.half_edges().mesh;
  std::vector<FeatureEdge> found;
  for (const auto edge : half_edges.edges()) {
    const HalfedgeHandle half_edge = half_edges.halfedge_handle(edge, 0);
    FeatureEdge feature{half_edges.from_vertex_handle(half_edge).idx(),
                        half_edges.to_vertex_handle(half_edge).idx(), 0,
                        half_edges.is_boundary(edge)};
    if (!feature.is_open) feature.dihedral_deg = dihedral_deg(half_edges, edge);
    if (feature.is_open || std::abs(feature.dihedral_deg) > angle_deg) found.push_back(feature);
  }
  return found;
}

std::vector<std::vector<Vec3>> corner_normals(const Mesh& mesh, double crease_deg) {
  const PolyMesh& half_edges = mesh.half_edges().mesh;
  const CornerNormals normals(half_edges, crease_deg);
  std::vector<std::vector<Vec3>> of_faces;
  for (const auto face : half_edges.faces()) {
    std::vector<Vec3> of_corners;
    for (const auto half_edge : half_edges.fh_range(face))
      of_corners.push_back(normals.at_end(half_edge));
    of_faces.push_back(std::move(of_corners));
  }
  return of_faces;
}

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

namespace {

/// A facet is in the plane of another one if none of its corners is further off: far more than the
/// grid of solids rounds by, far less than distances are measured to. What may be left of a facet
/// that others cover is a square millimetre, no disc of which is wider than that.
constexpr double kSamePlane_m = 1e-4, kUncovered_m2 = 1e-6;

/// A facet of a solid with what tells whether another one lies in it.
struct FacetFigure {
  std::vector<Outline> outlines;
  Vec3 normal;
  double offset_m = 0;
  Box box;
};

FacetFigure figure_of(const Solid& solid, const Facet& facet) {
  const Plane& plane = solid.planes[facet.plane.index()];
  FacetFigure figure{outlines_of(solid.vertices, facet.loops), plane.normal, plane.offset_m, {}};
  for (const Outline& outline : figure.outlines)
    for (const Vec3 p : outline) figure.box.grow(p);
  return figure;
}

bool is_in_plane(const FacetFigure& of, const FacetFigure& other) {
  if (dot(of.normal, other.normal) <= 0) return false;
  return std::ranges::all_of(of.outlines, [&](const Outline& outline) {
    return std::ranges::all_of(outline, [&](Vec3 p) {
      return std::abs(dot(other.normal, p) - other.offset_m) <= kSamePlane_m;
    });
  });
}

/// Facets of a solid that look the same way and lie in one plane cover all of it.
bool is_covered(const FacetFigure& figure, const std::vector<FacetFigure>& others) {
  double left_m2 = figure_area_m2(figure.outlines, figure.normal);
  for (const FacetFigure& other : others) {
    if (!overlap(figure.box, other.box, kSamePlane_m) || !is_in_plane(figure, other)) continue;
    left_m2 -= shared_area_m2(figure.outlines, other.outlines, figure.normal);
    if (left_m2 <= kUncovered_m2) return true;
  }
  return false;
}

/// The facets of `solid` that do not lie on `other`: all points of `solid` that are further off
/// than a millimetre are in these.
Solid own_facets(const Solid& solid, const Solid& other) {
  std::vector<FacetFigure> others;
  for (const Facet& facet : other.facets) others.push_back(figure_of(other, facet));
  Solid own = solid;
  std::erase_if(own.facets,
                [&](const Facet& facet) { return is_covered(figure_of(solid, facet), others); });
  own.shells.clear();
  return own;
}

/// How far a point of some facets of a solid lies at most from another one.
double one_sided_m(const Solid& own, const Solid& other, double error_m) {
  if (own.facets.empty()) return 0;
  namespace pmp = CGAL::Polygon_mesh_processing;
  return pmp::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(
      surface_of(to_mesh(own, MeshFaces::triangles)),
      surface_of(to_mesh(other, MeshFaces::triangles)), error_m,
      CGAL::parameters::match_faces(false), CGAL::parameters::match_faces(false));
}

}  // namespace

double hausdorff_m(const Solid& a, const Solid& b, double error_m) {
  return std::max(one_sided_m(own_facets(a, b), b, error_m),
                  one_sided_m(own_facets(b, a), a, error_m));
}

}  // namespace oriel
