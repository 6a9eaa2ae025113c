#pragma once

#include "interpret/evaluate/conjunction.h"
#include "interpret/evaluate/evaluation_context.h"
#include "interpret/evaluate/evaluator.h"
#include "interpret/pack/pack.h"

#include <span>
#include <vector>

namespace oriel::rules {

/// How a rule judges one block of features.
struct Judgement {
  std::array<Truth, kBlock> truth;
  /// Where `truth` is yes: 0…1.
  std::array<double, kBlock> score;
};

/// Judges the features of `frame` by `rule`: `require` holds only on yes, `unless` vetoes only on
/// yes; a rule without score scores 1, and one of whose score terms none is known is unknown.
/// Where frame.needed is no, the truth is no.
void judge(const Pack& pack, const Rule& rule, Evaluator& evaluator, const Frame& frame,
           Judgement& judgement);

/// The same for those of whom `held` asks: leaves in it what the rule says of the slots that are
/// left, and by those slots the scores. Not finished. Without `scores` nothing is scored, so that
/// the rule must not have any.
void judge(const Pack& pack, const Rule& rule, Evaluator& evaluator, Conjunction& held,
           std::span<double> scores);

/// 0…1, or NaN where the term is unknown: how the values of a term are judged.
void judge_term(const Pack& pack, const ScoreTerm& term, Evaluator& evaluator, const Frame& frame,
                std::span<double> out);

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
    int priority = 0;
    ClassId label = kNoClass;
    /// The next candidate of the same feature, or -1.
    int next = -1;
    double score = 0;
  };

  void run_predicates(const RuleStep& step);
  bool apply_predicate(const Rule& rule);
  void run_decision(const RuleStep& step);
  void collect(int rule);
  void add_candidates(int rule, Conjunction& held, std::span<const double> scores);
  void add_winners(int rule, Conjunction& held);
  void win(std::size_t row, int rule);
  void come_second(std::size_t row, int rule);
  [[nodiscard]] bool is_open(ClassId decided, ClassId label) const;
  std::span<const int> open_rows(ClassId label);
  void decide(std::size_t row);
  void note_unknown(int rule, Conjunction& held);
  void note_decision(std::size_t row);
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
  /// The rules of the decision at hand come in the order in which they win, so that their
  /// candidates need not be kept.
  bool are_in_order_ = false;
  /// Candidates of the decision at hand, the first of every feature, or -1, and the features that
  /// have one; of lists that are longer than that the number that counts.
  std::vector<Candidate> candidates_;
  std::size_t candidate_count_ = 0;
  std::vector<int> first_candidate_;
  std::vector<int> rows_at_hand_;
  std::size_t rows_at_hand_count_ = 0;
  /// By class: the rows for which a rule for it was unknown in the decision at hand.
  std::vector<std::vector<int>> unknown_rows_;
  /// By row: the class that was decided, or -1.
  std::vector<ClassId> decided_;
  /// By row: the class that wins in the decision at hand, or -1.
  std::vector<ClassId> label_now_;
  bool is_any_decided_ = false;
  /// The rows that the rule at hand is asked of, if not all.
  std::vector<int> open_rows_;
  /// Whether that rule may decide what was decided as a class, by class; first what was not.
  std::vector<char> is_class_open_;
};

}  // namespace oriel::rules
