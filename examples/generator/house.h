#pragma once

#include "examples/generator/draft.h"

#include <optional>
#include <string_view>
#include <vector>

namespace oriel::generator {

/// An upright surface on which features are placed: a wall, the front of a bay or dormer, the back
/// of a loggia. Its frame has v = 0 at the ground (or at a dormer's foot) and w outwards.
struct Panel {
  FacetId facet{};
  Frame frame;
  /// The facet in the plane v = 0 that a feature reaching down to it is summed into; kNewFacet if
  /// the panel does not stand on the ground.
  FacetId ground = kNewFacet;
  /// Where features may be placed, and where some already are.
  Rect usable;
  std::vector<Rect> reserved;
  /// The installation the panel belongs to, or -1.
  int installation = -1;
  /// True for the walls beside the main entrance.
  bool is_front = false;

  /// True if the rectangle is usable and keeps the distance to all that is reserved.
  [[nodiscard]] bool is_free(const Rect& rect, Um distance) const;
  /// The parts of the band from v0 to v1 across `room` that keep the distance to all that is
  /// reserved, from left to right.
  [[nodiscard]] std::vector<Rect> free_parts(const Rect& room, Um v0, Um v1, Um distance) const;
};

/// A roof's slope as rise per thousand of run.
struct Slope {
  int per_mille = 0;
  /// Exact for a run in whole millimetres.
  [[nodiscard]] constexpr Um rise(Um run) const { return run / 1000 * per_mille; }
};

/// A plane of the roof. Its frame has the origin at the eaves, u along them, v inwards, w up.
struct RoofPlane {
  FacetId facet{};
  Frame frame;
  Slope slope;
  /// The plane seen from above, in (u, v), counter-clockwise.
  std::vector<Uv> outline;
  Rect usable;
  std::vector<Rect> reserved;

  [[nodiscard]] constexpr Point at(Uv p) const { return frame.at(p.u, p.v, slope.rise(p.v)); }
  [[nodiscard]] bool is_free(const Rect& rect, Um distance) const;
};

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
