#include "interpret/labelling/labelling.h"

#include "interpret/evaluate/arithmetic.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace oriel::rules {

namespace {

/// True if a member was raised.
bool raise_all(std::vector<Truth>& members, const std::vector<Truth>& truths) {
  bool has_changed = false;
  for (std::size_t row = 0; row < truths.size(); ++row) {
    has_changed = has_changed || truths[row] > members[row];
    members[row] = std::max(members[row], truths[row]);
  }
  return has_changed;
}

/// A ramp's ends at the params' values.
struct Ends {
  double from = 0;
  double to = 0;
};

/// 0 below the ramp, 1 above it; a ramp without width is a step that belongs to the upper side.
double climb(Ends ends, double x) {
  if (x >= ends.to) return 1;
  if (x <= ends.from) return 0;
  return (x - ends.from) / (ends.to - ends.from);
}

/// The same downhill: 1 up to the ramp's start, 0 from its end on.
double descend(Ends ends, double x) {
  if (x <= ends.from) return 1;
  if (x >= ends.to) return 0;
  return (ends.to - x) / (ends.to - ends.from);
}

/// The weighted mean of the known terms; nothing if none is known.
std::optional<double> score(const Pack& pack, const Rule& rule, Evaluator& evaluator,
                            const FeatureRows& rows) {
  double sum = 0, weight = 0;
  for (const ScoreTerm& term : rule.score) {
    const double judged = judge_term(pack, term, evaluator, rows);
    if (std::isnan(judged)) continue;
    sum += term.weight * judged;
    weight += term.weight;
  }
  if (weight == 0) return std::nullopt;
  return sum / weight;
}

std::vector<Judgement> all_of(std::span<const int> rows) {
  std::vector<Judgement> judged(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) judged[i].row = rows[i];
  return judged;
}

/// Takes those away that do not fulfil the conditions which are asked.
template <class IsAsked>
void ask(const Rule& rule, Evaluator& evaluator, std::vector<Judgement>& judged, IsAsked is_asked) {
  for (const ExprId id : rule.require)
    if (is_asked(id)) evaluator.narrow(judged, id);
  for (const ExprId id : rule.unless) {
    if (!is_asked(id)) continue;
    std::erase_if(judged, [&](const Judgement& judgement) {
      return evaluator.truth(id, rows_of(judgement.row)) == Truth::yes;
    });
  }
}

void ask_score(const Pack& pack, const Rule& rule, Evaluator& evaluator,
               std::vector<Judgement>& judged) {
  if (rule.score.empty()) return;
  for (Judgement& judgement : judged) {
    const auto scored = score(pack, rule, evaluator, rows_of(judgement.row));
    if (!scored) judgement.truth = Truth::unknown;
    judgement.score = scored.value_or(0);
  }
}

}  // namespace

Labelling::Labelling(const Pack& pack, EvaluationContext& context, const KnownJudgements* known)
    : pack_(&pack),
      context_(&context),
      known_(known),
      evaluator_(pack, context),
      choices_(context.rows),
      candidates_(context.rows),
      unknown_rows_(pack.classes.size()),
      decided_(context.rows, kNoClass) {}

std::vector<Choice> Labelling::run() {
  if (pack_->rounds == 0) {
    run_round();
    return std::move(choices_);
  }
  const auto nothing = context_->membership;
  context_->previous.assign(nothing.size(), std::vector<Truth>(context_->rows, Truth::unknown));
  while (true) {
    choices_.assign(context_->rows, {});
    decided_.assign(context_->rows, kNoClass);
    run_round();
    rounds_.push_back(choices_);
    const bool is_last = static_cast<int>(rounds_.size()) == pack_->rounds;
    if (is_last || context_->membership == context_->previous) return std::move(choices_);
    context_->previous = std::exchange(context_->membership, nothing);
  }
}

std::vector<int> Labelling::unsettled() const {
  std::vector<int> rows;
  if (context_->previous.empty()) return rows;
  for (const int row : context_->row_numbers) {
    const auto r = static_cast<std::size_t>(row);
    for (std::size_t id = 0; id < context_->membership.size(); ++id) {
      if (context_->membership[id][r] == context_->previous[id][r]) continue;
      rows.push_back(row);
      break;
    }
  }
  return rows;
}

void Labelling::run_round() {
  weighed_.clear();
  labels_weighed_.clear();
  restless_.clear();
  for (const RuleStep& step : pack_->steps) {
    if (step.is_decision)
      run_decision(step);
    else
      run_predicates(step);
  }
}

/// Predicates that need each other start from "no" everywhere and are raised until nothing changes:
/// their least fixpoint, whatever the order.
void Labelling::run_predicates(const RuleStep& step) {
  bool has_changed = true;
  while (has_changed) {
    has_changed = false;
    for (const int id : step.rules) has_changed = apply_predicate(id) || has_changed;
    has_changed = has_changed && step.is_recursive;
  }
}

bool Labelling::apply_predicate(int id) {
  std::vector<Truth> truths(context_->rows, Truth::no);
  const auto add_all = [&](const std::vector<Judgement>& judgements) {
    for (const Judgement& judgement : judgements)
      truths[oriel::at(judgement.row)] = judgement.truth;
  };
  if (const auto* known = known_ == nullptr ? nullptr : known_->of(id)) {
    add_all(*known);
  } else {
    evaluator_.forget();
    add_all(judge(*pack_, rule(id), evaluator_, context_->row_numbers));
  }
  bool has_changed = false;
  for (const ClassId at : pack_->classes[oriel::at(rule(id).label)].raised)
    has_changed = raise_all(context_->membership[oriel::at(at)], truths) || has_changed;
  return has_changed;
}

/// Also raises what `id` is a kind of, where that is the union of its subclasses.
void Labelling::raise_membership(ClassId id, std::size_t row, Truth truth) {
  for (const ClassId at : pack_->classes[oriel::at(id)].raised) {
    Truth& member = context_->membership[oriel::at(at)][row];
    member = std::max(member, truth);
  }
}

void Labelling::run_decision(const RuleStep& step) {
  evaluator_.forget();
  for (const int id : step.rules) unknown_rows_[oriel::at(rule(id).label)].clear();
  for (const int id : step.rules) collect(id);
  for (auto& candidates : candidates_) sort_candidates(*pack_, context_->values, candidates);
  if (pack_->decide.evidence.is_written() && context_->values.evidence > 0) weigh_evidence();
  for (std::size_t row = 0; row < candidates_.size(); ++row) {
    if (candidates_[row].empty()) continue;
    decide(row);
    candidates_[row].clear();
  }
  settle_unknown(step);
}

/// A label is final, but a later stratum may refine it to a subclass.
bool Labelling::is_open(ClassId decided, ClassId label) const {
  return decided == kNoClass || (decided != label && is_within(pack_->classes, label, decided));
}

void Labelling::collect(int id) {
  const ClassId label = rule(id).label;
  if (const auto* known = known_ == nullptr ? nullptr : known_->of(id)) {
    for (const Judgement& judgement : *known)
      if (is_open(decided_[oriel::at(judgement.row)], label)) add_candidate(id, judgement);
    return;
  }
  open_rows_.clear();
  for (const int row : context_->row_numbers)
    if (is_open(decided_[oriel::at(row)], label)) open_rows_.push_back(row);
  for (const Judgement& judgement : judge(*pack_, rule(id), evaluator_, open_rows_))
    add_candidate(id, judgement);
}

void Labelling::add_candidate(int id, const Judgement& judgement) {
  if (judgement.truth == Truth::yes)
    candidates_[oriel::at(judgement.row)].push_back({id, judgement.score});
  else
    unknown_rows_[oriel::at(rule(id).label)].push_back(judgement.row);
}

/// What is close is decided with what the others say.
void Labelling::weigh_evidence() {
  JointPass pass(*pack_, *context_, candidates_, decided_);
  for (Weighed& one : pass.run()) {
    one.decision = labels_weighed_.size();
    weighed_.push_back(std::move(one));
  }
  if (!pass.labels().empty()) labels_weighed_.push_back(pass.labels());
  std::ranges::copy(pass.unsettled(), std::back_inserter(restless_));
}

std::vector<int> Labelling::holders(const Weighed& weighed, int rule_id) const {
  std::vector<int> rows = company_of(*pack_, *context_, weighed.row);
  const std::vector<ClassId>& labels = labels_weighed_[weighed.decision];
  std::erase_if(rows, [&](int other) {
    return !is_within(pack_->classes, labels[oriel::at(other)], rule(rule_id).label);
  });
  return rows;
}

void Labelling::decide(std::size_t row) {
  const Choice choice = choose(*pack_, context_->values, candidates_[row]);
  if (choice.rule < 0) return;
  choices_[row] = choice;
  decided_[row] = rule(choice.rule).label;
  raise_membership(decided_[row], row, Truth::yes);
}

/// A feature that is decided is no other class of this stratum, though a rule for it was unknown.
void Labelling::settle_unknown(const RuleStep& step) {
  for (const int id : step.rules) {
    const ClassId label = rule(id).label;
    for (const int row : unknown_rows_[oriel::at(label)])
      if (is_open(decided_[oriel::at(row)], label))
        raise_membership(label, oriel::at(row), Truth::unknown);
  }
}

double judge_term(const Pack& pack, const ScoreTerm& term, Evaluator& evaluator,
                  const FeatureRows& rows) {
  if (pack.code[static_cast<std::size_t>(term.value)].type == Type::yes_no) {
    const Truth truth = evaluator.truth(term.value, rows);
    return truth == Truth::unknown ? kUnknown : truth == Truth::yes ? 1 : 0;
  }
  const double value = evaluator.number(term.value, rows);
  if (std::isnan(value)) return kUnknown;
  const auto ends_of = [&](const Ramp& ramp) {
    return Ends{evaluator.number(ramp.from, rows), evaluator.number(ramp.to, rows)};
  };
  return std::min(term.rise ? climb(ends_of(*term.rise), value) : 1,
                  term.fall ? descend(ends_of(*term.fall), value) : 1);
}

std::vector<Judgement> judge(const Pack& pack, const Rule& rule, Evaluator& evaluator,
                             std::span<const int> rows) {
  const auto all = [](ExprId) { return true; };
  std::vector<Judgement> judged = all_of(rows);
  ask(rule, evaluator, judged, all);
  ask_score(pack, rule, evaluator, judged);
  return judged;
}

std::vector<Judgement> judge_without(const Rule& rule, Evaluator& evaluator,
                                     std::span<const int> rows,
                                     const std::vector<ExprId>& conditions) {
  std::vector<Judgement> judged = all_of(rows);
  ask(rule, evaluator, judged, [&](ExprId id) { return !std::ranges::count(conditions, id); });
  return judged;
}

std::vector<Judgement> judge_on(const Pack& pack, const Rule& rule, Evaluator& evaluator,
                                std::vector<Judgement> judged,
                                const std::vector<ExprId>& conditions) {
  ask(rule, evaluator, judged, [&](ExprId id) { return std::ranges::count(conditions, id) > 0; });
  ask_score(pack, rule, evaluator, judged);
  return judged;
}

}  // namespace oriel::rules
