#include "interpret/detail/names.h"
#include "interpret/detail/pack.h"
#include "interpret/profile.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace oriel {

namespace {

/// What reaches the ground begins no higher than a threshold over it.
constexpr double kOnGround_m = 0.3;

class ProfilePlanner {
 public:
  ProfilePlanner(Plan plan, const Profile& profile, const RuleBase& base,
                 const Segmentation& segmentation, const FeatureTable& table,
                 const Interpretation& interpretation, std::optional<double> scale)
      : plan_(std::move(plan)),
        profile_(profile),
        pack_(base.pack()),
        segmentation_(segmentation),
        table_(table),
        interpretation_(interpretation),
        thresholds_(profile.thresholds(scale)),
        reason_(segmentation.features.size()),
        is_open_(segmentation.features.size(), 1),
        is_held_(segmentation.features.size(), 0) {
    for (const Step& step : plan_.steps) is_open_[step.feature.index()] = 0;
  }

  Plan run() {
    for (int i = 0; i < std::ssize(segmentation_.features); ++i)
      if (is_open_[static_cast<std::size_t>(i)] != 0) decide({i});
    spare_carriers();
    for (int i = 0; i < std::ssize(segmentation_.features); ++i)
      if (const std::string& why = reason_[static_cast<std::size_t>(i)]; !why.empty())
        plan_.steps.push_back({FeatureId{i}, "omit", profile_.title() + "/" + why});
    std::ranges::stable_sort(plan_.steps, {}, &Step::feature);
    return std::move(plan_);
  }

 private:
  [[nodiscard]] bool is_in(FeatureId id, const std::vector<std::string>& classes) const {
    const auto label = rules::index_of(pack_.classes, interpretation_.verdicts[id.index()].label);
    return label != rules::kNoClass && std::ranges::any_of(classes, [&](const std::string& name) {
             return rules::is_within(pack_.classes, label, rules::index_of(pack_.classes, name));
           });
  }

  void decide(FeatureId id) {
    const Feature& feature = segmentation_.features[id.index()];
    std::string& why = reason_[id.index()];
    if (is_in(id, profile_.keep)) return hold(id);
    const bool may_go =
        !profile_.on_ground || !reaches_ground(id) || is_in(id, *profile_.on_ground);
    if (!may_go) return hold(id);
    if (is_in(id, profile_.omit)) {
      why = "omit";
      return;
    }
    const bool is_unknown = interpretation_.verdicts[id.index()].label.empty();
    if (feature.sense == Sense::imprint) {
      if (is_unknown && profile_.omits_imprints) why = "imprint";
      return;
    }
    const auto a = table_.number(id, "a"), b = table_.number(id, "b"), c = table_.number(id, "c");
    if (!thresholds_ || !a || !b || !c) return;
    const Significance verdict = significance(*a, *b, *c, *thresholds_);
    if (verdict == Significance::keep) hold(id);
    if (profile_.omitted.contains(verdict)) why = to_string(verdict);
  }

  [[nodiscard]] bool reaches_ground(FeatureId id) const {
    const Sense sense = segmentation_.features[id.index()].sense;
    const auto height = table_.number(id, "height");
    return (sense == Sense::protrusion || sense == Sense::hole) && height && *height <= kOnGround_m;
  }

  void hold(FeatureId id) { is_held_[id.index()] = 1; }

  /// A feature that goes takes along what sits on it. If the profile holds on to that, and the
  /// feature goes for its size only, it stays too.
  void spare_carriers() {
    std::vector<FeatureId> staying;
    for (int i = 0; i < std::ssize(segmentation_.features); ++i)
      if (is_held_[static_cast<std::size_t>(i)] != 0) staying.push_back({i});
    while (!staying.empty()) {
      const Feature& feature = segmentation_.features[staying.back().index()];
      staying.pop_back();
      for (const FeatureId carrier : {feature.parent, feature.host}) {
        if (!carrier.is_valid() || !significance_of(reason_[carrier.index()])) continue;
        reason_[carrier.index()].clear();
        staying.push_back(carrier);
      }
    }
  }

  Plan plan_;
  const Profile& profile_;
  const rules::Pack& pack_;
  const Segmentation& segmentation_;
  const FeatureTable& table_;
  const Interpretation& interpretation_;
  std::optional<Thresholds> thresholds_;
  std::vector<std::string> reason_;  ///< by feature: why it goes; empty: it stays
  std::vector<char> is_open_;        ///< by feature: the plan had no step for it
  std::vector<char> is_held_;        ///< by feature: the profile wants it to stay
};

}  // namespace

Plan plan_by_profile(Plan plan, const Profile& profile, const RuleBase& base,
                     const Segmentation& segmentation, const FeatureTable& table,
                     const Interpretation& interpretation, std::optional<double> scale) {
  return ProfilePlanner(std::move(plan), profile, base, segmentation, table, interpretation, scale)
      .run();
}

}  // namespace oriel
