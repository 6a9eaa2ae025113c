#include "interpret/labelling/candidates.h"

#include "kernel/base/index.h"

#include <algorithm>

namespace oriel::rules {

namespace {

bool beats(const Pack& pack, const PackValues& values, const Candidate& p, const Candidate& q) {
  const Rule& p_rule = pack.rules[oriel::at(p.rule)];
  const Rule& q_rule = pack.rules[oriel::at(q.rule)];
  const bool is_p_enough = p.total() >= values.min_score;
  const bool is_q_enough = q.total() >= values.min_score;
  if (is_p_enough != is_q_enough) return is_p_enough;
  if (p_rule.priority != q_rule.priority) return p_rule.priority > q_rule.priority;
  if (p.total() != q.total()) return p.total() > q.total();
  return p_rule.id < q_rule.id;
}

}  // namespace

void sort_candidates(const Pack& pack, const PackValues& values,
                     std::vector<Candidate>& candidates) {
  std::ranges::sort(candidates, [&](const Candidate& p, const Candidate& q) {
    return beats(pack, values, p, q);
  });
}

Choice choose(const Pack& pack, const PackValues& values,
              const std::vector<Candidate>& candidates) {
  if (candidates.empty() || candidates.front().total() < values.min_score) return {};
  const Candidate& best = candidates.front();
  const Rule& winner = pack.rules[oriel::at(best.rule)];
  const double score = std::clamp(best.total(), 0.0, 1.0);
  Choice choice{.rule = best.rule, .score = score, .margin = score};
  for (const Candidate& other : candidates) {
    const Rule& rival = pack.rules[oriel::at(other.rule)];
    if (rival.label == winner.label) continue;
    if (choice.runner_up < 0) choice.runner_up = other.rule;
    if (rival.priority != winner.priority) continue;
    choice.margin = std::min(choice.margin, best.total() - other.total());
    choice.is_ambiguous = choice.margin < values.ambiguous_below;
  }
  return choice;
}

}  // namespace oriel::rules
