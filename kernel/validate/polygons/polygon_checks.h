#pragma once

#include "kernel/validate/defects.h"
#include "kernel/validate/polygons/snapped.h"

#include <array>
#include <vector>

namespace oriel::detail {

/// What is known of a polygon once it was judged.
struct JudgedPolygon {
  bool is_good = false;
  /// Of a good polygon: triangles of its points that cover it, oriented as its outer ring.
  std::vector<std::array<int, 3>> triangles;
};

/// Which triangles of a polygon are compared with each other for 204.
enum class FoldsBetween {
  largest_and_others,
  /// Whichever comes first to a judge who compares that one with the others.
  any_two
};

/// Judges the rings of a polygon (val3dity 101, 102, 104), its planarity (203, 204) and how its
/// rings lie to each other (201, 202, 205–208). As in val3dity the order is 101, 102, 203, 104,
/// 208, then the others, and the first that fails ends it; a triangle is only looked at for 101,
/// 102 and 104.
JudgedPolygon judge(const SnappedBuilding& building, const SnappedPolygon& polygon,
                    const ValidateOptions& options, FindingList& findings,
                    FoldsBetween folds = FoldsBetween::largest_and_others);

}  // namespace oriel::detail
