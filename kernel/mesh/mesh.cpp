#include "kernel/mesh/mesh.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/base/log.h"
#include "kernel/mesh/half_edges.h"
#include "kernel/mesh/manifold.h"
#include "kernel/mesh/triangulate.h"

#include <algorithm>
#include <map>
#include <span>
#include <streambuf>
#include <string_view>
#include <utility>

#include <OpenMesh/Core/System/omstream.hh>

namespace oriel {

namespace {

using detail::PolyMesh;
using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

bool is_convex(std::span<const Vec3> points, const std::vector<int>& ring, Vec3 normal) {
  const auto point = [&](std::size_t i) { return points[at(ring[i % ring.size()])]; };
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (dot(cross(point(i + 1) - point(i), point(i + 2) - point(i + 1)), normal) < 0) return false;
  return true;
}

/// The faces of polygons, and of each the polygon that it is of.
struct FaceList {
  std::vector<std::vector<int>> corners;
  std::vector<int> polygons;
  std::vector<Vec3> normals;
  int empty_polygons = 0;

  FaceList(const MeshSource& source, MeshFaces faces) {
    for (int p = 0; p < static_cast<int>(source.polygons.size()); ++p) {
      const MeshPolygon& polygon = source.polygons[at(p)];
      ORIEL_ASSERT(!polygon.rings.empty());
      ORIEL_ASSERT(polygon.feature < static_cast<int>(source.features.size()));
      const std::size_t before = corners.size();
      if (stays_whole(source, polygon, faces))
        add(p, polygon.rings[0], polygon.normal);
      else
        for (const auto& t : triangulate(source.points, polygon.rings, polygon.normal))
          add(p, {t[0], t[1], t[2]}, polygon.normal);
      if (corners.size() == before) ++empty_polygons;
    }
  }

 private:
  static bool stays_whole(const MeshSource& source, const MeshPolygon& polygon, MeshFaces faces) {
    if (polygon.rings.size() != 1 || faces == MeshFaces::triangles) return false;
    return faces == MeshFaces::polygons ||
           is_convex(source.points, polygon.rings[0], polygon.normal);
  }

  void add(int polygon, std::vector<int> ring, Vec3 normal) {
    if (ring.size() < 3) return;
    corners.push_back(std::move(ring));
    polygons.push_back(polygon);
    normals.push_back(normal);
  }
};

/// Writes to the log what OpenMesh would write to stderr.
class ComplaintLog : public std::streambuf {
 public:
  ComplaintLog() { omerr().rdbuf(this); }

 private:
  /// A complaint comes as one text.
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    const std::string_view all(text, static_cast<std::size_t>(size));
    log("kernel").debug("openmesh: {}", all.substr(0, all.find('\n')));
    return size;
  }
  int_type overflow(int_type c) override { return traits_type::not_eof(c); }
};

/// Puts faces into OpenMesh, which takes what leaves every vertex with one fan of faces.
class HalfEdgeBuilder {
 public:
  HalfEdgeBuilder(Mesh::HalfEdges& out, const MeshSource& source) : out_(out), source_(source) {
    static const ComplaintLog complaints;
    out_.features = source.features;
    out_.originals = static_cast<int>(source.points.size());
    for (int v = 0; v < out_.originals; ++v) add_vertex(v);
    name_number("");
  }

  void add(const FaceList& faces) {
    const detail::ManifoldFaces manifold =
        detail::make_manifold(source_.points, faces.corners, faces.normals);
    for (const int v : manifold.doubled) add_vertex(v);
    for (std::size_t f = 0; f < manifold.corners.size(); ++f) {
      const FaceHandle face = add_face(manifold.corners[f]);
      describe(face, source_.polygons[at(faces.polygons[f])]);
      out_.mesh.property(out_.shell, face) = manifold.shell_of_face[f];
      auto source = faces.corners[f].begin();
      for (const auto half_edge : out_.mesh.fh_range(face))
        out_.mesh.property(out_.source, half_edge) = *source++;
    }
    const int doubled = static_cast<int>(out_.mesh.n_vertices()) - out_.originals;
    out_.findings = {
        manifold.non_manifold_edges, manifold.open_edges, manifold.shells, doubled, loose_faces_,
        faces.empty_polygons};
  }

 private:
  VertexHandle add_vertex(int original) {
    const VertexHandle vertex =
        out_.mesh.add_vertex(detail::openmesh_of(source_.points[at(original)]));
    out_.mesh.property(out_.original, vertex) = original;
    return vertex;
  }

  FaceHandle add_face(const std::vector<int>& corners) {
    std::vector<VertexHandle> handles;
    for (const int v : corners) handles.emplace_back(v);
    const FaceHandle face = fits(handles) ? out_.mesh.add_face(handles) : FaceHandle();
    if (face.is_valid()) return face;
    ++loose_faces_;
    for (VertexHandle& handle : handles)
      handle = add_vertex(out_.mesh.property(out_.original, handle));
    return out_.mesh.add_face(handles);
  }

  /// Says whether a face is what OpenMesh asks for.
  [[nodiscard]] bool fits(const std::vector<VertexHandle>& corners) const {
    const PolyMesh& mesh = out_.mesh;
    std::vector<int> sorted;
    for (const VertexHandle corner : corners) sorted.push_back(corner.idx());
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end()) return false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const VertexHandle from = corners[i];
      if (!mesh.is_boundary(from)) return false;
      const auto half_edge = mesh.find_halfedge(from, corners[(i + 1) % corners.size()]);
      if (half_edge.is_valid() && !mesh.is_boundary(half_edge)) return false;
    }
    return true;
  }

  void describe(FaceHandle face, const MeshPolygon& polygon) {
    out_.mesh.set_normal(face, detail::openmesh_of(polygon.normal));
    out_.mesh.property(out_.facet, face) = polygon.facet.value;
    out_.mesh.property(out_.feature, face) = polygon.feature;
    out_.mesh.property(out_.surface, face) = name_number(polygon.surface);
    out_.mesh.property(out_.label, face) =
        polygon.feature < 0 ? 0 : name_number(source_.features[at(polygon.feature)].label);
  }

  int name_number(const std::string& name) {
    const auto [found, is_new] = numbers_.try_emplace(name, static_cast<int>(out_.names.size()));
    if (is_new) out_.names.push_back(name);
    return found->second;
  }

  Mesh::HalfEdges& out_;
  const MeshSource& source_;
  std::map<std::string, int> numbers_;
  int loose_faces_ = 0;
};

}  // namespace

Mesh::HalfEdges::HalfEdges() {
  mesh.request_face_normals();
  mesh.add_property(facet, "facet");
  mesh.add_property(feature, "feature");
  mesh.add_property(label, "label");
  mesh.add_property(surface, "surface");
  mesh.add_property(shell, "shell");
  mesh.add_property(source, "source");
  mesh.add_property(original, "original");
}

Mesh::Mesh() : half_edges_(std::make_unique<HalfEdges>()) {}

Mesh::Mesh(const MeshSource& source, MeshFaces faces) : Mesh() {
  HalfEdgeBuilder(*half_edges_, source).add(FaceList(source, faces));
}

Mesh::~Mesh() = default;
Mesh::Mesh(const Mesh& other) : half_edges_(std::make_unique<HalfEdges>(*other.half_edges_)) {}
Mesh::Mesh(Mesh&& other) noexcept = default;
Mesh& Mesh::operator=(const Mesh& other) { return *this = Mesh(other); }
Mesh& Mesh::operator=(Mesh&& other) noexcept = default;

int Mesh::vertices() const { return static_cast<int>(half_edges_->mesh.n_vertices()); }
int Mesh::edges() const { return static_cast<int>(half_edges_->mesh.n_edges()); }
int Mesh::faces() const { return static_cast<int>(half_edges_->mesh.n_faces()); }

Vec3 Mesh::point(int vertex) const {
  return detail::vec3_of(half_edges_->mesh.point(VertexHandle(vertex)));
}

int Mesh::original(int vertex) const {
  return half_edges_->mesh.property(half_edges_->original, VertexHandle(vertex));
}

int Mesh::originals() const { return half_edges_->originals; }

std::vector<int> Mesh::corners(int face) const {
  std::vector<int> corners;
  for (const VertexHandle v : half_edges_->mesh.fv_range(FaceHandle(face)))
    corners.push_back(v.idx());
  return corners;
}

std::vector<int> Mesh::ring(int face) const {
  std::vector<int> ring;
  for (const auto half_edge : half_edges_->mesh.fh_range(FaceHandle(face)))
    ring.push_back(half_edges_->mesh.property(half_edges_->source, half_edge));
  return ring;
}

Vec3 Mesh::normal(int face) const {
  return detail::vec3_of(half_edges_->mesh.normal(FaceHandle(face)));
}

FacetId Mesh::facet(int face) const {
  return FacetId{half_edges_->mesh.property(half_edges_->facet, FaceHandle(face))};
}

int Mesh::feature(int face) const {
  return half_edges_->mesh.property(half_edges_->feature, FaceHandle(face));
}

int Mesh::shell(int face) const {
  return half_edges_->mesh.property(half_edges_->shell, FaceHandle(face));
}

const std::string& Mesh::label(int face) const {
  return half_edges_->names[at(half_edges_->mesh.property(half_edges_->label, FaceHandle(face)))];
}

const std::string& Mesh::surface(int face) const {
  return half_edges_->names[at(half_edges_->mesh.property(half_edges_->surface, FaceHandle(face)))];
}

const std::vector<MeshFeature>& Mesh::features() const { return half_edges_->features; }
const MeshFindings& Mesh::findings() const { return half_edges_->findings; }

Mesh to_mesh(const Solid& solid, MeshFaces faces) { return Mesh(mesh_source(solid), faces); }

MeshSource mesh_source(const Solid& solid) {
  MeshSource source;
  for (const Vertex& vertex : solid.vertices) source.points.push_back(vertex.point);
  for (int f = 0; f < static_cast<int>(solid.facets.size()); ++f) {
    const Facet& facet = solid.facets[at(f)];
    source.polygons.push_back(
        {facet.loops, solid.planes[facet.plane.index()].normal, -1, {}, FacetId{f}});
  }
  return source;
}

MeshSource mesh_source(const Mesh& mesh) {
  MeshSource source;
  source.features = mesh.features();
  for (int v = 0; v < mesh.originals(); ++v) source.points.push_back(mesh.point(v));
  for (int f = 0; f < mesh.faces(); ++f)
    source.polygons.push_back(
        {{mesh.ring(f)}, mesh.normal(f), mesh.feature(f), mesh.surface(f), mesh.facet(f)});
  return source;
}

namespace {

/// Of each shell of the mesh the number that its polygons have: 0, or of cavities 1, 2…
std::vector<int> shell_numbers(const Mesh& mesh) {
  std::vector<double> volumes(at(mesh.findings().shells));
  for (int f = 0; f < mesh.faces(); ++f) {
    const std::vector<int> corners = mesh.corners(f);
    const Vec3 first = mesh.point(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      volumes[at(mesh.shell(f))] +=
          dot(first, cross(mesh.point(corners[i]), mesh.point(corners[i + 1])));
  }
  std::vector<int> numbers;
  int cavities = 0;
  for (const double volume : volumes) numbers.push_back(volume < 0 ? ++cavities : 0);
  return numbers;
}

}  // namespace

Solidified to_solid(const Mesh& mesh, const Tolerances& tolerances, const RepairOptions& repair) {
  Building building;
  building.id = "mesh";
  building.is_solid = mesh.findings().open_edges == 0;
  for (int v = 0; v < mesh.originals(); ++v) building.vertices.push_back(mesh.point(v));
  // Facets turned inside out as a whole are no cavity: nothing is around them.
  std::vector<int> shells;
  if (building.is_solid) shells = shell_numbers(mesh);
  const bool has_body = std::ranges::find(shells, 0) != shells.end();
  for (int f = 0; f < mesh.faces(); ++f)
    building.polygons.push_back(
        {{mesh.ring(f)}, f, 0, has_body ? shells[at(mesh.shell(f))] : 0, mesh.surface(f)});
  return solidify(building, tolerances, repair);
}

}  // namespace oriel
