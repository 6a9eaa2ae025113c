#include "oriel/corrections.h"

#include "interpret/yaml/json_text.h"
#include "kernel/base/printable.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

const LabelCorrection* correction_of(const PipelineResult& result, FeatureId feature) {
  const auto found = std::ranges::find(result.corrections, feature,
                                       [](const LabelCorrection& c) { return c.before.feature; });
  return found == result.corrections.end() ? nullptr : &*found;
}

/// The label that it was corrected to.
std::string label_after(const PipelineResult& result, FeatureId feature) {
  const std::string& label = result.interpretation.verdicts.at(feature.index()).label.text();
  return label.empty() ? "unknown" : label;
}

}  // namespace

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

std::string correction_text(const PipelineResult& result, FeatureId feature) {
  const LabelCorrection* correction = correction_of(result, feature);
  if (correction == nullptr) return {};
  std::string text = "corrected to " + label_after(result, feature);
  if (!correction->by.empty()) text += " by " + correction->by;
  text += fmt::format(" ({}:{})", correction->place.file, correction->place.line);
  if (!correction->why.empty()) text += ": " + correction->why;
  return printable(text + "; the rules say:") + "\n";
}

std::string correction_json(const PipelineResult& result, FeatureId feature) {
  const LabelCorrection* correction = correction_of(result, feature);
  if (correction == nullptr) return {};
  return fmt::format(R"("corrected":{{"label":{},"by":{},"why":{}}})",
                     rules::json_string(label_after(result, feature)),
                     rules::json_string(correction->by), rules::json_string(correction->why));
}

}  // namespace oriel
