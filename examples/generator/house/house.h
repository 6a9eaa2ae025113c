#pragma once

#include "examples/generator/facade/panel.h"

#include <optional>
#include <string_view>
#include <vector>

namespace oriel::generator {

enum class RoofKind { flat, gable, hip, shed };
std::string_view name_of(RoofKind kind);

/// A wing before the front wall, from u0 to u1 along it, `length` long.
struct Wing {
  Um u0 = 0, u1 = 0, length = 0;
  /// Height of the walls; a gabled wing takes that of the house.
  Um wall_height = 0;
};

/// The bare house: a box of width (x) × depth (y) × wall_height (z) under a roof. The ridge runs
/// along x. Roofs are thick where they hang over.
struct Massing {
  RoofKind roof = RoofKind::gable;
  Um width = 0, depth = 0, wall_height = 0;
  Slope slope;
  Um overhang = 0;
  /// Height of the parapet around a flat roof; not together with an overhang.
  Um parapet = 0;
  /// Gable and flat roofs without overhang and parapet only.
  std::optional<Wing> wing;
};

/// What the bare house offers to the features.
struct House {
  FacetId ground{};
  /// Front, back, left and right wall of the main house are first.
  std::vector<Panel> walls;
  /// The triangles of gables, as rectangles that fit into them.
  std::vector<Panel> gables;
  std::vector<RoofPlane> roof;
  /// The ends of the ridge, if there is one; one point if they are equal.
  std::vector<Point> ridge;
};

/// Thickness of a roof that hangs over.
inline constexpr Um kRoofThickness = 200'000;
/// Distance features keep from the ends of their wall.
inline constexpr Um kWallMargin = 300'000;
/// Distance they keep from an inner corner, so that what sticks out of both walls does not meet.
inline constexpr Um kCornerMargin = 1'900'000;

House build_house(Draft& draft, const Massing& massing);

}  // namespace oriel::generator
