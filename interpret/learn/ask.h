#pragma once

#include "interpret/learn/learn_params.h"
#include "interpret/learn/sample.h"
#include "interpret/pack/rule_base.h"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// A feature of which a person's answer would help most.
struct OpenQuestion {
  std::string building;
  std::string feature;
  /// What the pack calls it, may be empty, what comes next, and how far ahead the first is, 0…1.
  std::string label;
  std::string runner_up;
  double margin = 0;
  /// How many of the folds call it what.
  std::map<std::string, std::size_t> by_fold;
  /// The share of the folds that do not agree with most of them, 0…1.
  double disagreement = 0;
};

/// The `count` features whose right label would tell most: those on whose label what was learnt
/// without each fold disagrees most, of equals those with the smallest margin, then by building and
/// id. Features that nothing calls anything are not asked for.
std::vector<OpenQuestion> open_questions(const RuleBase& rules, std::span<const Sample> samples,
                                         const Learnt& learnt, std::size_t count);

/// A table for a terminal.
std::string to_text(const std::vector<OpenQuestion>& questions);

}  // namespace oriel
