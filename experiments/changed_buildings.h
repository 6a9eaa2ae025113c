#pragma once

#include "experiments/part_runner.h"
#include "experiments/results/results.h"
#include "experiments/sample_set.h"
#include "interpret/learn/sample.h"
#include "interpret/pack/rule_base.h"
#include "kernel/base/issue.h"
#include "model/building.h"
#include "oriel/options.h"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// The largest number of buildings of a set that are drawn.
inline constexpr std::size_t kMostChangedPictures = 3;

/// Finds the buildings of a set that runs label otherwise than the baseline, and draws those with
/// the most changed labels.
class ChangedLabels {
 public:
  ChangedLabels(const SampleSet& set, const PartContext& context);

  /// Adds a run on the same buildings, in the same order.
  void add(const std::string& run, const RuleBase& rules, const PipelineOptions& options,
           std::span<const Sample> samples);

  /// Draws the buildings, each beside its baseline in the run that changes most of its labels. What
  /// cannot be drawn is said. Throws InputError for models that cannot be read.
  [[nodiscard]] ChangedBuildings draw() const;

 private:
  /// The label of each feature, by its id.
  using Labels = std::map<std::string, std::string>;
  /// Labels before and after, by the id of the feature.
  using Changes = std::map<std::string, std::pair<std::string, std::string>>;
  struct ComparedRun {
    std::string name;
    RuleBase rules;
    PipelineOptions options;
  };
  /// A building in the run that changes most of its labels.
  struct RelabelledBuilding {
    std::string building;
    std::size_t run = 0;
    Changes labels;
  };

  [[nodiscard]] std::vector<Labels> labels_of(const RuleBase& rules,
                                              std::span<const Sample> samples) const;
  /// The buildings have their level of detail and their id.
  [[nodiscard]] Checked<std::string> picture_of(
      const RelabelledBuilding& change,
      const std::map<std::string, std::map<std::string, Building>>& by_lod) const;

  const SampleSet& set_;
  const PartContext& context_;
  PipelineOptions own_options_;
  std::vector<Labels> before_;
  std::vector<ComparedRun> runs_;
  /// By position in the set.
  std::vector<RelabelledBuilding> changes_;
};

}  // namespace oriel
