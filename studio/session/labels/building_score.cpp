#include "studio/session/labels/building_score.h"

#include <utility>

namespace oriel::studio {

namespace {

constexpr const char* kNothing = "-";

std::vector<Prediction> predictions_of(const OpenBuilding& building,
                                       const Interpretation& interpretation) {
  std::vector<Prediction> predictions;
  predictions.reserve(building.features.size());
  for (std::size_t i = 0; i < building.features.size(); ++i) {
    const Verdict& verdict = interpretation.verdicts.at(i);
    Prediction& prediction = predictions.emplace_back();
    prediction.building = building.building->id;
    prediction.id = building.features[i].id;
    prediction.label = verdict.label.text();
    prediction.box = building.features[i].box;
    prediction.score = verdict.score;
    prediction.rule = verdict.rule.text();
  }
  return predictions;
}

}  // namespace

std::optional<std::vector<ExpectedObject>> TruthOfSession::of(const OpenBuilding& building) const {
  std::vector<Issue> issues;
  const std::string& id = building.building->id;
  const auto corrected = corrections.find(id, building.features, issues);
  if (corrected.empty()) return building.truth;
  std::vector<ExpectedObject> truth = building.truth.value_or(std::vector<ExpectedObject>{});
  // The truth of a corrected feature is what the person says, whatever the files say of it.
  std::vector<ExpectedObject> objects =
      objects_of_corrections(id, building.features, corrected, truth);
  truth.insert(truth.end(), std::make_move_iterator(objects.begin()),
               std::make_move_iterator(objects.end()));
  return truth;
}

BuildingScore score_building(const OpenBuilding& building, const Interpretation& interpretation,
                             const std::vector<ExpectedObject>& truth) {
  const std::vector<Prediction> predictions = predictions_of(building, interpretation);
  const ScoreOptions options;
  BuildingScore result;
  for (ObjectMatch match : match_features(predictions, truth, options)) {
    ComparedFeature compared;
    if (match.prediction != nullptr)
      compared.feature = static_cast<int>(match.prediction - predictions.data());
    const bool is_missed = match.outcome == MatchOutcome::not_found;
    if (is_missed) match.prediction = nullptr;
    add(match, options, result.score);
    if (match.outcome == MatchOutcome::left_out) continue;
    compared.truth = match.truth != nullptr ? match.truth->label : kNothing;
    compared.label = match.prediction != nullptr ? match.prediction->label : kNothing;
    if (is_missed) compared.object = match.truth->id;
    if (match.prediction != nullptr) {
      auto& [right, wrong] = result.rules[match.prediction->rule];
      ++(match.outcome == MatchOutcome::right ? right : wrong);
    }
    result.compared.push_back(std::move(compared));
  }
  return result;
}

}  // namespace oriel::studio
