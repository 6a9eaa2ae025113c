#pragma once

#include "interpret/learn/folds.h"
#include "interpret/learn/objective.h"
#include "interpret/learn/sample.h"
#include "interpret/pack/rule_base.h"
#include "interpret/params/with_params.h"
#include "interpret/score/score_spread.h"
#include "kernel/base/issue.h"
#include "kernel/base/parallel.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// A param whose value stands so close to the flip of labels that a small change moves the
/// objective much.
struct KnifeEdge {
  std::string param;
  std::string unit;
  double value = 0;
  /// The nearest value at which the objective has moved, and how far that is as a share of the
  /// param's range.
  double flip = 0;
  double distance_share = 0;
  /// By how much the objective changes at most within a small change; below 0: it falls.
  double change = 0;
  /// The objects that are found or lost there.
  std::size_t objects = 0;
};

struct LearnOptions {
  Objective objective;
  /// What each changed param must gain.
  double penalty = 0.001;
  /// How often the search begins again elsewhere.
  int restarts = 1;
  std::uint64_t seed = 1;
  /// How many samples of the bootstrap over buildings intervals come from.
  std::size_t bootstrap = 1000;
  /// The params that may be changed; empty: all that have a range and that labels depend on.
  std::vector<std::string> params;
  /// Called before each of the searches, with how many of how many are done.
  std::function<void(std::size_t done, std::size_t all)> step = {};
};

/// A param that was changed.
struct LearntParam {
  ParamValue value;
  /// In the pack.
  double before = 0;
  /// By how much the objective on all samples falls without this change, and where 95 % of the
  /// bootstrap samples have that.
  double gain = 0;
  ConfidenceInterval interval;
  /// The folds in which it was changed the same way, up or down.
  std::size_t folds = 0;
};

/// What was learnt from samples, and how well it does on samples that it was not learnt from.
struct Learnt {
  std::string objective;
  std::size_t samples = 0, folds = 0;
  /// In the order of the pack; empty: the pack stays as it is.
  std::vector<LearntParam> params;
  /// On all samples, with the pack as it is and with what was learnt.
  double before = 0, after = 0;
  /// The same on held-out folds, all of them together, each measured with what was learnt without
  /// it: all that is chosen was chosen anew from the others. And of each class.
  double held_out_before = 0, held_out_after = 0;
  ConfidenceInterval held_out_gain;
  std::map<std::string, ClassScore> held_out_classes_before, held_out_classes_after;
  /// By fold the params that the search outside it changed, before all were asked which to change.
  std::vector<std::vector<ParamValue>> by_fold;
  /// By fold what was learnt without it: with this it was measured, whatever is reported.
  std::vector<std::vector<ParamValue>> learnt_without;
  /// Why the pack stays as it is, or empty.
  std::string reason;
  /// Of the pack with what was learnt.
  std::vector<KnifeEdge> knife_edges;
};

/// Finds values of params, within their ranges, with which the pack labels samples best. The search
/// is exact in each param: an objective is constant between places where a label flips, and all of
/// these are found. Params are searched one after the other until nothing is gained, again from
/// other settings, and then together (NLopt); those that gain no more than the penalty go back to
/// what the pack says.
///
/// `parts` are the samples of each held-out fold, by number. The search is made on all samples and
/// on those outside each fold; only params that at least half of the folds change the same way are
/// changed in the end, and all folds are searched once more with these alone (ParamFitter::fit).
///
/// So all folds have a say in what is changed, and none can judge it. Therefore everything is
/// learnt again without each fold, with kInnerFolds folds of the other samples, and the fold is
/// measured with that. If the folds are not better that way than with the pack, the pack stays as
/// it is. (Varma and Simon 2006, Bias in error estimation when using cross-validation for model
/// selection: this is their nested cross-validation.)
///
/// The same for the same input, seed and parts at any number of threads. Without a value and
/// without an error if it was given up. Errors, without a value: R206 unknown params, R283 a class
/// of the objective that no truth has, R282 folds that leave nothing to learn from. Warnings: R285
/// a fold without an object of a class that others have.
Checked<Learnt> learn_params(const RuleBase& rules, std::span<const Sample> samples,
                             std::span<const SamplePart> parts, const LearnOptions& options,
                             const ForEachShare& for_each = for_each_in_turn,
                             const IsGivenUp& is_given_up = nullptr);

/// So many folds decide within what is learnt from; fewer where there are fewer samples.
inline constexpr std::size_t kInnerFolds = 5;

/// What learn_params() learns without a fold, from all of these samples, to be measured on others:
/// nothing from fewer than two, or where they have no object of the objective. Error: R206.
Checked<std::vector<ParamValue>> fit_params(const RuleBase& rules, std::span<const Sample> samples,
                                            const LearnOptions& options,
                                            const ForEachShare& for_each = for_each_in_turn);

}  // namespace oriel
