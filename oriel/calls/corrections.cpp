#include "oriel/corrections.h"

#include <set>
#include <utility>

namespace oriel {

std::vector<PlacedFeature> placed_features(const Building& building,
                                           const Segmentation& segmentation,
                                           const FeatureTable& table) {
  std::vector<PlacedFeature> features;
  for (std::size_t i = 0; i < segmentation.features.size(); ++i)
    features.push_back({table.id(FeatureId{static_cast<int>(i)}),
                        segmentation.features[i].box.moved(building.frame.origin_m)});
  return features;
}

void add_corrections(const Corrections& corrections, Sample& sample, std::vector<Issue>& issues,
                     const ScoreOptions& options) {
  const FeatureTable& table = sample.features.table;
  std::vector<PlacedFeature> features;
  for (std::size_t i = 0; i < table.rows(); ++i)
    features.push_back({table.id(FeatureId{static_cast<int>(i)}), sample.boxes.at(i)});
  const auto corrected = corrections.find(table.building(), features, issues);
  if (corrected.empty()) return;
  const auto objects =
      objects_of_corrections(table.building(), features, corrected, sample.truth, options);
  sample.truth.insert(sample.truth.end(), objects.begin(), objects.end());
}

void add_corrections(const Corrections& corrections, LabelsAndTruth& all,
                     std::vector<Issue>& issues, const ScoreOptions& options) {
  std::map<std::string, std::vector<PlacedFeature>> features;
  std::map<std::string, std::vector<ExpectedObject>> truth;
  std::set<std::string> seen;
  for (const Prediction& prediction : all.predictions) {
    features[prediction.building].push_back({prediction.id, prediction.box});
    seen.insert(prediction.building);
  }
  for (const ExpectedObject& object : all.truth) truth[object.building].push_back(object);
  for (const auto& [building, placed] : features) {
    const auto corrected = corrections.find(building, placed, issues);
    if (corrected.empty()) continue;
    const auto objects =
        objects_of_corrections(building, placed, corrected, truth[building], options);
    all.truth.insert(all.truth.end(), objects.begin(), objects.end());
  }
  for (Issue& issue : corrections.unknown_buildings(seen)) issues.push_back(std::move(issue));
}

Interpretation without_corrections(const PipelineResult& result) {
  Interpretation before = result.interpretation;
  for (const LabelCorrection& correction : result.corrections)
    before.verdicts.at(correction.before.feature.index()) = correction.before;
  return before;
}

}  // namespace oriel
