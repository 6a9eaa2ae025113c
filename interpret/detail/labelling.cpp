#include "interpret/detail/labelling.h"

#include <algorithm>
#include <utility>

namespace oriel::rules {

namespace {

std::size_t index(int id) { return static_cast<std::size_t>(id); }

}  // namespace

Labelling::Labelling(const Pack& pack, Facts& facts)
    : pack_(&pack),
      facts_(&facts),
      evaluator_(pack, facts),
      choices_(facts.rows),
      first_candidate_(facts.rows, -1),
      unknown_rows_(pack.classes.size()),
      raised_(pack.classes.size()),
      decided_(facts.rows, kNoClass) {
  for (ClassId id = 0; id < static_cast<ClassId>(raised_.size()); ++id)
    for (ClassId at = id; at != kNoClass; at = pack.classes[index(at)].parent) {
      const Class& c = pack.classes[index(at)];
      if (at == id || !c.is_abstract || !c.has_rules) raised_[index(id)].push_back(at);
    }
}

std::vector<Choice> Labelling::run() {
  if (pack_->rounds == 0) {
    run_round();
    return std::move(choices_);
  }
  const auto nothing = facts_->membership;
  facts_->previous.assign(nothing.size(), std::vector<Truth>(facts_->rows, Truth::unknown));
  while (true) {
    choices_.assign(facts_->rows, {});
    decided_.assign(facts_->rows, kNoClass);
    is_any_decided_ = false;
    run_round();
    rounds_.push_back(choices_);
    const bool is_last = static_cast<int>(rounds_.size()) == pack_->rounds;
    if (is_last || facts_->membership == facts_->previous) return std::move(choices_);
    facts_->previous = std::exchange(facts_->membership, nothing);
  }
}

std::vector<int> Labelling::unsettled() const {
  std::vector<int> rows;
  if (facts_->previous.empty()) return rows;
  for (const int row : facts_->row_numbers) {
    const auto r = static_cast<std::size_t>(row);
    for (std::size_t id = 0; id < facts_->membership.size(); ++id) {
      if (facts_->membership[id][r] == facts_->previous[id][r]) continue;
      rows.push_back(row);
      break;
    }
  }
  return rows;
}

void Labelling::run_round() {
  for (const Step& step : pack_->steps) {
    if (step.is_decision)
      run_decision(step);
    else
      run_predicates(step);
  }
}

/// Predicates that need each other start from "no" everywhere and are raised until nothing changes:
/// their least fixpoint, whatever the order.
void Labelling::run_predicates(const Step& step) {
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
  NumberBlock scores;
  std::vector<Truth> truths(facts_->rows);
  for (std::size_t begin = 0; begin < facts_->rows; begin += kBlock) {
    const Frame frame = block_of(*facts_, begin);
    Conjunction held(frame, std::span(truths).subspan(begin, frame.size));
    judge(*pack_, rule, evaluator_, held, scores);
    held.finish();
  }
  for (std::size_t row = 0; row < truths.size(); ++row)
    has_changed = raise_membership(rule.label, row, truths[row]) || has_changed;
  return has_changed;
}

/// Also raises what `id` is a kind of, where that is the union of its subclasses.
bool Labelling::raise_membership(ClassId id, std::size_t row, Truth truth) {
  if (truth == Truth::no) return false;
  bool has_changed = false;
  for (const ClassId at : raised_[index(id)]) {
    Truth& member = facts_->membership[index(at)][row];
    has_changed = has_changed || truth > member;
    member = std::max(member, truth);
  }
  return has_changed;
}

void Labelling::run_decision(const Step& step) {
  evaluator_.forget();
  candidates_.clear();
  decided_now_.clear();
  std::ranges::fill(first_candidate_, -1);
  for (const int id : step.rules) unknown_rows_[index(rule(id).label)].clear();
  for (const int id : step.rules) collect(id);
  for (std::size_t row = 0; row < facts_->rows; ++row)
    if (first_candidate_[row] >= 0) decide(row);
  settle_membership(step);
}

/// A label is final, but a later stratum may refine it to a subclass.
bool Labelling::is_open(std::size_t row, ClassId label) const {
  const ClassId decided = decided_[row];
  return decided == kNoClass || (decided != label && is_within(pack_->classes, label, decided));
}

/// Those that a rule for the label may still decide.
std::span<const int> Labelling::open_rows(ClassId label) {
  if (!is_any_decided_) return facts_->row_numbers;
  open_rows_.clear();
  for (const int row : facts_->row_numbers)
    if (is_open(index(row), label)) open_rows_.push_back(row);
  return open_rows_;
}

void Labelling::collect(int id) {
  TruthBlock truths;
  NumberBlock scores;
  const ClassId label = rule(id).label;
  const auto rows = open_rows(label);
  for (std::size_t begin = 0; begin < rows.size(); begin += kBlock) {
    Frame frame;
    frame.size = std::min(kBlock, rows.size() - begin);
    frame.rows[0] = rows.data() + begin;
    frame.is_run = !is_any_decided_;
    Conjunction held(frame, std::span(truths).first(frame.size));
    judge(*pack_, rule(id), evaluator_, held, scores);
    if (!held.is_open()) continue;
    const int* const left = held.frame().rows[0];
    for (std::size_t i = 0; i < held.truths().size(); ++i) {
      if (held.truths()[i] == Truth::yes)
        add_candidate(left[i], id, scores[i]);
      else if (held.truths()[i] == Truth::unknown)
        unknown_rows_[index(label)].push_back(left[i]);
    }
  }
}

void Labelling::add_candidate(int row, int id, double score) {
  int& first = first_candidate_[index(row)];
  candidates_.push_back({id, score, first});
  first = static_cast<int>(candidates_.size()) - 1;
}

/// By what wins: enough score, then priority, then score, then the rule's id.
bool Labelling::beats(const Candidate& p, const Candidate& q) const {
  const bool is_p_enough = p.score >= pack_->decide.min_score;
  const bool is_q_enough = q.score >= pack_->decide.min_score;
  if (is_p_enough != is_q_enough) return is_p_enough;
  const Rule& first = rule(p.rule);
  const Rule& second = rule(q.rule);
  if (first.priority != second.priority) return first.priority > second.priority;
  if (p.score != q.score) return p.score > q.score;
  return first.id < second.id;
}

void Labelling::decide(std::size_t row) {
  const Candidate* best = nullptr;
  for (int c = first_candidate_[row]; c >= 0; c = candidates_[index(c)].next)
    if (best == nullptr || beats(candidates_[index(c)], *best)) best = &candidates_[index(c)];
  if (best == nullptr || best->score < pack_->decide.min_score) return;
  const Rule& winner = rule(best->rule);
  Choice choice{best->rule, best->score, best->score, -1, false};
  const Candidate* second = nullptr;
  for (int c = first_candidate_[row]; c >= 0; c = candidates_[index(c)].next) {
    const Candidate& other = candidates_[index(c)];
    if (rule(other.rule).label == winner.label) continue;
    if (second == nullptr || beats(other, *second)) second = &other;
    if (rule(other.rule).priority != winner.priority) continue;
    choice.margin = std::min(choice.margin, best->score - other.score);
    choice.is_ambiguous = choice.margin < pack_->decide.ambiguous_below;
  }
  if (second != nullptr) choice.runner_up = second->rule;
  choices_[row] = choice;
  decided_[row] = winner.label;
  decided_now_.push_back(static_cast<int>(row));
}

/// A feature that is decided is no other class of this stratum, though a rule for it was unknown.
void Labelling::settle_membership(const Step& step) {
  is_any_decided_ = is_any_decided_ || !decided_now_.empty();
  for (const int row : decided_now_) raise_membership(decided_[index(row)], index(row), Truth::yes);
  for (const int id : step.rules) {
    const ClassId label = rule(id).label;
    for (const int row : unknown_rows_[index(label)])
      if (is_open(index(row), label)) raise_membership(label, index(row), Truth::unknown);
  }
}

}  // namespace oriel::rules
