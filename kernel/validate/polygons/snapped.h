#pragma once

#include "kernel/validate/solids/predicates.h"
#include "model/building.h"

#include <optional>
#include <vector>

namespace oriel::detail {

/// A polygon as it is judged.
struct SnappedPolygon {
  /// Polygon::source.
  int number = -1;
  int body = 0;
  int shell = 0;
  /// Numbers of points, as often in a row as they were read.
  std::vector<std::vector<int>> rings;
};

/// A building with its vertices on whole micrometres, those closer than the tolerance made one.
struct SnappedBuilding {
  /// Distinct points, sorted.
  std::vector<MicrometrePoint> points;
  std::vector<SnappedPolygon> polygons;
  Vec3 origin_m;
  /// No two vertices at different places became one.
  bool are_all_apart = true;

  [[nodiscard]] const MicrometrePoint& point(int vertex) const {
    return points[static_cast<std::size_t>(vertex)];
  }
  /// In metres of the building's frame.
  [[nodiscard]] Vec3 metres(int vertex) const;
  /// In the input's coordinates.
  [[nodiscard]] Vec3 place(int vertex) const { return metres(vertex) + origin_m; }
};

/// What becomes of vertices exactly the tolerance apart, to the micrometre.
enum class SnapTies {
  /// What val3dity makes of them: their distance is computed from the doubles of the input.
  as_computed,
  two,
  one
};

/// Nothing if a coordinate is not finite or beyond what predicates are exact for.
std::optional<SnappedBuilding> snapped(const Building& building, double snap_m, SnapTies ties);

}  // namespace oriel::detail
