#include "interpret/labelling/labelling.h"

#include "interpret/evaluate/comparisons.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <utility>

namespace oriel::rules {

namespace {

/// True if a member was raised.
bool raise_all(std::vector<Truth>& members, const std::vector<Truth>& truths) {
  std::uint8_t has_changed = 0;
  for (std::size_t row = 0; row < truths.size(); ++row) {
    has_changed |= static_cast<std::uint8_t>(truths[row] > members[row]);
    members[row] = std::max(members[row], truths[row]);
  }
  return has_changed != 0;
}

}  // namespace

Labelling::Labelling(const Pack& pack, EvaluationContext& context)
    : pack_(&pack),
      context_(&context),
      evaluator_(pack, context),
      choices_(context.rows),
      first_candidate_(context.rows, -1),
      rows_at_hand_(context.rows + 1),
      unknown_rows_(pack.classes.size()),
      decided_(context.rows, kNoClass),
      label_now_(context.rows, kNoClass),
      open_rows_(context.rows),
      is_class_open_(pack.classes.size() + 1) {}

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
    is_any_decided_ = false;
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
    for (const int id : step.rules) has_changed = apply_predicate(rule(id)) || has_changed;
    has_changed = has_changed && step.is_recursive;
  }
}

bool Labelling::apply_predicate(const Rule& rule) {
  evaluator_.forget();
  bool has_changed = false;
  std::vector<Truth> truths(context_->rows);
  for (std::size_t begin = 0; begin < context_->rows; begin += kBlock) {
    const Frame frame = block_of(*context_, begin);
    Conjunction held(frame, std::span(truths).subspan(begin, frame.size));
    judge(*pack_, rule, evaluator_, held, {});
    held.finish();
  }
  for (const ClassId at : pack_->classes[oriel::at(rule.label)].raised)
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
  candidate_count_ = rows_at_hand_count_ = 0;
  are_in_order_ = !step.is_scored && pack_->decide.min_score <= 1;
  for (const int id : step.rules) unknown_rows_[oriel::at(rule(id).label)].clear();
  for (const int id : step.rules) collect(id);
  const auto rows = std::span(rows_at_hand_).first(rows_at_hand_count_);
  for (const int row : rows)
    if (!are_in_order_) decide(oriel::at(row));
  for (const int row : rows) note_decision(oriel::at(row));
  settle_unknown(step);
}

void Labelling::note_decision(std::size_t row) {
  first_candidate_[row] = -1;
  const ClassId label = std::exchange(label_now_[row], kNoClass);
  if (label == kNoClass) return;
  decided_[row] = label;
  is_any_decided_ = true;
  raise_membership(label, row, Truth::yes);
}

/// A label is final, but a later stratum may refine it to a subclass.
bool Labelling::is_open(ClassId decided, ClassId label) const {
  return decided == kNoClass || (decided != label && is_within(pack_->classes, label, decided));
}

/// Those that a rule for the label may still decide.
std::span<const int> Labelling::open_rows(ClassId label) {
  if (!is_any_decided_) return context_->row_numbers;
  for (std::size_t i = 0; i < is_class_open_.size(); ++i)
    is_class_open_[i] = is_open(static_cast<ClassId>(i) - 1, label) ? 1 : 0;
  std::size_t size = 0;
  for (std::size_t row = 0; row < decided_.size(); ++row) {
    open_rows_[size] = static_cast<int>(row);
    size += static_cast<std::size_t>(is_class_open_[oriel::at(decided_[row] + 1)]);
  }
  return std::span(open_rows_).first(size);
}

void Labelling::collect(int id) {
  TruthBlock truths;
  NumberBlock scores;
  const Rule& judging = rule(id);
  const auto rows = open_rows(judging.label);
  for (std::size_t begin = 0; begin < rows.size(); begin += kBlock) {
    Frame frame;
    frame.size = std::min(kBlock, rows.size() - begin);
    frame.rows[0] = rows.data() + begin;
    frame.is_run = !is_any_decided_;
    Conjunction held(frame, std::span(truths).first(frame.size));
    judge(*pack_, judging, evaluator_, held, are_in_order_ ? std::span<double>() : scores);
    if (held.is_open() && are_in_order_)
      add_winners(id, held);
    else if (held.is_open())
      add_candidates(id, held, scores);
    note_unknown(id, held);
  }
}

/// Without a branch on whether the rule holds, which nobody could foresee: what does not hold is
/// overwritten by the next.
void Labelling::add_candidates(int id, Conjunction& held, std::span<const double> scores) {
  const auto truths = held.truths();
  const int* const rows = held.frame().rows[0];
  std::size_t count = candidate_count_, at_hand = rows_at_hand_count_;
  if (candidates_.size() < count + truths.size() + 1)
    candidates_.resize(2 * (count + truths.size()) + 1);
  const int priority = rule(id).priority;
  const ClassId label = rule(id).label;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    const bool holds = truths[i] == Truth::yes;
    int& first = first_candidate_[oriel::at(rows[i])];
    candidates_[count] = {id, priority, label, first, scores[i]};
    rows_at_hand_[at_hand] = rows[i];
    at_hand += holds && first < 0 ? 1U : 0U;
    first = holds ? static_cast<int>(count) : first;
    count += holds ? 1U : 0U;
  }
  candidate_count_ = count;
  rows_at_hand_count_ = at_hand;
}

/// Where no rule has a score, what holds first wins, and what holds first for another label is the
/// runner-up.
void Labelling::add_winners(int id, Conjunction& held) {
  const auto truths = held.truths();
  const int* const rows = held.frame().rows[0];
  const ClassId label = rule(id).label;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    if (truths[i] != Truth::yes) continue;
    const std::size_t row = oriel::at(rows[i]);
    if (label_now_[row] == kNoClass) {
      label_now_[row] = label;
      rows_at_hand_[rows_at_hand_count_++] = rows[i];
      win(row, id);
    } else if (label_now_[row] != label && choices_[row].runner_up < 0) {
      come_second(row, id);
    }
  }
}

void Labelling::win(std::size_t row, int id) {
  Choice& choice = choices_[row];
  choice.rule = id;
  choice.runner_up = -1;
  choice.score = choice.margin = 1;
}

void Labelling::come_second(std::size_t row, int id) {
  Choice& choice = choices_[row];
  choice.runner_up = id;
  if (rule(choice.rule).priority != rule(id).priority) return;
  choice.margin = 0;
  choice.is_ambiguous = 0 < pack_->decide.ambiguous_below;
}

void Labelling::note_unknown(int id, Conjunction& held) {
  const auto truths = held.truths();
  if (!held.is_open() || !has_unknown(truths)) return;
  for (std::size_t i = 0; i < truths.size(); ++i)
    if (truths[i] == Truth::unknown)
      unknown_rows_[oriel::at(rule(id).label)].push_back(held.frame().rows[0][i]);
}

/// By what wins: enough score, then priority, then score, then the rule's id.
bool Labelling::beats(const Candidate& p, const Candidate& q) const {
  const bool is_p_enough = p.score >= pack_->decide.min_score;
  const bool is_q_enough = q.score >= pack_->decide.min_score;
  if (is_p_enough != is_q_enough) return is_p_enough;
  if (p.priority != q.priority) return p.priority > q.priority;
  if (p.score != q.score) return p.score > q.score;
  return rule(p.rule).id < rule(q.rule).id;
}

void Labelling::decide(std::size_t row) {
  const Candidate* best = &candidates_[oriel::at(first_candidate_[row])];
  const Candidate* second = nullptr;  // the best for another label
  for (int c = best->next; c >= 0; c = candidates_[oriel::at(c)].next) {
    const Candidate* const next = &candidates_[oriel::at(c)];
    const bool is_better = beats(*next, *best);
    if (next->label != best->label) {
      if (is_better)
        second = best;
      else if (second == nullptr || beats(*next, *second))
        second = next;
    }
    if (is_better) best = next;
  }
  if (best->score < pack_->decide.min_score) return;
  Choice& choice = choices_[row];
  choice.rule = best->rule;
  choice.score = best->score;
  double margin = best->score;
  for (int c = second == nullptr ? -1 : first_candidate_[row]; c >= 0;
       c = candidates_[oriel::at(c)].next) {
    const Candidate& other = candidates_[oriel::at(c)];
    if (other.label == best->label || other.priority != best->priority) continue;
    margin = std::min(margin, best->score - other.score);
    choice.is_ambiguous = margin < pack_->decide.ambiguous_below;
  }
  choice.margin = margin;
  choice.runner_up = second == nullptr ? -1 : second->rule;
  label_now_[row] = best->label;
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

}  // namespace oriel::rules
