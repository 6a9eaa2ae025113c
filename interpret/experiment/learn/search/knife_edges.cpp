#include "interpret/experiment/learn/search/knife_edges.h"

#include "interpret/language/quantity.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

namespace oriel {

namespace {

/// How many true objects are found in one of two outcomes and not in the other, at least.
std::size_t objects_between(const LabelOutcome& p, const LabelOutcome& q) {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < p.counts.size(); ++i) {
    const auto found = static_cast<long>(p.counts[i].true_positives);
    sum +=
        static_cast<std::size_t>(std::abs(found - static_cast<long>(q.counts[i].true_positives)));
  }
  return sum;
}

class EdgeFinder {
 public:
  EdgeFinder(const LearningSet& set, const Setting& setting)
      : set_(set), setting_(setting), all_(set.samples().size()) {
    std::iota(all_.begin(), all_.end(), std::size_t{0});
  }

  std::optional<KnifeEdge> edge_of(std::size_t param, double least_change) {
    const rules::Param& said = set_.pack().params[param];
    const auto [low, high] = *said.range;
    const double value = setting_[param];
    const double reach =
        std::max(kSmallShareOfRange * (high - low), kSmallShareOfValue * std::abs(value));
    const auto curves = set_.curves(setting_, param, all_);
    std::vector<const ParamCurve*> of;
    LabelOutcome here;
    for (const ParamCurve& curve : curves) {
      of.push_back(&curve);
      here.add(curve.at_value);
    }
    const double objective = set_.value(here);
    KnifeEdge edge{said.name, rules::unit_of(said.dimension), value, 0, 1, 0, 0};
    for (const CurveStretch& stretch : sum_of(of, low, high)) {
      if (stretch.from > value + reach || stretch.to < value - reach) continue;
      const double change = set_.value(stretch.sum) - objective;
      if (std::abs(change) < least_change) continue;
      const double flip = std::clamp(value, stretch.from, stretch.to);
      const double share = std::abs(flip - value) / (high - low);
      if (share < edge.distance_share) {
        edge.flip = flip;
        edge.distance_share = share;
      }
      if (std::abs(change) <= std::abs(edge.change)) continue;
      edge.change = change;
      edge.objects = objects_between(here, stretch.sum);
    }
    return edge.change == 0 ? std::nullopt : std::optional(edge);
  }

 private:
  const LearningSet& set_;
  const Setting& setting_;
  std::vector<std::size_t> all_;
};

}  // namespace

std::vector<KnifeEdge> knife_edges(const LearningSet& set, const Setting& setting,
                                   double least_change) {
  std::vector<KnifeEdge> edges;
  EdgeFinder finder(set, setting);
  for (const std::size_t param : set.params())
    if (auto edge = finder.edge_of(param, least_change)) edges.push_back(std::move(*edge));
  std::ranges::sort(edges, {},
                    [](const KnifeEdge& e) { return std::tuple(-std::abs(e.change), e.param); });
  return edges;
}

}  // namespace oriel
