#include "kernel/validate/weld_written.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/near_points.h"
#include "kernel/solidify/shells/shells.h"
#include "model/whole_point.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace oriel {

namespace {

/// By vertex as written the first one of those that lie so near each other that they are one.
std::vector<int> near_vertices(const Building& written) {
  constexpr double kPerMetre = 1e6;
  std::vector<MicrometrePoint> points;
  for (const Vec3 v : written.vertices)
    points.push_back({std::llround(v.x * kPerMetre), std::llround(v.y * kPerMetre),
                      std::llround(v.z * kPerMetre)});
  std::vector<MicrometrePoint> sorted = points;
  std::ranges::sort(sorted);
  const auto doubles = std::ranges::unique(sorted);
  sorted.erase(doubles.begin(), doubles.end());
  const Numbers first = group_near_points(sorted, ValidateOptions{}.snap_m * kPerMetre + 1);
  std::vector<int> group;
  for (const MicrometrePoint& p : points)
    group.push_back(first[at(std::ranges::lower_bound(sorted, p) - sorted.begin())]);
  return group;
}

/// By vertex of the solid the first one that is one point with it as they are written.
std::vector<int> first_of_each_point(const Solid& solid, const Building& written) {
  const std::vector<int> group = near_vertices(written);
  std::vector<int> first(solid.vertices.size(), -1);
  std::map<int, int> vertex_at;  // by group
  for (const Polygon& polygon : written.polygons) {
    const auto& loops = solid.facets[at(polygon.source)].loops;
    for (std::size_t r = 0; r < loops.size(); ++r)
      for (std::size_t i = 0; i < loops[r].size(); ++i)
        first[at(loops[r][i])] =
            vertex_at.try_emplace(group[at(polygon.rings[r][i])], loops[r][i]).first->second;
  }
  return first;
}

/// Empty if less than a triangle is left.
Loop welded(const Loop& loop, std::span<const int> first) {
  Loop out;
  for (const int v : loop)
    if (out.empty() || out.back() != first[at(v)]) out.push_back(first[at(v)]);
  while (out.size() > 1 && out.front() == out.back()) out.pop_back();
  return std::set<int>(out.begin(), out.end()).size() < 3 ? Loop{} : out;
}

/// Facets whose outer loop is gone leave, with what was in them.
std::vector<int> weld_facets(Solid& solid, std::span<const int> first) {
  std::vector<int> whole_of, number_of(solid.facets.size(), -1);
  std::vector<Facet> facets;
  for (std::size_t f = 0; f < solid.facets.size(); ++f) {
    Facet& facet = solid.facets[f];
    for (Loop& loop : facet.loops) loop = welded(loop, first);
    if (facet.loops[0].empty()) continue;
    std::erase_if(facet.loops, [](const Loop& loop) { return loop.empty(); });
    number_of[f] = static_cast<int>(facets.size());
    whole_of.push_back(static_cast<int>(f));
    facets.push_back(std::move(facet));
  }
  solid.facets = std::move(facets);
  for (Shell& shell : solid.shells) {
    std::erase_if(shell.facets, [&](FacetId f) { return number_of[f.index()] < 0; });
    for (FacetId& f : shell.facets) f = FacetId{number_of[f.index()]};
  }
  std::erase_if(solid.shells, [](const Shell& shell) { return shell.facets.empty(); });
  return whole_of;
}

}  // namespace

std::optional<PartedSolid> weld_written(const Solid& solid, const Building& written,
                                        std::span<const Finding> findings) {
  ORIEL_ASSERT(written.polygons.size() == solid.facets.size(), "one polygon for each facet");
  if (std::ranges::find(findings, Code::E312, &Finding::code) == findings.end())
    return std::nullopt;
  PartedSolid out{solid, {}};
  const std::vector<int> first = first_of_each_point(solid, written);
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] < 0 || first[v] == static_cast<int>(v)) continue;
    // It stands for others that lie in other planes.
    Vertex& kept = out.solid.vertices[at(first[v])];
    kept = {exact::to_metres(exact::round_to_grid(kept.point, solid.grid_m), solid.grid_m), false};
  }
  out.whole_of = weld_facets(out.solid, first);
  arrange_planes_and_loops(out.solid);
  return out;
}

}  // namespace oriel
