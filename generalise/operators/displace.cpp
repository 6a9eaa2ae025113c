#include "generalise/operators/displace.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace oriel {

namespace {

using detail::Extents;

/// Shifts and growths below this are rounding: Tolerances::weld_m.
constexpr double kNoShift_m = 0.001;

/// The ends of the wall along it.
std::pair<double, double> ends_of(const Solid& solid, const detail::Host& host) {
  double low = Box::kInfinity, high = -Box::kInfinity;
  for (const int v : solid.facets[host.facet.index()].loops[0]) {
    const double u = dot(solid.vertices[static_cast<std::size_t>(v)].point, host.u);
    low = std::min(low, u);
    high = std::max(high, u);
  }
  return {low, high};
}

}  // namespace

std::vector<double> least_shifts(const std::vector<double>& wished,
                                 const std::vector<double>& apart, double low, double high) {
  // With the distances taken off, positions need only ascend.
  std::vector<double> offset(wished.size(), 0);
  for (std::size_t i = 1; i < wished.size(); ++i) offset[i] = offset[i - 1] + apart[i - 1];
  struct Pool {
    double sum;
    std::size_t count;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < wished.size(); ++i) {
    pools.push_back({wished[i] - offset[i], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  const double highest = std::max(low, high - offset.back());
  std::vector<double> out;
  for (const Pool& pool : pools)
    for (std::size_t i = 0; i < pool.count; ++i)
      out.push_back(std::clamp(pool.mean(), low, highest) + offset[out.size()]);
  return out;
}

detail::Placed displace(const Redrawing& task) {
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall is not found any more"};
  const double to_m = task.number("to", 0), gap_m = task.gap_m();
  std::vector<Extents> members;
  std::vector<double> centres, apart;
  bool is_changed = false;
  for (std::size_t i = 0; i < task.steps.size(); ++i) {
    Extents one = extents_of(*host, task.segmentation, task.feature(i));
    if (task.feature(i).sense != Sense::hole || !is_box(task.feature(i), one))
      return {std::nullopt, "only recesses that are boxes can be displaced"};
    centres.push_back((one.u0 + one.u1) / 2);
    const double more = std::max(0.0, to_m - one.width());
    is_changed = is_changed || more > kNoShift_m;
    one.u0 -= more / 2;
    one.u1 += more / 2;
    if (i > 0) apart.push_back((members.back().width() + one.width()) / 2 + gap_m);
    members.push_back(one);
  }
  const auto [first, last] = ends_of(task.solid, *host);
  // A hair more than the gap, which is checked exactly.
  const double low = first + gap_m + members.front().width() / 2 + kNoShift_m;
  const double high = last - gap_m - members.back().width() / 2 - kNoShift_m;
  for (double& distance : apart) distance += kNoShift_m;
  if (std::accumulate(apart.begin(), apart.end(), low) > high)
    return {std::nullopt, "its wall has no room for the row"};
  const std::vector<double> places = least_shifts(centres, apart, low, high);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const double shift = places[i] - centres[i];
    is_changed = is_changed || std::abs(shift) > kNoShift_m;
    members[i].u0 += shift;
    members[i].u1 += shift;
  }
  if (!is_changed) return {std::nullopt, "there is room enough"};
  detail::Placed placed{task.solid, {}};
  for (std::size_t i = 0; i < members.size(); ++i) {
    placed = place_box(*placed.solid, *host, members[i], members[i].depth(), Attach::sink, gap_m,
                       task.feature(i).source_polygons);
    if (!placed.solid) return placed;
  }
  return placed;
}

}  // namespace oriel
