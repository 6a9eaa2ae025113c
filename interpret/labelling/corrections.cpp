#include "interpret/labelling/corrections.h"

#include "kernel/base/sha256.h"
#include "kernel/base/text/printable.h"
#include "kernel/base/text/suggest.h"
#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// A point that somebody picks on a page or in a viewer is rounded, and lies on a face of the box.
constexpr double kPickReach_m = 0.05;

std::string class_text(const std::string& label) { return label.empty() ? "unknown" : label; }

Issue correction_warning(Code code, const Correction& correction, std::string sentence) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = code;
  issue.place = correction.place;
  issue.sentence = std::move(sentence);
  return issue;
}

std::optional<std::size_t> feature_with_id(std::span<const PlacedFeature> features,
                                           const std::string& id) {
  const auto found = std::ranges::find(features, id, &PlacedFeature::id);
  if (id.empty() || found == features.end()) return std::nullopt;
  return static_cast<std::size_t>(found - features.begin());
}

std::optional<std::size_t> feature_at(std::span<const PlacedFeature> features, const Vec3& point) {
  std::optional<std::size_t> best;
  const auto size = [&](std::size_t i) {
    return std::pair<double, std::string_view>(volume_m3(grown(features[i].box, kPickReach_m)),
                                               features[i].id);
  };
  for (std::size_t i = 0; i < features.size(); ++i)
    if (contains(features[i].box, point, kPickReach_m) && (!best || size(i) < size(*best)))
      best = i;
  return best;
}

/// Which feature a correction means.
std::optional<std::size_t> feature_of_correction(std::span<const PlacedFeature> features,
                                                 const Correction& correction,
                                                 std::vector<Issue>& issues) {
  if (const auto found = feature_with_id(features, correction.feature)) return found;
  const auto at_point = correction.point ? feature_at(features, *correction.point) : std::nullopt;
  const std::string id = printable(correction.feature);
  const std::string building = printable(correction.building);
  if (at_point && !correction.feature.empty())
    issues.push_back(correction_warning(
        Code::E155, correction,
        fmt::format("the building '{}' has no feature '{}' any more; the one at the point is '{}'",
                    building, id, printable(features[*at_point].id))));
  if (at_point) return at_point;
  if (correction.feature.empty())
    issues.push_back(correction_warning(
        Code::E153, correction,
        fmt::format("no feature of the building '{}' is at the point", building)));
  else
    issues.push_back(correction_warning(
        Code::E153, correction,
        fmt::format("the building '{}' has no feature '{}'{}; ids change with the model and with "
                    "options that change how it is cut",
                    building, id, correction.point ? " and none at the point" : "")));
  return std::nullopt;
}

Issue contradiction(const Correction& first, const Correction& second, const std::string& feature) {
  return correction_warning(
      Code::E154, second,
      fmt::format(
          "the feature '{}' of the building '{}' is called {} here and {} at {}:{}: neither "
          "is used",
          printable(feature), printable(second.building), printable(class_text(second.label)),
          printable(class_text(first.label)), printable(first.place.file), first.place.line));
}

std::string digest_of(const std::vector<Correction>& corrections) {
  std::string text;
  for (const Correction& c : corrections) {
    text += fmt::format("{}\n{}\n{}\n{}\n{}\n", c.building, c.feature, c.label, c.by, c.why);
    if (c.point) text += fmt::format("{} {} {}\n", c.point->x, c.point->y, c.point->z);
  }
  return sha256(text);
}

}  // namespace

std::vector<Issue> drop_unknown_classes(std::vector<Correction>& corrections,
                                        const std::vector<std::string>& labels) {
  std::vector<Issue> issues;
  const auto is_unknown = [&](const Correction& correction) {
    return !correction.label.empty() && !contains(labels, correction.label);
  };
  for (const Correction& correction : corrections)
    if (is_unknown(correction))
      issues.push_back(correction_warning(
          Code::E153, correction,
          fmt::format("the pack has no class '{}'{}", printable(correction.label),
                      did_you_mean(correction.label, labels))));
  std::erase_if(corrections, is_unknown);
  return issues;
}

Corrections::Corrections(const std::vector<Correction>& corrections)
    : sha256_(digest_of(corrections)) {
  for (const Correction& correction : corrections)
    by_building_[correction.building].push_back(correction);
}

std::vector<CorrectedFeature> Corrections::find(const std::string& building,
                                                std::span<const PlacedFeature> features,
                                                std::vector<Issue>& issues) const {
  const auto found = by_building_.find(building);
  if (found == by_building_.end()) return {};
  std::map<std::size_t, const Correction*> first;
  std::set<std::size_t> contested;
  for (const Correction& correction : found->second) {
    const auto feature = feature_of_correction(features, correction, issues);
    if (!feature) continue;
    const auto [known, is_new] = first.emplace(*feature, &correction);
    if (is_new || known->second->label == correction.label) continue;
    contested.insert(*feature);
    issues.push_back(contradiction(*known->second, correction, features[*feature].id));
  }
  std::vector<CorrectedFeature> corrected;
  for (const auto& [feature, correction] : first)
    if (!contested.contains(feature)) corrected.push_back({feature, correction});
  return corrected;
}

std::vector<Issue> Corrections::unknown_buildings(const std::set<std::string>& seen) const {
  std::vector<Issue> issues;
  const std::vector<std::string> names(seen.begin(), seen.end());
  for (const auto& [building, corrections] : by_building_)
    if (!seen.contains(building))
      issues.push_back(
          correction_warning(Code::E153, corrections.front(),
                             fmt::format("there is no building '{}'{}", printable(building),
                                         did_you_mean(building, names))));
  return issues;
}

void correct(std::span<const CorrectedFeature> corrected, Interpretation& interpretation) {
  for (const auto& [feature, correction] : corrected) {
    Verdict& verdict = interpretation.verdicts.at(feature);
    const std::string before = verdict.label.text();
    verdict.runner_up = before == correction->label ? verdict.runner_up : verdict.label;
    verdict.label = correction->label;
    verdict.rule = kCorrectedRule;
    verdict.score = verdict.margin = 1;
    if (before == correction->label) continue;
    for (Group& group : interpretation.groups) std::erase(group.members, verdict.feature);
  }
  std::erase_if(interpretation.groups, [](const Group& group) { return group.members.empty(); });
}

std::vector<ExpectedObject> objects_of_corrections(const std::string& building,
                                                   std::span<const PlacedFeature> features,
                                                   std::span<const CorrectedFeature> corrected,
                                                   std::span<const ExpectedObject> truth,
                                                   const ScoreOptions& options) {
  const auto is_there = [&](const Box& box) {
    return std::ranges::any_of(truth, [&](const ExpectedObject& object) {
      return intersection_over_union(grown(object.box, options.grow_m),
                                     grown(box, options.grow_m)) >= options.min_iou;
    });
  };
  std::vector<ExpectedObject> objects;
  std::set<std::size_t> known;
  for (const auto& [feature, correction] : corrected) {
    known.insert(feature);
    if (correction->label.empty() || is_there(features[feature].box)) continue;
    objects.push_back({building, "corrected_" + features[feature].id, correction->label, "",
                       features[feature].box, true});
  }
  if (!truth.empty()) return objects;
  for (std::size_t i = 0; i < features.size(); ++i)
    if (!known.contains(i))
      objects.push_back(
          {building, "not_corrected_" + features[i].id, "", "", features[i].box, false});
  return objects;
}

}  // namespace oriel
