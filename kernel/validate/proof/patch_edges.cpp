#include "kernel/validate/proof/patch_edges.h"

#include "kernel/base/index.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/geometry/exact.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

namespace oriel::detail {

std::optional<PatchCorners> twins_of(const Patches& patches) {
  struct CornerEdge {
    int low, high;
    PatchCornerId corner;
  };
  const auto& corners = patches.corners;
  std::vector<CornerEdge> edges;
  edges.reserve(corners.size());
  for (const PatchCornerId c : corners.ids()) {
    const auto [low, high] = std::minmax({corners[c].vertex, corners[corners[c].next].vertex});
    edges.push_back({low, high, c});
  }
  std::ranges::sort(edges, {}, [](const CornerEdge& edge) {
    return std::tuple(edge.low, edge.high, edge.corner);
  });
  if (edges.size() % 2 != 0) return std::nullopt;
  PatchCorners twins(corners.size());
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    const CornerEdge &one = edges[i], &other = edges[i + 1];
    const bool are_two = one.low == other.low && one.high == other.high;
    const bool are_more =
        i + 2 < edges.size() && edges[i + 2].low == one.low && edges[i + 2].high == one.high;
    const auto &from = corners[one.corner], &back = corners[other.corner];
    if (!are_two || are_more || from.vertex == back.vertex || from.patch == back.patch)
      return std::nullopt;
    twins[one.corner] = other.corner;
    twins[other.corner] = one.corner;
  }
  return twins;
}

bool is_one_fan_at_each_vertex(const Patches& patches, const PatchCorners& twins) {
  const auto& corners = patches.corners;
  DisjointSets fans(corners.size());
  int last = -1;
  for (const PatchCornerId c : corners.ids()) {
    fans.unite(c.value, corners[twins[c]].next.value);
    last = std::max(last, corners[c].vertex);
  }
  std::vector<int> fan_at(at(last + 1), -1);  // by vertex
  for (const PatchCornerId c : corners.ids()) {
    int& fan = fan_at[at(corners[c].vertex)];
    if (fan < 0) fan = fans.find(c.value);
    if (fan != fans.find(c.value)) return false;
  }
  return true;
}

bool is_one_piece(const Patches& patches, const PatchCorners& twins) {
  DisjointSets pieces(patches.patches.size());
  for (const PatchCornerId c : twins.ids())
    pieces.unite(patches.corners[c].patch.value, patches.corners[twins[c]].patch.value);
  for (const PatchId p : patches.patches.ids())
    if (pieces.find(p.value) != 0) return false;
  return true;
}

bool look_outwards(const SnappedBuilding& building, const Patches& patches) {
  using exact::Int128;
  const MicrometrePoint& origin = building.point(patches.corners[PatchCornerId{0}].vertex);
  const auto seen = [&](int vertex) {
    const MicrometrePoint& p = building.point(vertex);
    return std::array<Int128, 3>{p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
  };
  // Six times the volume below the fans of all rings: as rings lie in planes any triangles do.
  Int128 volume = 0;
  PatchCornerId first{0};
  for (const PatchCornerId c : patches.corners.ids()) {
    const PatchCornerId next = patches.corners[c].next;
    if (next <= c) {
      first = PatchCornerId{c.value + 1};
      continue;
    }
    const auto a = seen(patches.corners[first].vertex);
    const auto b = seen(patches.corners[c].vertex);
    const auto d = seen(patches.corners[next].vertex);
    volume += a[0] * (b[1] * d[2] - b[2] * d[1]) - a[1] * (b[0] * d[2] - b[2] * d[0]) +
              a[2] * (b[0] * d[1] - b[1] * d[0]);
  }
  return volume > 0;
}

}  // namespace oriel::detail
