#include "interpret/pack/names.h"
#include "interpret/pack/pack.h"
#include "interpret/plan/profile.h"
#include "kernel/base/indexed_vector.h"
#include "model/tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace oriel {

namespace {

/// What reaches the ground begins no higher than a threshold over it.
constexpr double kOnGround_m = 0.3;

/// A door lies no deeper in its wall than a wall is thick. A deeper recess that reaches the ground
/// is part of the ground plan, whatever it is called: a passage, or a corner that is not built on.
constexpr double kWallDepth_m = 0.5;

/// What was enlarged to a length is as long as that when it is read again, rounded.
constexpr double kGrownEnough_m = 0.001;

/// Which features are parts of a building, not details on it, though they are short or thin. No
/// such feature goes for its size. Profile::MainPart says when.
class MainParts {
 public:
  MainParts(const Segmentation& segmentation, const FeatureTable& table,
            const Profile::MainPart& part, const Thresholds& sizes);

  /// The whole building is smaller than the least that the sizes let stand alone, or the feature is
  /// a storey, or a part of the main roof.
  [[nodiscard]] bool has(FeatureId id) const;

  /// Of features that go for their size the highest one, if without them the top of the building
  /// would sink by more than c, the height that a level is true to; else invalid. By feature:
  /// `goes` what goes, with all that it carries, `goes_for_size` what goes for its size.
  [[nodiscard]] FeatureId holder_of_ridge(const std::vector<char>& goes,
                                          const std::vector<char>& goes_for_size) const;

 private:
  const Segmentation& segmentation_;
  const FeatureTable& table_;
  const Profile::MainPart& part_;
  const Thresholds& sizes_;
  double building_m3_ = 0;
};

MainParts::MainParts(const Segmentation& segmentation, const FeatureTable& table,
                     const Profile::MainPart& part, const Thresholds& sizes)
    : segmentation_(segmentation), table_(table), part_(part), sizes_(sizes) {
  for (const Cell& cell : segmentation.cells) building_m3_ += cell.sign * cell.volume_m3;
}

bool MainParts::has(FeatureId id) const {
  if (building_m3_ <= sizes_.area_m2 * sizes_.c_m) return true;
  const auto height = table_.number(id, Attribute::height);
  const auto a = table_.number(id, Attribute::a), b = table_.number(id, Attribute::b),
             c = table_.number(id, Attribute::c);
  if (!height || !a || !b || !c || *height <= 0) return false;
  const Feature& feature = segmentation_.features[id.index()];
  const bool is_storey = *height >= part_.height_m && feature.volume_m3 >= part_.area_m2 * *height;
  const bool is_roof = feature.sense == Sense::protrusion &&
                       *a * *b * *c >= sizes_.area_m2 * *height;  // the standing box in plan
  return is_storey || is_roof;
}

FeatureId MainParts::holder_of_ridge(const std::vector<char>& goes,
                                     const std::vector<char>& goes_for_size) const {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  double rest_m = kNone;
  for (const Cell& cell : segmentation_.cells) {
    if (cell.sign < 0 || (cell.feature.is_valid() && goes[cell.feature.index()] != 0)) continue;
    for (const Facet& facet : cell.facets)
      for (const int v : facet.loops[0])
        rest_m = std::max(rest_m, segmentation_.vertices[at(v)].point.z);
  }
  FeatureId highest;
  double top_m = rest_m + sizes_.c_m;
  if (rest_m == kNone) return highest;
  for (const FeatureId i : ids_below<FeatureId>(segmentation_.features.size())) {
    const Feature& feature = segmentation_.features[i.index()];
    if (goes_for_size[i.index()] == 0 || feature.sense != Sense::protrusion) continue;
    if (feature.box.max.z <= top_m) continue;
    top_m = feature.box.max.z;
    highest = i;
  }
  return highest;
}

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
    if (thresholds_ && profile.part)
      main_parts_.emplace(segmentation, table, *profile.part, *thresholds_);
    for (const Step& step : plan_.steps) is_open_[step.feature.index()] = 0;
  }

  Plan run() {
    for (const FeatureId i : ids_below<FeatureId>(segmentation_.features.size()))
      if (is_open_[i.index()] != 0) decide(i);
    keep_ridge();
    spare_carriers();
    for (const FeatureId i : ids_below<FeatureId>(segmentation_.features.size()))
      if (const std::string& why = reason_[i.index()]; !why.empty())
        plan_.steps.push_back(step_for(i, why));
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
    const bool may_go = !profile_.on_ground || !reaches_ground(id) ||
                        (is_in(id, *profile_.on_ground) && !is_of_ground_plan(id));
    if (!may_go) return hold(id);
    if (is_in(id, profile_.omit) && !is_notch(id)) {
      why = "omit";
      return;
    }
    const bool is_unknown = interpretation_.verdicts[id.index()].label.empty();
    if (feature.sense == Sense::imprint) {
      if (is_unknown && profile_.omits_imprints) why = "imprint";
      return;
    }
    const auto a = table_.number(id, Attribute::a), b = table_.number(id, Attribute::b),
               c = table_.number(id, Attribute::c);
    if (!thresholds_ || !a || !b || !c) return;
    const Significance verdict = significance(*a, *b, *c, *thresholds_);
    if (verdict == Significance::keep || (main_parts_ && main_parts_->has(id))) return hold(id);
    if (verdict == Significance::sheet)
      why = why_sheet_goes(id);
    else if (profile_.omitted.contains(verdict))
      why = to_string(verdict);
  }

  /// Its place, if the profile has something to be done to sheets there. What is as thick as it is
  /// to become stays.
  [[nodiscard]] std::string why_sheet_goes(FeatureId id) const {
    const SheetPlace place = sheet_place(table_, id, thresholds_->c_m);
    const auto found = profile_.sheets.find(place);
    if (found == profile_.sheets.end()) return {};
    const bool is_done =
        found->second == "enlarge" && has_label(id) &&
        table_.number(id, Attribute::c).value_or(0) >= thresholds_->c_m - kGrownEnough_m;
    return is_done ? std::string() : to_string(place);
  }

  [[nodiscard]] bool has_label(FeatureId id) const {
    return !interpretation_.verdicts[id.index()].label.empty();
  }

  [[nodiscard]] Step step_for(FeatureId id, const std::string& why) const {
    Step step{id, "omit", profile_.title() + "/" + why};
    const auto place = sheet_place_of(why);
    if (!place) return step;
    step.operation = profile_.sheets.at(*place);
    const Sense sense = segmentation_.features[id.index()].sense;
    if (step.operation == "flatten" && sense == Sense::hole && has_label(id))
      step.operation = "collapse";
    if (step.operation == "omit" && *place == SheetPlace::enclosed && sense == Sense::protrusion)
      step.operation = "merge";
    if (step.operation != "enlarge") return step;
    if (has_label(id))
      step.numbers = {{"to", thresholds_->c_m}, {"gap", thresholds_->c_m}};
    else
      step.operation = "omit";
    return step;
  }

  [[nodiscard]] bool reaches_ground(FeatureId id) const {
    const Sense sense = segmentation_.features[id.index()].sense;
    const auto base_m = table_.number(id, Attribute::base_height);
    return (sense == Sense::protrusion || sense == Sense::hole) && base_m && *base_m <= kOnGround_m;
  }

  /// A recess on the ground that is deeper than a wall, or open to the sky: an opening has a
  /// lintel.
  [[nodiscard]] bool is_of_ground_plan(FeatureId id) const {
    const Feature& feature = segmentation_.features[id.index()];
    if (feature.sense != Sense::hole) return false;
    const auto depth = table_.number(id, Attribute::depth);
    return (depth && *depth > kWallDepth_m) || has_plane(id, is_roof);
  }

  /// A recess in a wall that has no ceiling: neither an opening nor a loggia, whatever it is
  /// called. Its size decides.
  [[nodiscard]] bool is_notch(FeatureId id) const {
    return segmentation_.features[id.index()].sense == Sense::hole && has_plane(id, is_roof) &&
           has_plane(id, [](const Plane& plane) { return std::abs(plane.normal.z) <= kWallLean; });
  }

  static bool is_roof(const Plane& plane) { return plane.normal.z > kWallLean; }

  template <class Test>
  [[nodiscard]] bool has_plane(FeatureId id, const Test& test) const {
    return std::ranges::any_of(segmentation_.features[id.index()].planes, [&](PlaneId plane) {
      return test(segmentation_.planes[plane.index()]);
    });
  }

  void hold(FeatureId id) { is_held_[id.index()] = 1; }

  [[nodiscard]] bool goes(FeatureId id) const {
    if (!reason_[id.index()].empty()) return true;
    const Feature& feature = segmentation_.features[id.index()];
    return (feature.parent.is_valid() && goes(feature.parent)) ||
           (feature.host.is_valid() && goes(feature.host));
  }

  /// What holds the ridge stays though it would go for its size.
  void keep_ridge() {
    if (!main_parts_) return;
    std::vector<char> goes_at_all(reason_.size()), goes_for_size(reason_.size());
    while (true) {
      for (int i = 0; i < std::ssize(reason_); ++i) {
        goes_at_all[at(i)] = goes({i}) ? 1 : 0;
        goes_for_size[at(i)] = is_verdict_of_size(reason_[at(i)]) ? 1 : 0;
      }
      const FeatureId id = main_parts_->holder_of_ridge(goes_at_all, goes_for_size);
      if (!id.is_valid()) return;
      reason_[id.index()].clear();
      hold(id);
    }
  }

  /// What sits on a feature is removed with it. If the profile holds on to that, and the
  /// feature goes for its size only, or hangs over the ground that the other one stands on, it
  /// stays too.
  void spare_carriers() {
    std::vector<FeatureId> staying;
    for (const FeatureId i : ids_below<FeatureId>(segmentation_.features.size()))
      if (is_held_[i.index()] != 0) staying.push_back(i);
    while (!staying.empty()) {
      const Feature& feature = segmentation_.features[staying.back().index()];
      const bool stands = profile_.on_ground && reaches_ground(staying.back());
      const double lowest_m = feature.box.min.z;
      staying.pop_back();
      for (const FeatureId carrier : {feature.parent, feature.host}) {
        if (!carrier.is_valid() || reason_[carrier.index()].empty()) continue;
        const bool is_for_size = is_verdict_of_size(reason_[carrier.index()]);
        const bool hangs_over =
            stands && segmentation_.features[carrier.index()].box.min.z > lowest_m + kOnGround_m;
        if (!is_for_size && !hangs_over) continue;
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
  std::optional<MainParts> main_parts_;
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
