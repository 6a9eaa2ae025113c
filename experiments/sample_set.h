#pragma once

#include "experiments/feature_store.h"
#include "experiments/plan/experiment_plan.h"
#include "interpret/learn/folds.h"
#include "interpret/learn/sample.h"
#include "kernel/base/issue.h"
#include "oriel/stored_samples.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace oriel {

/// The files of a set, and what is known to be there.
struct SetFiles {
  std::vector<HashedFile> models, features, truth;
  TruthByBuilding objects;

  /// A text of all paths and hashes: two sets with the same text have the same samples.
  [[nodiscard]] std::string text() const;
};

/// The files that patterns name (files_of), with their hashes.
std::vector<HashedFile> hashed_files(const std::vector<FilePattern>& patterns,
                                     const ExperimentPlan& plan, std::vector<Issue>& issues);

/// Finds, hashes and reads the files of a set, but for its models and features. What is wrong is
/// added to `issues`; with an error among them nothing is to be measured.
SetFiles find_set_files(const SetPlan& set, const ExperimentPlan& plan, std::vector<Issue>& issues);

/// The ids of the buildings in its models, or else in its stored features, in the order of the
/// files. They are read, not segmented.
std::vector<std::string> ids_of_set(const SetFiles& files, const SegmentationPlan& options,
                                    std::vector<Issue>& issues);

/// The buildings of a set that are measured, of those that its files have: each of `ids` that has
/// truth; and of stored features those with truth of which no record is there. Issues: R289 a
/// building twice, R284 buildings or truths that the other has not, R283 a class of an objective
/// that no truth has, R282 and R285 splits that cannot be learnt from.
std::vector<std::string> measured_buildings(const SetPlan& set, const ExperimentPlan& plan,
                                            const SetFiles& files,
                                            const std::vector<std::string>& ids,
                                            std::vector<Issue>& issues);

/// By part of the split the buildings that are measured; the others are learnt from. Without a
/// split nothing. Folds are drawn by the seed, and as large as each other but for one building.
std::vector<SamplePart> parts_of(const SplitPlan& split, const std::vector<std::string>& buildings,
                                 std::uint64_t seed);

/// The options of segmentation that a plan says, over the command's own.
PipelineOptions pipeline_options(const SegmentationPlan& plan, bool ignores_semantics);

/// A set of an experiment that is ready to be measured.
struct SampleSet {
  const SetPlan* plan = nullptr;
  SetFiles files;
  /// Of its models and what they are looked at with; null: nobody looks.
  std::shared_ptr<const NeighbourSearch> neighbours;
  /// Those that are measured, in the order of their ids.
  std::vector<std::string> buildings;
  std::vector<Sample> samples;
};

}  // namespace oriel
