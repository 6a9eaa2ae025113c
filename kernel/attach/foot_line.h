#pragma once

#include "kernel/attach/raise_across.h"
#include "kernel/model/solid.h"
#include "kernel/model/vec3.h"

#include <string>
#include <utility>
#include <vector>

namespace oriel::detail {

/// A point of the line in which the sides of a block cut a roof.
struct FootPoint {
  Vec3 point;
  bool is_meeting = false;  ///< of three planes
  /// The side of the block that the line follows from here, and the facet that it is on.
  int side = 0;
  FacetId facet{};
  /// Where it crosses an edge of the roof: the edge as the facet has it that the line comes from.
  /// (-1, -1) in a corner of the block.
  std::pair<int, int> edge{-1, -1};

  [[nodiscard]] bool is_crossing() const { return edge.first >= 0; }
};

/// The line in which the sides of a block cut the facets of a solid that look up, the block on its
/// left seen from above; it is closed. Begins in the corner between the last side and the first.
struct FootLine {
  std::vector<FootPoint> points;
  /// If there is none.
  std::string reason;
};
FootLine foot_line(const Solid& solid, const BlockAcross& block);

/// How far a point is in front of a plane.
double ahead_of(const Plane& plane, Vec3 point);

}  // namespace oriel::detail
