#pragma once

#include "interpret/pack/rule_base.h"
#include "interpret/score/score.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace oriel {

/// How well the labels that one rule decided are right.
struct RuleScore {
  std::string label;
  std::size_t right = 0;
  std::size_t wrong = 0;
  /// Predictions on objects that are left out: neither right nor wrong.
  std::size_t left_out = 0;
  /// What the wrong ones are by the truth: label -> count; "-" stands for nothing there.
  std::map<std::string, std::size_t> taken_for;

  /// Features for which a rule for another label held, too, and came second.
  struct Contest {
    std::size_t count = 0;
    /// Those of them that are wrong, and those that are what came second.
    std::size_t wrong = 0;
    std::size_t second_is_right = 0;
  };
  /// By the label that came second.
  std::map<std::string, Contest> contests;
  /// The wrong ones, as in Score::misses.
  std::vector<Miss> mistakes;

  [[nodiscard]] std::size_t decided() const { return right + wrong + left_out; }
  /// Of those that are right or wrong; NaN if there are none.
  [[nodiscard]] double precision() const;
};

/// By the id of the rule, "-" where the prediction does not say it. `score` is that of the same
/// predictions. What a rule should have found and did not is not its own: another one, or none, has
/// decided there; Score::misses has it.
std::map<std::string, RuleScore> score_by_rule(const std::vector<Prediction>& predictions,
                                               const Score& score);

/// Adds the rules for labels that decided nothing. False, and nothing is added, if the pack is not
/// the one that decided: it lacks a rule of `by_rule`, or its rule is for another label.
bool add_rules_without_decision(const RuleBase& base, std::map<std::string, RuleScore>& by_rule);

/// For a terminal: a line a rule with what it was wrong about and what it contests with, the rules
/// that decided nothing, and the first mistakes of each rule: as many of each as are together at
/// most `max_mistakes`, but one.
std::string to_text(const std::map<std::string, RuleScore>& rules, std::size_t max_mistakes);
/// `"rules":{…}` for to_json (docs/formats.md).
std::string rules_json(const std::map<std::string, RuleScore>& rules);

}  // namespace oriel
