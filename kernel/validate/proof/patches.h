#pragma once

#include "kernel/validate/polygons/snapped.h"
#include "kernel/validate/validate.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace oriel::detail {

/// A plane part of a polygon: the polygon itself if all its points are in one plane, exactly, else
/// one of the triangles that judge() makes of it.
struct PlanePatch {
  /// Index in SnappedBuilding::polygons.
  std::size_t polygon = 0;
  /// Its corners are those from `first` to before `end`.
  int first = 0;
  int end = 0;
  /// Three of its corners, not on a line, that turn as its outer ring does: they have its normal.
  std::array<int, 3> turn{};
  Box box;
};

/// Where a patch comes to a vertex.
struct PatchCorner {
  int vertex = -1;
  int patch = -1;
  int next = -1;  ///< the corner after it in its ring
};

/// The polygons of a building in plane patches.
struct Patches {
  std::vector<PlanePatch> patches;
  std::vector<PatchCorner> corners;
};

/// Nothing if a polygon has a finding, even by FoldsBetween::any_two, or if one comes to a vertex
/// twice, which holes may do: then the patches would not tell how it goes on around that.
std::optional<Patches> patches_of(const SnappedBuilding& building, const ValidateOptions& options);

}  // namespace oriel::detail
