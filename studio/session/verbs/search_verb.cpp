#include "oriel/explain.h"
#include "oriel/interpret.h"
#include "studio/session/desk.h"
#include "studio/session/labels/pack_answer.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace oriel::studio {

namespace {

/// Features of buildings, and buildings, that a text may mean.
struct FoundParts {
  StudioJson parts = StudioJson::array();
  StudioJson buildings = StudioJson::array();

  [[nodiscard]] bool empty() const { return parts.empty() && buildings.empty(); }
};

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

class PartSearch {
 public:
  PartSearch(const LabelledBuildings& all, std::string text) : all_(all), text_(std::move(text)) {}

  /// Features of a class, or of one beneath it; "unknown": of none.
  [[nodiscard]] FoundParts by_label() const {
    const auto classes = classes_of(all_.rules);
    std::vector<bool> is_wanted(classes.size());
    bool has_any = text_ == "unknown";
    for (std::size_t i = 0; i < classes.size(); ++i) {
      const int parent = classes[i].parent;
      is_wanted[i] =
          classes[i].name == text_ || (parent >= 0 && is_wanted[static_cast<std::size_t>(parent)]);
      has_any = has_any || is_wanted[i];
    }
    if (!has_any) return {};
    return features_where([&](const LabelledFeatures& labelled, std::size_t feature) {
      const int number = labelled.classes[feature];
      return number < 0 ? text_ == "unknown" : is_wanted[static_cast<std::size_t>(number)];
    });
  }

  /// Features that a rule decided.
  [[nodiscard]] FoundParts by_rule() const {
    const auto rules = rules_of(all_.rules);
    if (std::ranges::find(rules, text_, &RuleOfPack::id) == rules.end()) return {};
    return features_where([&](const LabelledFeatures& labelled, std::size_t feature) {
      return labelled.interpretation.verdicts[feature].rule == text_;
    });
  }

  /// Buildings and features whose id begins with it; without such, features by their names.
  [[nodiscard]] FoundParts by_id() const {
    FoundParts found = features_where([&](const LabelledFeatures& labelled, std::size_t feature) {
      return labelled.building->features[feature].id.starts_with(text_);
    });
    for (std::size_t number = 0; number < all_.buildings.size(); ++number) {
      const auto& labelled = all_.buildings[number];
      if (labelled && labelled->building->building->id.find(text_) != std::string::npos)
        found.buildings.push_back(number);
    }
    return found.empty() ? by_name() : found;
  }

 private:
  template <class IsWanted>
  [[nodiscard]] FoundParts features_where(const IsWanted& is_wanted) const {
    FoundParts found;
    for (std::size_t number = 0; number < all_.buildings.size(); ++number) {
      if (!all_.buildings[number]) continue;
      const LabelledFeatures& labelled = *all_.buildings[number];
      for (std::size_t feature = 0; feature < labelled.classes.size(); ++feature)
        if (is_wanted(labelled, feature)) found.parts.push_back({number, feature});
    }
    return found;
  }

  [[nodiscard]] FoundParts by_name() const {
    FoundParts found;
    for (std::size_t number = 0; number < all_.buildings.size(); ++number) {
      if (!all_.buildings[number]) continue;
      const LabelledFeatures& labelled = *all_.buildings[number];
      const PipelineResult& result = labelled.building->segmented;
      if (!result.is_done()) continue;
      const auto names =
          feature_names(*result.segmentation, result.description.table, &labelled.interpretation);
      for (const std::size_t feature : find_names(names, text_))
        found.parts.push_back({number, feature});
    }
    return found;
  }

  const LabelledBuildings& all_;
  std::string text_;
};

/// Those for which a condition holds; what is wrong with it goes into `issues`.
FoundParts by_condition(Desk& desk, const LabelledBuildings& all, const std::string& text,
                        std::vector<Issue>& issues) {
  const auto selection = read_selection(text, all.text, desk.file.name(), all.assignments);
  issues = selection.issues;
  FoundParts found;
  if (!selection.value) return found;
  std::vector<std::vector<FeatureId>> features(all.buildings.size());
  desk.options.for_each(all.buildings.size(), [&](std::size_t number) {
    if (!all.buildings[number]) return;
    const Description& description = all.buildings[number]->building->segmented.description;
    features[number] = selection.value->find(description.table, description.graph);
  });
  for (std::size_t number = 0; number < features.size(); ++number)
    for (const FeatureId feature : features[number]) found.parts.push_back({number, feature.value});
  return found;
}

}  // namespace

StudioJson answer_search(Desk& desk, const RequestBody& body) {
  const std::string text = trimmed(body.text("text"));
  const auto all = desk.runner.need_current();
  std::vector<Issue> issues;
  FoundParts found;
  if (!text.empty()) {
    const PartSearch search(*all, text);
    found = search.by_label();
    if (found.empty()) found = search.by_rule();
    if (found.empty()) found = search.by_id();
    if (found.empty()) found = by_condition(desk, *all, text, issues);
  }
  StudioJson findings = StudioJson::array();
  for (const Issue& issue : issues) findings.push_back(finding_json(issue));
  return {{"parts", std::move(found.parts)},
          {"buildings", std::move(found.buildings)},
          {"findings", std::move(findings)}};
}

}  // namespace oriel::studio
