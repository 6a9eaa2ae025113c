#pragma once

#include "kernel/base/parallel.h"
#include "oriel/interpret.h"
#include "oriel/rules.h"
#include "studio/session/labels/building_score.h"
#include "studio/session/open_buildings.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace oriel::studio {

/// What a pack says of one building; it never changes.
struct LabelledFeatures {
  std::shared_ptr<const OpenBuilding> building;
  Interpretation interpretation;
  /// By feature its class as its place in classes_of(), or -1.
  std::vector<int> classes;
  /// Features whose label was decided by little (R260), ascending.
  std::vector<int> doubtful;
  /// LabelledBuildings::number of the first with these classes.
  std::uint64_t since = 0;
  /// The truth that `score` was made with, and what came of it; nothing without truth.
  std::uint64_t truth_number = 0;
  std::optional<BuildingScore> score;
};

/// What a pack says of all buildings that were loaded by then; it never changes.
struct LabelledBuildings {
  /// Counts up from 1.
  std::uint64_t number = 0;
  RuleBase rules;
  /// The text of the pack, and params set to other values ("NAME=VALUE").
  std::string text;
  std::vector<std::string> assignments;
  /// By the building's number; null: it is not loaded yet.
  std::vector<std::shared_ptr<const LabelledFeatures>> buildings;
};

/// The classes of a pack by name, as places in classes_of().
using ClassNumbers = std::unordered_map<std::string, int>;

ClassNumbers numbers_of_classes(const RuleBase& rules);

/// LabelledFeatures::classes.
std::vector<int> classes_of_features(const Interpretation& interpretation,
                                     const ClassNumbers& numbers);

/// How buildings are labelled anew.
struct LabellingRun {
  const ForEachShare& for_each;
  WorkLog* log = nullptr;
  /// True as soon as nobody wants the result any more.
  const std::function<bool()>& is_given_up;
};

/// Labels all buildings with the pack and scores those with truth. What `before` (null: nothing)
/// knows already is taken from there: labels where both packs say the same of features, and scores
/// where labels and truth stayed. Null if it was given up.
std::shared_ptr<const LabelledBuildings> label_buildings(LabelledBuildings labelled,
                                                         const BuildingList& buildings,
                                                         const TruthOfSession& truth,
                                                         const LabelledBuildings* before,
                                                         const LabellingRun& run);

}  // namespace oriel::studio
