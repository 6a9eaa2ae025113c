#include "interpret/surfaces/surface_decider.h"

#include <algorithm>
#include <array>

namespace oriel::rules {

SurfaceDecider::SurfaceDecider(const SurfaceRules& surfaces, const SurfaceTable& table,
                               const MoreAttributes* more)
    : surfaces_(surfaces),
      more_(more),
      context_(surfaces.pack, table),
      evaluator_(surfaces.pack, context_),
      conjuncts_(surfaces.rules.size()) {
  for (std::size_t r = 0; r < conjuncts_.size(); ++r)
    for (const ExprId id : surfaces.rules[r].when) add_conjuncts(id, conjuncts_[r]);
}

void SurfaceDecider::add_conjuncts(ExprId id, std::vector<SurfaceConjunct>& conjuncts) const {
  const auto parts = evaluator_.parts(id);
  for (const ExprId part : parts) add_conjuncts(part, conjuncts);
  if (parts.empty()) conjuncts.push_back({id, !reads_pending(id)});
}

bool SurfaceDecider::reads_pending(ExprId id) const {
  if (more_ == nullptr) return false;
  const Expr& expr = surfaces_.pack.code[static_cast<std::size_t>(id)];
  if (expr.op == Op::attribute || expr.op == Op::flag)
    return more_->is_pending(kSurfaceAttributes[static_cast<std::size_t>(expr.index)]);
  return std::ranges::any_of(expr.args, [&](ExprId arg) { return reads_pending(arg); });
}

void SurfaceDecider::look_again() {
  first_rule_ = first_doubtful_;
  for (auto& of_rule : conjuncts_)
    for (SurfaceConjunct& conjunct : of_rule) conjunct.is_final = !reads_pending(conjunct.id);
}

std::vector<int> SurfaceDecider::decide(std::span<const int> rows) {
  undecided_.clear();
  first_doubtful_ = conjuncts_.size();
  std::vector<int> deciding(rows.size(), -1);
  for (std::size_t begin = 0; begin < rows.size(); begin += kBlock) {
    const std::size_t size = std::min(kBlock, rows.size() - begin);
    decide_block(rows.subspan(begin, size), std::span(deciding).subspan(begin, size));
  }
  return deciding;
}

/// What is unknown for good does not hold.
void SurfaceDecider::ask(const Frame& frame, const SurfaceConjunct& conjunct,
                         std::span<Truth> holds) {
  std::array<Truth, kBlock> block;
  const auto answer = std::span(block).first(holds.size());
  evaluator_.truths(conjunct.id, frame, answer);
  for (std::size_t i = 0; i < holds.size(); ++i) {
    if (conjunct.is_final && answer[i] != Truth::yes) answer[i] = Truth::no;
    holds[i] = std::min(holds[i], answer[i]);
  }
}

void SurfaceDecider::decide_block(std::span<const int> rows, std::span<int> deciding) {
  std::array<Truth, kBlock> open_block, holds_block;
  std::array<bool, kBlock> is_doubtful;
  Frame frame;
  frame.size = rows.size();
  frame.rows[0] = rows.data();
  const auto open = std::span(open_block).first(frame.size);
  const auto holds = std::span(holds_block).first(frame.size);
  frame.needed = holds.data();
  std::ranges::fill(open, Truth::yes);
  std::fill_n(is_doubtful.begin(), frame.size, false);
  const auto is_needed = [](Truth truth) { return truth != Truth::no; };
  for (std::size_t r = first_rule_; r < conjuncts_.size(); ++r) {
    std::ranges::copy(open, holds.begin());
    for (const SurfaceConjunct& conjunct : conjuncts_[r]) {
      if (!std::ranges::any_of(holds, is_needed)) break;
      ask(frame, conjunct, holds);
    }
    for (std::size_t i = 0; i < frame.size; ++i) {
      if (holds[i] == Truth::no) continue;
      if (holds[i] == Truth::unknown) {
        is_doubtful[i] = true;
        first_doubtful_ = std::min(first_doubtful_, r);
        continue;
      }
      deciding[i] = static_cast<int>(r);
      open[i] = Truth::no;
    }
  }
  for (std::size_t i = 0; i < frame.size; ++i)
    if (is_doubtful[i]) undecided_.push_back(rows[i]);
}

}  // namespace oriel::rules
