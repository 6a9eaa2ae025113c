#include "studio/session/labels/labelled_buildings.h"

#include "studio/session/work_log.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <unordered_map>
#include <utility>

namespace oriel::studio {

ClassNumbers numbers_of_classes(const RuleBase& rules) {
  ClassNumbers numbers;
  const auto classes = classes_of(rules);
  for (std::size_t i = 0; i < classes.size(); ++i)
    numbers.emplace(classes[i].name, static_cast<int>(i));
  return numbers;
}

std::vector<int> classes_of_features(const Interpretation& interpretation,
                                     const ClassNumbers& numbers) {
  std::vector<int> classes;
  classes.reserve(interpretation.verdicts.size());
  for (const Verdict& verdict : interpretation.verdicts) {
    const auto found = numbers.find(verdict.label.text());
    classes.push_back(found == numbers.end() ? -1 : found->second);
  }
  return classes;
}

namespace {

std::vector<int> doubtful_features(const Interpretation& interpretation,
                                   const FeatureTable& table) {
  std::vector<int> features;
  for (const Issue& issue : interpretation.issues) {
    if (issue.code != Code::R260) continue;
    const FeatureId feature = table.find(issue.place.feature);
    if (feature.is_valid()) features.push_back(feature.value);
  }
  std::ranges::sort(features);
  return features;
}

bool has_same_verdicts(const Interpretation& p, const Interpretation& q) {
  return std::ranges::equal(p.verdicts, q.verdicts, [](const Verdict& s, const Verdict& t) {
    return s.label == t.label && s.rule == t.rule && s.score == t.score;
  });
}

/// Labels the buildings one by one, perhaps several at a time.
class BuildingLabeller {
 public:
  BuildingLabeller(const LabelledBuildings& now, const TruthOfSession& truth,
                   const LabelledBuildings* before, WorkLog* log)
      : now_(now),
        truth_(truth),
        before_(before),
        log_(log),
        numbers_(numbers_of_classes(now.rules)),
        is_alike_(before != nullptr && is_labelling_alike(before->rules, now.rules)),
        has_same_classes_(before != nullptr && numbers_ == numbers_of_classes(before->rules)) {}

  std::shared_ptr<const LabelledFeatures> label(std::size_t number,
                                                const std::shared_ptr<const OpenBuilding>& open) {
    const auto known = known_of(number, *open);
    if (known && is_alike_ && known->truth_number == truth_.number) return known;
    auto labelled = std::make_shared<LabelledFeatures>();
    labelled->building = open;
    if (known && is_alike_)
      labelled->interpretation = known->interpretation;
    else
      interpret_features(number, *labelled);
    const FeatureTable& table = open->segmented.description.table;
    labelled->classes = classes_of_features(labelled->interpretation, numbers_);
    labelled->doubtful = doubtful_features(labelled->interpretation, table);
    const bool is_same = known && has_same_classes_ && known->classes == labelled->classes;
    labelled->since = is_same ? known->since : now_.number;
    add_score(known.get(), *labelled);
    return labelled;
  }

 private:
  [[nodiscard]] std::shared_ptr<const LabelledFeatures> known_of(std::size_t number,
                                                                 const OpenBuilding& open) const {
    if (before_ == nullptr || number >= before_->buildings.size()) return nullptr;
    const auto& known = before_->buildings[number];
    return known && known->building.get() == &open ? known : nullptr;
  }

  void interpret_features(std::size_t number, LabelledFeatures& labelled) const {
    const Description& description = labelled.building->segmented.description;
    const AtWork at_work(log_, WorkLog::Kind::building, number);
    labelled.interpretation = interpret(now_.rules, description.table, description.graph);
  }

  void add_score(const LabelledFeatures* known, LabelledFeatures& labelled) const {
    labelled.truth_number = truth_.number;
    if (known != nullptr && known->truth_number == truth_.number &&
        has_same_verdicts(known->interpretation, labelled.interpretation)) {
      labelled.score = known->score;
      return;
    }
    if (const auto truth = truth_.of(*labelled.building))
      labelled.score = score_building(*labelled.building, labelled.interpretation, *truth);
  }

  const LabelledBuildings& now_;
  const TruthOfSession& truth_;
  const LabelledBuildings* before_;
  WorkLog* log_;
  ClassNumbers numbers_;
  bool is_alike_;
  bool has_same_classes_;
};

}  // namespace

std::shared_ptr<const LabelledBuildings> label_buildings(LabelledBuildings labelled,
                                                         const BuildingList& buildings,
                                                         const TruthOfSession& truth,
                                                         const LabelledBuildings* before,
                                                         const LabellingRun& run) {
  labelled.buildings.assign(buildings.size(), nullptr);
  BuildingLabeller labeller(labelled, truth, before, run.log);
  std::atomic<bool> is_given_up = false;
  run.for_each(buildings.size(), [&](std::size_t number) {
    if (is_given_up || !buildings[number]) return;
    if (run.is_given_up())
      is_given_up = true;
    else
      labelled.buildings[number] = labeller.label(number, buildings[number]);
  });
  if (is_given_up) return nullptr;
  return std::make_shared<const LabelledBuildings>(std::move(labelled));
}

}  // namespace oriel::studio
