#pragma once

#include "interpret/learn/sample.h"
#include "interpret/pack/rule_base.h"
#include "io/records/truth.h"
#include "kernel/base/issue.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// What is known to be there, by building.
using TruthByBuilding = std::map<std::string, std::vector<ExpectedObject>>;

/// The samples in a file of records, building by building, without truth. What is wrong with it is
/// added to `issues`. With `rules` that also is a warning E151 if it lacks columns that they read,
/// or the boxes that are compared with truth. Throws InputError as read_feature_tables() does.
std::vector<Sample> read_stored_samples(const std::string& path, const RuleBase* rules,
                                        std::vector<Issue>& issues);

/// Adds the truth in a file to what is known (read_truths). Returns the buildings of which truth
/// was known before: that of the file is passed over. Throws InputError E101.
std::vector<std::string> add_truth(const std::string& path, TruthByBuilding& truths,
                                   std::vector<Issue>& issues);
/// The same of one building; false if its truth was known before.
bool add_truth(const GroundTruth& truth, TruthByBuilding& truths);

/// Buildings of which there is only one of both, sorted.
struct UnpairedBuildings {
  std::vector<std::string> without_truth, without_features;
};
UnpairedBuildings unpaired_buildings(const std::vector<std::string>& with_features,
                                     const TruthByBuilding& truths);

/// A sample of each of these buildings, in their order, with its truth; one without features if
/// there are none, so that all its objects count as missed.
std::vector<Sample> samples_of(std::vector<Sample> stored, const TruthByBuilding& truths,
                               std::span<const std::string> buildings);

/// What is wrong with features that were written before the model was, by the dates of the files:
/// records say nothing of what they were made from. Nothing where the model is no newer.
std::optional<std::string> newer_model(const std::string& features, const std::string& model);

/// "'a', 'b', 'c' ...": the first of these ids.
std::string some_of(std::span<const std::string> ids);

}  // namespace oriel
