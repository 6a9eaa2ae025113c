#include "kernel/validate/proof/valid_solid.h"

#include "kernel/validate/proof/apart.h"
#include "kernel/validate/proof/patch_edges.h"
#include "kernel/validate/proof/patches.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace oriel::detail {

namespace {

/// What the proof takes at most: less than judging what is valid takes.
constexpr std::int64_t kStepsOfProof = 16;

std::int64_t corners_of(const SnappedBuilding& building) {
  std::int64_t corners = 0;
  for (const SnappedPolygon& polygon : building.polygons)
    for (const auto& ring : polygon.rings) corners += std::ssize(ring);
  return corners;
}

}  // namespace

bool is_surely_valid_solid(const SnappedBuilding& building, const ValidateOptions& options) {
  constexpr std::size_t kFewest = 4;
  const auto is_exterior = [](const SnappedPolygon& polygon) {
    return polygon.body == 0 && polygon.shell == 0;
  };
  if (building.polygons.size() < kFewest || !std::ranges::all_of(building.polygons, is_exterior))
    return false;
  if (kStepsOfProof * corners_of(building) > options.budget) return false;
  const auto patches = patches_of(building, options);
  if (!patches) return false;
  const auto twins = twins_of(*patches);
  return twins && is_one_piece(*patches, *twins) && is_one_fan_at_each_vertex(*patches, *twins) &&
         look_outwards(building, *patches) && are_apart(building, options, *patches, *twins);
}

}  // namespace oriel::detail
