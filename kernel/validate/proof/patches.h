#pragma once

#include "kernel/base/indexed_vector.h"
#include "kernel/validate/polygons/snapped.h"
#include "kernel/validate/validate.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace oriel::detail {

/// A patch: Patches::patches.
using PatchId = Id<struct PatchTag>;
/// A corner of a patch: Patches::corners.
using PatchCornerId = Id<struct PatchCornerTag>;

/// A plane part of a polygon: the polygon itself if all its points are in one plane, exactly, else
/// one of the triangles that judge() makes of it.
struct PlanePatch {
  /// Index in SnappedBuilding::polygons.
  std::size_t polygon = 0;
  /// Its corners are those from `first` to before `end`.
  PatchCornerId first = {};
  PatchCornerId end = {};
  /// Three of its corners, not on a line, that turn as its outer ring does: they have its normal.
  std::array<int, 3> turn{};
  Box box;

  [[nodiscard]] auto corners() const { return ids_between(first, end); }
};

/// Where a patch comes to a vertex.
struct PatchCorner {
  int vertex = -1;
  PatchId patch = {};
  PatchCornerId next = {};  ///< the corner after it in its ring
};

/// The polygons of a building in plane patches.
struct Patches {
  IndexedVector<PatchId, PlanePatch> patches;
  IndexedVector<PatchCornerId, PatchCorner> corners;
};

/// By corner another one.
using PatchCorners = IndexedVector<PatchCornerId, PatchCornerId>;

/// Nothing if a polygon has a finding, even by FoldsBetween::any_two, or if one comes to a vertex
/// twice, which holes may do: then the patches would not tell how it goes on around that.
std::optional<Patches> patches_of(const SnappedBuilding& building, const ValidateOptions& options);

}  // namespace oriel::detail
