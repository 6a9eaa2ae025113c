#pragma once

#include "kernel/base/work.h"
#include "kernel/segment/flush/subdivisions.h"
#include "model/tolerances.h"
#include "model/vec3.h"

#include <vector>

namespace oriel::detail {

/// What a subdivision without a host polygon betrays of a flush opening.
struct InsetRectangle {
  InputPolygonId host = {};              ///< a polygon beside it
  std::vector<InputPolygonId> polygons;  ///< Subdivisions::polygons, ascending
};

/// The rectangles that stand out in a wall that was cut into triangles polygon by polygon.
///
/// A triangulation adds no points, so a point inside the facet is a corner of some polygon; and a
/// polygon with a notch or a hole has an angle of more than 180 degrees at its corner, which pieces
/// that are convex by themselves (panels of a facade) have nowhere. So a *free corner* is a point
/// inside the facet where two edges meet at a right angle and neither goes straight on. A rectangle
/// of edges is inset if
///
/// - it is the smallest that closes at a free corner, or one of its sides goes straight on at
/// neither
///   end (lines that divide a wall begin at its rim or at a corner of it);
/// - no side goes straight on beyond a corner, but to a corner of the facet or of another inset
///   rectangle: between those the triangles of the wall have edges;
/// - a side and the sides next to it, from there on, lie inside the facet: all four, or those of a
///   door above its slab, or between plinths.
///
/// Sides are level or upright in their plane; in a level one they go with its longest side, and all
/// four lie inside. Rectangles that
/// share a part of a side are one (the leaves of a door). A plain wall in triangles has no points
/// inside, and any division into pieces between straight lines no free corner: both yield nothing.
/// Once `work` is used up no more corners are looked at.
std::vector<InsetRectangle> find_inset_rectangles(const Subdivisions& subdivisions,
                                                  const Subdivision& subdivision, Vec3 normal,
                                                  const Tolerances& tolerances, Work& work);

}  // namespace oriel::detail
