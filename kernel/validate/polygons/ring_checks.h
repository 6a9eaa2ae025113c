#pragma once

#include "kernel/validate/defects.h"
#include "kernel/validate/polygons/snapped.h"

#include <array>
#include <vector>

namespace oriel::detail {

/// A polygon seen along the axis nearest to its normal: exact, as coordinates stay what they are.
struct FlatPolygon {
  /// Coordinates by ring and place in the ring, the outer ring counter-clockwise.
  std::vector<std::vector<FlatPoint>> rings;
  /// The direction it is seen against, one of ±x, ±y, ±z.
  Vec3 axis;
};

/// `normal` is that of the polygon, of either sign.
FlatPolygon flat_polygon(const SnappedBuilding& building, const SnappedPolygon& polygon,
                         Vec3 normal);

/// val3dity 101 and 102: at least three points, none twice in a row.
bool have_good_points(const SnappedPolygon& polygon, FindingList& findings);

/// val3dity 104: the rings, each by itself, neither cross nor touch nor run back over themselves.
bool are_simple(const SnappedPolygon& polygon, const FlatPolygon& flat, FindingList& findings);

/// val3dity 208: inner rings run against the outer one.
bool are_holes_turned_well(const SnappedPolygon& polygon, const FlatPolygon& flat,
                           FindingList& findings);

/// val3dity 201, 202, 205, 206, 207 of rings that are simple: different, apart or touching in
/// single points, no hole outside or in another one, the interior in one piece.
bool lie_well(const SnappedPolygon& polygon, const FlatPolygon& flat, FindingList& findings);

}  // namespace oriel::detail
