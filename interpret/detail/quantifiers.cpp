#include "interpret/detail/pairs.h"

#include <algorithm>

namespace oriel::rules {

namespace {

void add(Evaluator::Tally& tally, Truth answer) {
  tally.yes += answer == Truth::yes ? 1 : 0;
  tally.unknown += answer == Truth::unknown ? 1 : 0;
}

/// How a pair answers a quantifier. Where it is unknown whether the other is one at all, the answer
/// is that of `is one and …`; of `all` it is that of `is none or …`.
Truth answer_of(Op op, Truth is_other, Truth answer) {
  return op == Op::all ? std::max(negated(is_other), answer) : std::min(is_other, answer);
}

}  // namespace

const std::vector<Truth>& Evaluator::column(ExprId id, int level) {
  auto& answers = columns_[static_cast<std::size_t>(id)];
  if (!answers.empty()) return answers;
  std::vector<Truth> computed(facts_->rows);
  for (std::size_t begin = 0; begin < facts_->rows; begin += kBlock) {
    const Frame frame = block_of(*facts_, begin, level);
    truths(id, frame, std::span(computed).subspan(begin, frame.size));
  }
  kept_.push_back(id);
  answers = std::move(computed);
  return answers;
}

void Evaluator::tally(ExprId id, const Frame& frame, std::span<Tally> out) {
  const Expr& expr = at(id);
  const Links& links = facts_->relations[static_cast<std::size_t>(expr.index)];
  const Truth* filter =
      expr.filter == kNoExpr ? nullptr : column(expr.filter, expr.level + 1).data();
  const int* rows = frame.rows[static_cast<std::size_t>(expr.level)];
  Pairs pairs;
  for (std::size_t slot = 0; slot < out.size(); ++slot) {
    out[slot] = {0, 0, 0};
    if (frame.needed != nullptr && frame.needed[slot] == Truth::no) continue;
    const std::size_t end = links.begin_of(rows[slot] + 1);
    out[slot].total = static_cast<int>(end - links.begin_of(rows[slot]));
    for (std::size_t link = links.begin_of(rows[slot]); link < end; ++link) {
      const int other = links.others[link];
      const Truth is_other = links.is_other(link);
      const Truth filtered =
          filter == nullptr ? Truth::yes : filter[static_cast<std::size_t>(other)];
      if (filtered == Truth::no || expr.join == kNoExpr) {
        add(out[slot], answer_of(expr.op, is_other, filtered));
        continue;
      }
      if (pairs.size == kBlock) flush(expr, pairs, out);
      pairs.add(slot, rows[slot], other, is_other, filtered);
    }
  }
  if (pairs.size > 0) flush(expr, pairs, out);
}

void Evaluator::flush(const Expr& expr, Pairs& pairs, std::span<Tally> out) {
  std::array<Truth, kBlock> joined;
  truths(expr.join, pairs.frame(expr.level), std::span(joined).first(pairs.size));
  for (std::size_t i = 0; i < pairs.size; ++i)
    add(out[pairs.slots[i]],
        answer_of(expr.op, pairs.is_other[i], std::min(pairs.filtered[i], joined[i])));
  pairs.size = 0;
}

/// exists: one yes settles it, else one unknown leaves it open. all is the mirror image, and holds
/// where there is no other.
void Evaluator::quantify(ExprId id, const Frame& frame, std::span<Truth> out) {
  const Op op = at(id).op;
  std::array<Tally, kBlock> tallies;
  tally(id, frame, std::span(tallies).first(out.size()));
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Tally& t = tallies[i];
    const int no = t.total - t.yes - t.unknown;
    const Truth open = t.unknown > 0 ? Truth::unknown : Truth::no;
    const Truth exists = t.yes > 0 ? Truth::yes : open;
    const Truth all = no > 0 ? Truth::no : negated(open);
    out[i] = op == Op::all ? all : op == Op::none ? negated(exists) : exists;
  }
}

}  // namespace oriel::rules
