#include "kernel/describe/features/relations.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace oriel::detail {

namespace {

/// How far apart features may stand to be beside or above one another, and to be alike in the
/// neighbourhood.
constexpr double kNextTo_m = 1;
constexpr double kNeighbourhood_m = 6;
constexpr double kAlike = 0.1;

FeatureId id(std::size_t i) { return FeatureId{static_cast<int>(i)}; }

double overlap(const Extent& p, const Extent& q) {
  return std::min(p.high, q.high) - std::max(p.low, q.low);
}

bool is_like(double p, double q) { return std::abs(p - q) <= kAlike * std::max(p, q); }

bool is_alike(const InFacade& p, const InFacade& q) {
  // The square root comes last: most pairs differ in what is told quickly.
  const double along = p.across.middle() - q.across.middle();
  const double up = p.height.middle() - q.height.middle();
  return p.kind == q.kind && std::abs(along) <= kNeighbourhood_m &&
         std::abs(up) <= kNeighbourhood_m && is_like(p.a, q.a) && is_like(p.b, q.b) &&
         std::hypot(along, up) <= kNeighbourhood_m;
}

bool is_beside(const InFacade& p, const InFacade& q) {
  return overlap(p.height, q.height) > 0 && -overlap(p.across, q.across) <= kNextTo_m;
}

/// q is above p.
bool is_above(const InFacade& p, const InFacade& q) {
  const double gap = q.height.low - p.height.high;
  return overlap(p.across, q.across) > 0 && q.height.middle() > p.height.middle() &&
         std::abs(gap) <= kNextTo_m;
}

std::vector<FeatureGraph::Pair> contained(const Segmentation& segmentation) {
  std::vector<FeatureGraph::Pair> pairs;
  for (std::size_t i = 0; i < segmentation.features.size(); ++i) {
    FeatureId host = segmentation.features[i].host;
    // A chain of hosts is no longer than the number of features.
    for (std::size_t steps = 0; host.is_valid() && steps < segmentation.features.size(); ++steps) {
      pairs.emplace_back(host, id(i));
      host = segmentation.features[host.index()].host;
    }
  }
  return pairs;
}

}  // namespace

std::vector<int> storeys_of(std::span<const InFacade> features, std::span<const char> is_opening) {
  std::vector<std::size_t> openings;
  for (std::size_t i = 0; i < features.size(); ++i)
    if (is_opening[i]) openings.push_back(i);
  std::ranges::sort(openings, {},
                    [&](std::size_t i) { return std::tuple(features[i].height.middle(), i); });
  std::vector<int> storeys(features.size(), -1);
  // Sorted by their middles, the members of a storey follow one another; each is compared with the
  // storey's tallest kin so far, so that a chain of half-level windows does not tie two storeys
  // together.
  int storey = -1;
  Extent kin;
  for (const std::size_t i : openings) {
    const Extent& height = features[i].height;
    if (storey < 0 || overlap(kin, height) < 0.5 * std::max(kin.size(), height.size())) {
      ++storey;
      kin = height;
    } else if (height.size() > kin.size()) {
      kin = height;
    }
    storeys[i] = storey;
  }
  return storeys;
}

FeatureGraph relate(const Segmentation& segmentation, std::span<const InFacade> features,
                    std::span<const int> storeys, const AskedRelations& asked, Work& work) {
  std::vector<FeatureGraph::Pair> hosts, alike, beside, above;
  for (std::size_t i = 0; i < segmentation.features.size(); ++i)
    if (segmentation.features[i].host.is_valid())
      hosts.emplace_back(id(i), segmentation.features[i].host);

  std::vector<int> facades;
  for (const InFacade& f : features) facades.push_back(f.facade);
  FeatureGraph graph;
  graph.set_classes("same_facade", facades);
  graph.set_classes("same_storey", storeys);
  // Feature by feature, so that the pairs come sorted.
  const FeatureLinks& same_facade = graph.links("same_facade");
  for (std::size_t i = 0; i < same_facade.list_of.size(); ++i) {
    if (same_facade.list_of[i] < 0) continue;
    const InFacade& p = features[i];
    const auto others = same_facade.list(static_cast<std::size_t>(same_facade.list_of[i]));
    work.add(std::ssize(others));
    if (work.is_used_up()) break;
    for (const int other : others) {
      if (other == static_cast<int>(i)) continue;
      const InFacade& q = features[static_cast<std::size_t>(other)];
      if (asked.alike && is_alike(p, q)) alike.emplace_back(id(i), FeatureId{other});
      if (asked.beside && is_beside(p, q)) beside.emplace_back(id(i), FeatureId{other});
      if (asked.above && is_above(p, q)) above.emplace_back(id(i), FeatureId{other});
    }
  }
  graph.set("host", std::move(hosts));
  std::vector<FeatureGraph::Pair> contains = contained(segmentation), inside;
  for (const auto& [outer, inner] : contains) inside.emplace_back(inner, outer);
  graph.set("contains", std::move(contains));
  graph.set("inside", std::move(inside));
  graph.set("alike", std::move(alike));
  graph.set("beside", std::move(beside));
  graph.set("above", std::move(above));
  return graph;
}

}  // namespace oriel::detail
