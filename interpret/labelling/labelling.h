#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/evaluate/evaluator.h"
#include "interpret/labelling/candidates.h"
#include "interpret/labelling/evidence.h"
#include "interpret/pack/pack.h"

#include <span>
#include <vector>

namespace oriel::rules {

/// Those of some features for which the rule holds or is unknown, in their order. `require` holds
/// only on yes, `unless` vetoes only on yes; a rule without score scores 1, and one of whose score
/// terms none is known is unknown.
std::vector<Judgement> judge(const Pack& pack, const Rule& rule, Evaluator& evaluator,
                             std::span<const int> rows);

/// The same of features of which it is known already what they say to the conditions that are not
/// in `conditions`: those of `judged`, with what came of that.
std::vector<Judgement> judge_on(const Pack& pack, const Rule& rule, Evaluator& evaluator,
                                std::vector<Judgement> judged,
                                const std::vector<ExprId>& conditions);

/// The features that the rule's conditions leave, its score and those in `conditions` left aside;
/// judge_on() goes on from there.
std::vector<Judgement> judge_without(const Rule& rule, Evaluator& evaluator,
                                     std::span<const int> rows,
                                     const std::vector<ExprId>& conditions);

/// 0…1, or NaN where the term is unknown: how the values of a term are judged.
double judge_term(const Pack& pack, const ScoreTerm& term, Evaluator& evaluator,
                  const FeatureRows& rows);

/// What is known of rules before they are run: asked for every rule when its turn has come.
class KnownJudgements {
 public:
  KnownJudgements() = default;
  KnownJudgements(const KnownJudgements&) = delete;
  KnownJudgements& operator=(const KnownJudgements&) = delete;
  virtual ~KnownJudgements() = default;

  /// What judge() would say of the rule and all rows of the building, as far as memberships are
  /// known by now; null if it is to be asked.
  [[nodiscard]] virtual const std::vector<Judgement>* of(int rule) const = 0;
};

/// Runs the rules of a pack over one building, stratum by stratum. Afterwards `context.membership`
/// says of every feature and class whether it is one.
///
/// A pack with `iterate:` is run round by round, until a round changes no membership or there were
/// as many as it allows. Scores read the memberships of the round before, `context.previous`; in
/// the first round all are unknown.
class Labelling {
 public:
  /// `known` may be null.
  Labelling(const Pack& pack, EvaluationContext& context, const KnownJudgements* known = nullptr);

  /// What was decided; of several rounds in the last.
  std::vector<Choice> run();

  /// What was decided in each round; empty without `iterate:`.
  [[nodiscard]] const std::vector<std::vector<Choice>>& rounds() const { return rounds_; }
  /// The rows whose memberships the last round still changed.
  [[nodiscard]] std::vector<int> unsettled() const;

  /// The features to whose labels evidence was asked, decision by decision; of several rounds in
  /// the last.
  [[nodiscard]] const std::vector<Weighed>& weighed() const { return weighed_; }
  /// The company of a feature that was weighed which held the label of that rule.
  [[nodiscard]] std::vector<int> holders(const Weighed& weighed, int rule) const;
  /// The rows whose labels evidence still changed when it was asked for the last time.
  [[nodiscard]] const std::vector<int>& unsettled_by_evidence() const { return restless_; }

 private:
  void run_round();

  void run_predicates(const RuleStep& step);
  bool apply_predicate(int rule);
  void run_decision(const RuleStep& step);
  void collect(int rule);
  void add_candidate(int rule, const Judgement& judgement);
  [[nodiscard]] bool is_open(ClassId decided, ClassId label) const;
  void weigh_evidence();
  void decide(std::size_t row);
  void settle_unknown(const RuleStep& step);
  void raise_membership(ClassId id, std::size_t row, Truth truth);

  [[nodiscard]] const Rule& rule(int id) const {
    return pack_->rules[static_cast<std::size_t>(id)];
  }

  const Pack* pack_;
  EvaluationContext* context_;
  const KnownJudgements* known_;
  Evaluator evaluator_;
  std::vector<Choice> choices_;
  std::vector<std::vector<Choice>> rounds_;
  /// By row: the rules that hold in the decision at hand.
  std::vector<std::vector<Candidate>> candidates_;
  /// By class: the rows for which a rule for it was unknown in the decision at hand.
  std::vector<std::vector<int>> unknown_rows_;
  /// By row: the class that was decided, or -1.
  std::vector<ClassId> decided_;
  std::vector<Weighed> weighed_;
  /// By Weighed::decision and row: the labels that came of it.
  std::vector<std::vector<ClassId>> labels_weighed_;
  std::vector<int> restless_;
  /// The rows that the rule at hand is asked of.
  std::vector<int> open_rows_;
};

}  // namespace oriel::rules
