#pragma once

#include "interpret/learn/folds.h"
#include "interpret/learn/objective.h"
#include "interpret/learn/sample.h"
#include "interpret/pack/rule_base.h"
#include "kernel/base/parallel.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// A change of one rule that pays; a person decides whether it is right.
struct Proposal {
  /// "drop 'height <= 3 m' of ledge.overhead", "add 'width <= 2.4 m' to window.in_wall".
  std::string what;
  std::string rule;
  /// The rule is dropped as a whole.
  bool drops_rule = false;
  /// The conditions of the rule after the change; nothing of one that is dropped.
  std::vector<std::string> require, unless;
  /// The term of its score that is dropped, or -1.
  int dropped_term = -1;
  /// The objective on all samples with it, less that without.
  double gain = 0;
  /// The same on held-out folds that did not choose it: of the folds outside which it paid.
  double held_out_gain = 0;
  /// The folds outside which it paid.
  std::size_t folds = 0;
};

struct ProposeOptions {
  Objective objective;
  /// What a change must gain to be proposed.
  double penalty = 0.001;
  std::size_t most = 10;
};

/// Conditions that a rule could do without, and conditions on one attribute or on whether there are
/// others by a relation that would take mistakes from a rule (decision stumps over the features
/// that it decided, right or wrong). Each is chosen on the buildings outside a fold and measured on
/// the fold; proposed is what pays outside at least half of the folds, and on these folds together.
/// The best first. The same at any number of threads. Nothing, not even none, if it was given up.
std::optional<std::vector<Proposal>> propose(const RuleBase& rules, std::span<const Sample> samples,
                                             std::span<const SamplePart> parts,
                                             const ProposeOptions& options,
                                             const ForEachShare& for_each = for_each_in_turn,
                                             const IsGivenUp& is_given_up = nullptr);

}  // namespace oriel
