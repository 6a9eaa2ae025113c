#pragma once

#include "examples/generator/house/draft.h"

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

}  // namespace oriel::generator
