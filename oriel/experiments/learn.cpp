#include "oriel/experiments/learn.h"

#include "kernel/base/counted.h"
#include "kernel/io/records/feature_records.h"
#include "kernel/io/records/feature_tables.h"
#include "kernel/io/records/truth.h"
#include "oriel/corrections.h"
#include "oriel/score.h"

#include <algorithm>
#include <map>
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

/// "'a', 'b' ...": the first of them.
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, names.size()); ++i)
    text += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i]);
  return text + (names.size() > kShown ? " ..." : "");
}

/// Features and truths by building.
class SampleReader {
 public:
  void read_records(const std::string& path) {
    auto tables = read_feature_tables(path);
    add(std::move(tables.issues));
    if (!tables.value) return;
    std::map<std::string, Sample*> read;
    for (DescribedBuilding& building : *tables.value) {
      const std::string id = building.table.building();
      const auto [sample, is_new] = samples_.try_emplace(id);
      if (!is_new) {
        issues_.push_back(issue_of_samples(
            Severity::error, fmt::format("the building '{}' occurs twice in the records", id)));
        continue;
      }
      sample->second.features = std::move(building);
      read[id] = &sample->second;
    }
    for (const auto& [id, sample] : read) sample->boxes.resize(sample->features.table.rows());
    visit_feature_records(path, [&](const FeatureRecord& record) { add_box(record, read); });
  }

  void read_truth(const std::string& path) {
    const auto truths = read_truths(path);
    add(truths.issues);
    if (!truths.value) return;
    for (const GroundTruth& truth : *truths.value) {
      LabelsAndTruth all;
      oriel::add(truth, all);
      if (!truths_.try_emplace(truth.building, std::move(all.truth)).second)
        issues_.push_back(issue_of_samples(
            Severity::error, fmt::format("the building '{}' has two truths; the second is in {}",
                                         truth.building, path)));
    }
  }

  /// What people say is true, too.
  void add_corrections(const Corrections& corrections) {
    std::set<std::string> seen;
    for (auto& [id, sample] : samples_) {
      seen.insert(id);
      const auto truth = truths_.find(id);
      if (truth != truths_.end()) sample.truth = truth->second;
      oriel::add_corrections(corrections, sample, issues_);
      if (!sample.truth.empty()) truths_[id] = std::move(sample.truth);
    }
    add(corrections.unknown_buildings(seen));
  }

  Checked<std::vector<Sample>> result() {
    std::vector<Sample> both;
    std::vector<std::string> without_truth, without_features;
    for (auto& [id, sample] : samples_) {
      const auto truth = truths_.find(id);
      if (truth == truths_.end()) {
        without_truth.push_back(id);
        continue;
      }
      sample.truth = truth->second;
      both.push_back(std::move(sample));
    }
    for (const auto& [id, objects] : truths_)
      if (!samples_.contains(id)) without_features.push_back(id);
    report(both.size(), without_truth, without_features);
    if (has_errors(issues_)) return {std::nullopt, std::move(issues_)};
    for (const std::string& id : without_features)
      both.push_back({{FeatureTable(id, 0), {}}, {}, truths_[id]});
    std::ranges::sort(both, {}, [](const Sample& s) { return s.features.table.building(); });
    return {std::move(both), std::move(issues_)};
  }

 private:
  void add(std::vector<Issue> issues) {
    issues_.insert(issues_.end(), std::make_move_iterator(issues.begin()),
                   std::make_move_iterator(issues.end()));
  }

  static void add_box(const FeatureRecord& record, const std::map<std::string, Sample*>& read) {
    const auto found = read.find(record.building);
    if (found == read.end()) return;
    const FeatureId row = found->second->features.table.find(record.id);
    if (!row.is_valid()) return;
    const auto& b = record.aabb_m;
    found->second->boxes[row.index()] = {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
  }

  void report(std::size_t both, const std::vector<std::string>& without_truth,
              const std::vector<std::string>& without_features) {
    if (both == 0) {
      issues_.push_back(issue_of_samples(
          Severity::error,
          fmt::format("the truth is of other buildings: it has {}, and the records have {}",
                      truths_.empty() ? "none" : some_of(without_features),
                      samples_.empty() ? "none" : some_of(without_truth))));
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

  std::map<std::string, Sample> samples_;
  std::map<std::string, std::vector<ExpectedObject>> truths_;
  std::vector<Issue> issues_;
};

}  // namespace

Checked<std::vector<Sample>> read_samples(std::span<const std::string> records,
                                          std::span<const std::string> truths,
                                          const Corrections* corrections) {
  SampleReader reader;
  for (const std::string& path : records) reader.read_records(path);
  for (const std::string& path : truths) reader.read_truth(path);
  if (corrections != nullptr) reader.add_corrections(*corrections);
  return reader.result();
}

}  // namespace oriel
