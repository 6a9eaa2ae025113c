#pragma once

#include "kernel/base/ids.h"
#include "kernel/solidify/solidify.h"
#include "model/solid.h"
#include "model/vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// Red, green and blue as screens have them (sRGB), and opacity.
using FaceColour = std::array<std::uint8_t, 4>;
/// Of each face its colour, if it has one.
using FaceColours = std::vector<std::optional<FaceColour>>;

/// A feature that faces of a mesh belong to, or a class of faces where no feature is named.
struct MeshFeature {
  std::string building;
  /// "window", "wall"…
  std::string label;
  /// The feature's id, or empty.
  std::string id;
  /// How sure the label is, from 0 to 1, and the rule that gave it; of features without a verdict
  /// nothing.
  std::optional<double> score{};
  std::string rule{};
};

/// A planar polygon to be meshed, ring 0 the outer one, counter-clockwise about `normal`.
struct MeshPolygon {
  /// Indices into MeshSource::points.
  std::vector<std::vector<int>> rings;
  Vec3 normal;
  /// Index into MeshSource::features, or -1.
  int feature = -1;
  /// The type of its semantic surface, "WallSurface"; empty: none.
  std::string surface{};
  /// The facet of a solid that it is; invalid: none.
  FacetId facet{};
  /// That of its material in the input, if it has one.
  std::optional<FaceColour> colour{};
};

/// What a mesh is made of: polygons with shared points, in metres, and the features they name.
struct MeshSource {
  std::vector<Vec3> points;
  std::vector<MeshPolygon> polygons;
  std::vector<MeshFeature> features;
};

/// Which polygons are triangulated. A face of a half-edge mesh has no holes, so polygons with holes
/// always are.
enum class MeshFaces {
  polygons,  ///< only polygons with holes
  convex,    ///< polygons with holes or reflex corners
  triangles  ///< all
};

/// What was found while a mesh was made. Nothing is dropped but what has no face to give.
struct MeshFindings {
  /// Edges that are not met by one face on each side, or two of like orientation.
  int non_manifold_edges = 0;
  /// Edges of one face only. Where more than two faces meet, those without a partner.
  int open_edges = 0;
  /// How many pieces hang together by edges.
  int shells = 0;
  /// Vertices that were doubled, as a half-edge mesh has one fan of faces at a vertex and two faces
  /// at an edge: behind the points of the source, at the same places.
  int doubled_vertices = 0;
  /// Faces that all others disagree with (as of a Möbius strip), so that all their vertices were
  /// doubled.
  int loose_faces = 0;
  /// Polygons without area, which have no triangles.
  int empty_polygons = 0;
};

/// A half-edge mesh (OpenMesh) with double coordinates, each face with its facet, feature, label
/// and semantic surface. A value: it is made whole and does not change.
///
/// Vertices 0…n-1 are the n points of the source, also those that no face uses; doubled ones
/// follow. Faces stand in the order of the polygons, the triangles of one in the order of
/// `triangulate`, and the corners of a face in the order of its ring.
///
/// Where more than two faces meet at an edge, those that bound the same material are neighbours, so
/// that solids that touch along an edge come apart into closed shells.
class Mesh {
 public:
  /// An empty mesh.
  Mesh();
  explicit Mesh(const MeshSource& source, MeshFaces faces = MeshFaces::polygons);
  ~Mesh();
  Mesh(const Mesh& other);
  Mesh(Mesh&& other) noexcept;
  Mesh& operator=(const Mesh& other);
  Mesh& operator=(Mesh&& other) noexcept;

  [[nodiscard]] int vertices() const;
  [[nodiscard]] int edges() const;
  [[nodiscard]] int faces() const;

  [[nodiscard]] Vec3 point(int vertex) const;
  /// The vertex that this one doubles, or itself.
  [[nodiscard]] int original(int vertex) const;
  /// How many vertices are no doubles.
  [[nodiscard]] int originals() const;

  [[nodiscard]] std::vector<int> corners(int face) const;
  /// The corners as points of the source: the ring as it has it, or a triangle of it.
  [[nodiscard]] std::vector<int> ring(int face) const;
  /// The unit normal that the polygon came with.
  [[nodiscard]] Vec3 normal(int face) const;
  [[nodiscard]] FacetId facet(int face) const;
  /// Index into `features()`, or -1.
  [[nodiscard]] int feature(int face) const;
  /// The label of its feature, or empty.
  [[nodiscard]] const std::string& label(int face) const;
  [[nodiscard]] const std::string& surface(int face) const;
  /// Which of the pieces that hang together by edges, numbered by their first faces.
  [[nodiscard]] int shell(int face) const;

  [[nodiscard]] const std::vector<MeshFeature>& features() const;
  [[nodiscard]] const MeshFindings& findings() const;

  /// The half-edges themselves, for the files of kernel/mesh.
  struct HalfEdges;
  [[nodiscard]] const HalfEdges& half_edges() const { return *half_edges_; }

 private:
  std::unique_ptr<HalfEdges> half_edges_;
};

/// The facets of a solid as a mesh in the same frame. Vertex `v` of the mesh is vertex `v` of the
/// solid.
Mesh to_mesh(const Solid& solid, MeshFaces faces = MeshFaces::triangles);

/// The facets of a solid as polygons to be meshed.
MeshSource mesh_source(const Solid& solid);

/// The faces of a mesh as polygons to be meshed once more, doubled vertices as their originals.
MeshSource mesh_source(const Mesh& mesh);

/// The solid that a mesh bounds, by `solidify`: triangles of one plane become one facet again,
/// doubled vertices are one, and facets list the faces of the mesh that they are of
/// (Facet::polygons), and closed shells that enclose a negative volume are cavities, unless all do.
/// For a mesh that `to_mesh` made of a solid the facets are those of that solid,
/// and vertices lie where they lay to the last digits. Coordinates are metres near the origin, as
/// in the frame of a building: subtract the origin of `frame_of` from those of a file. Open meshes
/// are repaired as `repair` allows; no value if there is no solid, and issues that say why.
Solidified to_solid(const Mesh& mesh, const Tolerances& tolerances = {},
                    const RepairOptions& repair = {});

}  // namespace oriel
