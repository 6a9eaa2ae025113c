#include "oriel/learn.h"

#include "io/files/input.h"
#include "kernel/base/text/counted.h"
#include "oriel/corrections.h"
#include "oriel/stored_samples.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

Issue issue_of_samples(Severity severity, std::string sentence) {
  Issue issue;
  issue.severity = severity;
  issue.code = Code::R284;
  issue.sentence = std::move(sentence);
  return issue;
}

/// Features and truths by building.
class SampleReader {
 public:
  void read_records(const std::string& path, const RuleBase& rules) {
    for (Sample& sample : read_stored_samples(path, &rules, issues_)) add(std::move(sample));
  }

  void add(Sample sample) {
    const std::string& id = sample.features.table.building();
    if (ids_.insert(id).second)
      stored_.push_back(std::move(sample));
    else
      issues_.push_back(issue_of_samples(
          Severity::error, fmt::format("the building '{}' occurs twice in the records", id)));
  }

  void read_truth(const std::string& path) {
    for (const std::string& id : add_truth(path, truths_, issues_))
      issues_.push_back(issue_of_samples(
          Severity::error,
          fmt::format("the building '{}' has two truths; the second is in {}", id, path)));
  }

  void add(const GroundTruth& truth) {
    if (!add_truth(truth, truths_))
      issues_.push_back(issue_of_samples(
          Severity::error, fmt::format("the building '{}' has two truths", truth.building)));
  }

  /// What people say is true, too; null: nobody says anything.
  Checked<std::vector<Sample>> result(const Corrections* corrections) {
    if (corrections != nullptr) add(*corrections);
    report(unpaired_buildings({ids_.begin(), ids_.end()}, truths_));
    if (has_errors(issues_)) return {std::nullopt, std::move(issues_)};
    std::vector<std::string> buildings;
    for (const auto& [id, objects] : truths_) buildings.push_back(id);
    return {samples_of(std::move(stored_), truths_, buildings), std::move(issues_)};
  }

 private:
  void add(const Corrections& corrections) {
    for (Sample& sample : stored_) {
      const std::string& id = sample.features.table.building();
      if (const auto truth = truths_.find(id); truth != truths_.end()) sample.truth = truth->second;
      oriel::add_corrections(corrections, sample, issues_);
      if (!sample.truth.empty()) truths_[id] = std::move(sample.truth);
    }
    std::ranges::move(corrections.unknown_buildings(ids_), std::back_inserter(issues_));
  }

  void report(const UnpairedBuildings& unpaired) {
    const auto& [without_truth, without_features] = unpaired;
    if (without_truth.size() == ids_.size()) {
      issues_.push_back(issue_of_samples(
          Severity::error,
          fmt::format("the truth is of other buildings: it has {}, and the records have {}",
                      truths_.empty() ? "none" : some_of(without_features),
                      ids_.empty() ? "none" : some_of(without_truth))));
      return;
    }
    if (!without_truth.empty())
      issues_.push_back(issue_of_samples(
          Severity::warning,
          fmt::format("{} {} left out: there is no truth of {}",
                      counted(without_truth.size(), "building"),
                      agreeing(without_truth.size(), "is", "are"), some_of(without_truth))));
    if (!without_features.empty())
      issues_.push_back(issue_of_samples(
          Severity::warning, fmt::format("there are no features of {}: all objects there count as "
                                         "missed",
                                         some_of(without_features))));
  }

  std::vector<Sample> stored_;
  std::set<std::string> ids_;
  TruthByBuilding truths_;
  std::vector<Issue> issues_;
};

}  // namespace

Checked<std::vector<Sample>> read_samples(std::span<const std::string> records,
                                          std::span<const std::string> truths,
                                          const RuleBase& rules, const Corrections* corrections) {
  SampleReader reader;
  for (const std::string& path : records) reader.read_records(path, rules);
  for (const std::string& path : truths) reader.read_truth(path);
  return reader.result(corrections);
}

Checked<std::vector<Sample>> read_samples(std::span<const std::string> records,
                                          std::span<const GroundTruth> truths,
                                          const RuleBase& rules, const Corrections* corrections) {
  SampleReader reader;
  for (const std::string& path : records) reader.read_records(path, rules);
  for (const GroundTruth& truth : truths) reader.add(truth);
  return reader.result(corrections);
}

Checked<std::vector<Sample>> join_samples(std::vector<Sample> features,
                                          std::span<const GroundTruth> truths,
                                          const Corrections* corrections) {
  SampleReader reader;
  for (Sample& sample : features) reader.add(std::move(sample));
  for (const GroundTruth& truth : truths) reader.add(truth);
  return reader.result(corrections);
}

std::vector<Issue> report_old_records(std::span<const std::string> records,
                                      std::span<const std::string> models) {
  std::vector<Issue> issues;
  for (const std::string& model : models) const Input is_there(model);
  for (const std::string& path : records)
    for (const std::string& model : models) {
      auto sentence = newer_model(path, model);
      if (!sentence) continue;
      Issue& issue = issues.emplace_back();
      issue.severity = Severity::warning;
      issue.code = Code::R286;
      issue.sentence = std::move(*sentence);
      break;
    }
  return issues;
}

Checked<Objective::Costs> read_costs_file(const std::string& path) {
  return read_costs(Input(path).read_all(), path);
}

}  // namespace oriel
