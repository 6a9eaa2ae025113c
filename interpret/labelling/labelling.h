#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/evaluate/evaluator.h"
#include "interpret/pack/pack.h"

#include <span>
#include <vector>

namespace oriel::rules {

/// Those of some features for which the rule holds or is unknown, in their order. `require` holds
/// only on yes, `unless` vetoes only on yes; a rule without score scores 1, and one of whose score
/// terms none is known is unknown.
std::vector<Judgement> judge(const Pack& pack, const Rule& rule, Evaluator& evaluator,
                             std::span<const int> rows);

/// 0…1, or NaN where the term is unknown: how the values of a term are judged.
double judge_term(const Pack& pack, const ScoreTerm& term, Evaluator& evaluator,
                  const FeatureRows& rows);

/// What was decided for one feature.
struct Choice {
  /// The rule that won, or -1.
  int rule = -1;
  double score = 0;
  double margin = 0;
  /// The best rule for another label, or -1.
  int runner_up = -1;
  bool is_ambiguous = false;
};

/// Runs the rules of a pack over one building, stratum by stratum. Afterwards `context.membership`
/// says of every feature and class whether it is one.
///
/// A pack with `iterate:` is run round by round, until a round changes no membership or there were
/// as many as it allows. Scores read the memberships of the round before, `context.previous`; in
/// the first round all are unknown.
class Labelling {
 public:
  Labelling(const Pack& pack, EvaluationContext& context);

  /// What was decided; of several rounds in the last.
  std::vector<Choice> run();

  /// What was decided in each round; empty without `iterate:`.
  [[nodiscard]] const std::vector<std::vector<Choice>>& rounds() const { return rounds_; }
  /// The rows whose memberships the last round still changed.
  [[nodiscard]] std::vector<int> unsettled() const;

 private:
  void run_round();

  struct Candidate {
    int rule = -1;
    double score = 0;
  };

  void run_predicates(const RuleStep& step);
  bool apply_predicate(const Rule& rule);
  void run_decision(const RuleStep& step);
  void collect(int rule);
  [[nodiscard]] bool is_open(ClassId decided, ClassId label) const;
  void decide(std::size_t row);
  void settle_unknown(const RuleStep& step);
  [[nodiscard]] bool beats(const Candidate& p, const Candidate& q) const;
  void raise_membership(ClassId id, std::size_t row, Truth truth);

  [[nodiscard]] const Rule& rule(int id) const {
    return pack_->rules[static_cast<std::size_t>(id)];
  }

  const Pack* pack_;
  EvaluationContext* context_;
  Evaluator evaluator_;
  std::vector<Choice> choices_;
  std::vector<std::vector<Choice>> rounds_;
  /// By row: the rules that hold in the decision at hand.
  std::vector<std::vector<Candidate>> candidates_;
  /// By class: the rows for which a rule for it was unknown in the decision at hand.
  std::vector<std::vector<int>> unknown_rows_;
  /// By row: the class that was decided, or -1.
  std::vector<ClassId> decided_;
  /// The rows that the rule at hand is asked of.
  std::vector<int> open_rows_;
};

}  // namespace oriel::rules
