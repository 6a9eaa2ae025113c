#include "kernel/blocks/simplify_footprint.h"

#include "kernel/base/index.h"
#include "kernel/blocks/simplify_outlines.h"
#include "kernel/blocks/upright_block.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

Vec3 seen_from_above(Vec3 p) { return {p.x, p.y, 0}; }

/// The blocks by their ground facets; the heights of walls are those of the tops over them.
std::vector<UprightBlock> blocks_of(const Solid& solid) {
  std::map<std::pair<double, double>, double> tops;
  std::vector<UprightBlock> blocks;
  for (const Vertex& vertex : solid.vertices) {
    const auto [entry, is_new] = tops.try_emplace({vertex.point.x, vertex.point.y}, vertex.point.z);
    entry->second = std::max(entry->second, vertex.point.z);
  }
  for (const Facet& facet : solid.facets) {
    if (solid.planes[facet.plane.index()].coefficients[2] >= 0) continue;
    UprightBlock& block = blocks.emplace_back();
    for (const Loop& loop : facet.loops) {
      Outline& outline = block.outlines.emplace_back();
      for (const int v : loop) outline.push_back(solid.vertices[at(v)].point);
      std::ranges::reverse(outline);
    }
    const Vec3 corner = block.outlines[0][0];
    block.ground_m = corner.z;
    block.top_m = tops.at({corner.x, corner.y});
    for (Outline& outline : block.outlines)
      std::ranges::transform(outline, outline.begin(), seen_from_above);
  }
  return blocks;
}

/// The outlines of all blocks simplified at the same time, so that none comes to touch another.
int simplify(std::vector<UprightBlock>& blocks, const OutlineLimits& limits) {
  std::vector<Outline> all;
  for (const UprightBlock& block : blocks)
    all.insert(all.end(), block.outlines.begin(), block.outlines.end());
  const int left = simplify_outlines(all, limits);
  auto next = all.begin();
  for (UprightBlock& block : blocks)
    for (Outline& outline : block.outlines) outline = std::move(*next++);
  return left;
}

}  // namespace

std::optional<SimplerFootprint> simplify_footprint(const Solid& solid, const BlockOptions& options,
                                                   const Tolerances& tolerances) {
  std::vector<UprightBlock> blocks = blocks_of(solid);
  SimplerFootprint out;
  out.short_edges = simplify(
      blocks, {options.least_edge_m, tolerances.weld_m, options.may_cover, options.is_shared});
  auto made = solid_of(blocks, tolerances);
  if (!made) return std::nullopt;
  out.solid = std::move(*made);
  return out;
}

}  // namespace oriel::detail
