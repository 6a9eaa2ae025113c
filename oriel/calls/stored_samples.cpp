#include "oriel/stored_samples.h"

#include "io/records/feature_tables.h"
#include "oriel/interpret.h"
#include "oriel/score.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

void report_columns(const std::string& path, const RecordColumns& columns, const RuleBase& rules,
                    std::vector<Issue>& issues) {
  if (auto lacking = lacks_columns(path, columns, rules)) issues.push_back(std::move(*lacking));
  const RecordColumns needed = columns_named({"aabb_m"});
  if (common_columns(columns, needed) == needed) return;
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E151;
  issue.sentence =
      "lacks aabb_m, by which features are compared with the truth: all counts are wrong";
  issue.place.file = path;
  issues.push_back(std::move(issue));
}

}  // namespace

std::vector<Sample> read_stored_samples(const std::string& path, const RuleBase* rules,
                                        std::vector<Issue>& issues) {
  RecordColumns columns;
  std::vector<std::vector<Box>> boxes;
  auto tables = read_feature_tables(path, &columns, &boxes);
  std::ranges::move(tables.issues, std::back_inserter(issues));
  std::vector<Sample> samples;
  if (!tables.value) return samples;
  if (rules != nullptr) report_columns(path, columns, *rules, issues);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    samples.push_back({std::move((*tables.value)[i]), std::move(boxes[i]), {}});
  return samples;
}

std::vector<std::string> add_truth(const std::string& path, TruthByBuilding& truths,
                                   std::vector<Issue>& issues) {
  std::vector<std::string> known;
  auto read = read_truths(path);
  std::ranges::move(read.issues, std::back_inserter(issues));
  if (!read.value) return known;
  for (const GroundTruth& truth : *read.value)
    if (!add_truth(truth, truths)) known.push_back(truth.building);
  return known;
}

bool add_truth(const GroundTruth& truth, TruthByBuilding& truths) {
  LabelsAndTruth all;
  add(truth, all);
  return truths.try_emplace(truth.building, std::move(all.truth)).second;
}

UnpairedBuildings unpaired_buildings(const std::vector<std::string>& with_features,
                                     const TruthByBuilding& truths) {
  const std::set<std::string> ids(with_features.begin(), with_features.end());
  UnpairedBuildings unpaired;
  for (const std::string& id : ids)
    if (!truths.contains(id)) unpaired.without_truth.push_back(id);
  for (const auto& [id, objects] : truths)
    if (!ids.contains(id)) unpaired.without_features.push_back(id);
  return unpaired;
}

std::vector<Sample> samples_of(std::vector<Sample> stored, const TruthByBuilding& truths,
                               std::span<const std::string> buildings) {
  std::map<std::string, Sample*> by_id;
  for (Sample& sample : stored) by_id.emplace(sample.features.table.building(), &sample);
  std::vector<Sample> samples;
  samples.reserve(buildings.size());
  for (const std::string& id : buildings) {
    const auto found = by_id.find(id);
    Sample& sample = samples.emplace_back();
    if (found != by_id.end())
      sample = std::move(*found->second);
    else
      sample.features.table = FeatureTable(id, 0);
    sample.truth = truths.at(id);
  }
  return samples;
}

std::optional<std::string> newer_model(const std::string& features, const std::string& model) {
  std::error_code problem;
  const auto written = std::filesystem::last_write_time(features, problem);
  if (problem) return std::nullopt;
  const auto changed = std::filesystem::last_write_time(model, problem);
  if (problem || written >= changed) return std::nullopt;
  return fmt::format("the features in {} are older than the model {}: make them again", features,
                     model);
}

std::string some_of(std::span<const std::string> ids) {
  constexpr std::size_t kShown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, ids.size()); ++i)
    text += fmt::format("{}'{}'", i == 0 ? "" : ", ", ids[i]);
  return text + (ids.size() > kShown ? " ..." : "");
}

}  // namespace oriel
