#pragma once

#include "kernel/mesh/mesh.h"
#include "model/vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// What triangles belong to, a row of the property table of a GLB: a feature, or all faces of one
/// kind of surface that belong to none.
struct FlatFeature {
  std::string building;
  /// The feature's id, or empty.
  std::string id;
  /// "window", "wall" …
  std::string label;
  /// The type of the semantic surface, "WallSurface", or empty.
  std::string surface;
  std::optional<double> score{};
  std::string rule{};
  /// From its lowest point to its highest.
  double height_m = 0;
  /// That of its material in the input.
  std::optional<FaceColour> colour{};

  friend bool operator==(const FlatFeature&, const FlatFeature&) = default;
};

/// Triangles for a viewer, z up, in metres from an origin of their own. Each polygon has its own
/// points, so that each has one normal, and edges stay sharp.
struct FlatMesh {
  using Point = std::array<float, 3>;
  std::vector<FlatFeature> features;
  std::vector<Point> points;
  /// Unit normals, parallel to `points`.
  std::vector<Point> normals;
  /// Indices into `features`, parallel to `points`.
  std::vector<std::uint32_t> feature_of;
  /// Counter-clockwise seen from outside, indices into `points`.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Each edge of a polygon once, also where two polygons share it.
  std::vector<std::array<std::uint32_t, 2>> edges;

  friend bool operator==(const FlatMesh&, const FlatMesh&) = default;
};

/// The polygons of `source` as triangles, by `triangulate_quickly`, with points less `origin_m`. A
/// feature has one row for each type of surface and each colour among its faces, in the order of
/// the polygons. Polygons without area have no triangles and are left out.
FlatMesh flat_mesh(const MeshSource& source, Vec3 origin_m);

/// An affine map of space: p ↦ columns · p + origin.
struct Placement {
  std::array<Vec3, 3> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 origin;

  [[nodiscard]] Vec3 turned(Vec3 v) const {
    return v.x * columns[0] + v.y * columns[1] + v.z * columns[2];
  }
  [[nodiscard]] Vec3 placed(Vec3 p) const { return turned(p) + origin; }
};

/// Appends `part` as `placement` puts it. Normals are turned with it, which holds for maps that are
/// nearly rotations.
void append(FlatMesh& mesh, const FlatMesh& part, const Placement& placement);

/// The box of all points; that of none is empty.
Box box_of(const FlatMesh& mesh);

}  // namespace oriel
