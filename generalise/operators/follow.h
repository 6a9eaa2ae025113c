#pragma once

#include "generalise/operators/host.h"
#include "model/plan.h"
#include "model/segmentation.h"
#include "model/solid.h"

#include <map>
#include <string>
#include <vector>

namespace oriel::detail {

/// What belongs to openings, and was taken off with them.
struct Follower {
  FeatureId feature;
  /// The openings that it belongs to, as far as they have a step or were pushed.
  std::vector<FeatureId> openings;
  Belonging belonging = Belonging::moves;
  double gap_m = 0;
  /// The openings are one strip now.
  bool is_of_strip = false;
};

/// By feature the corners of the facets that were drawn for it.
using DrawnCorners = std::map<FeatureId, std::vector<Vec3>>;

/// Those of the features, ascending, on a solid.
DrawnCorners drawn_corners(const Solid& solid, const Segmentation& segmentation,
                           const std::vector<FeatureId>& features);

/// What came of a follower.
struct Followed {
  Placed placed;
  /// Where it was drawn: with the rounding of corners.
  Box box{};
  /// What it would come too near to, if that is looked for.
  std::vector<FeatureId> beside{};
};

/// Draws what belongs to openings again, as the box that it was. It keeps its distances from the
/// openings as they were drawn: below or above them from the lower or upper edge, beside them from
/// the edge on that side, and along that edge from its middle. What grows becomes as much longer as
/// that edge, so that it overhangs it as before. `own`: all that belongs to the openings, which it
/// may touch: a sill may begin where its window ends.
///
/// Refused with a reason if it was no box, lies along none of the edges, its wall is no longer
/// found there, it would leave that or come nearer than the gap to another part, unless it was as
/// near to that; if it moves and the openings became one strip. Its facets have its polygons.
Followed follow(const Solid& solid, const Segmentation& segmentation, const Follower& follower,
                const DrawnCorners& drawn, const std::vector<FeatureId>& own);

}  // namespace oriel::detail
