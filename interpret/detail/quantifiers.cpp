#include "interpret/detail/evaluator.h"

#include <algorithm>

namespace oriel::rules {

/// Pairs self -> other that wait for the conditions on both.
struct Evaluator::Pairs {
  std::array<std::size_t, kBlock> slots;
  std::array<int, kBlock> selves;
  std::array<int, kBlock> others;
  std::array<Truth, kBlock> filtered;
  std::size_t size = 0;
};

namespace {

void add(Evaluator::Tally& tally, Truth answer) {
  tally.yes += answer == Truth::yes ? 1 : 0;
  tally.unknown += answer == Truth::unknown ? 1 : 0;
}

}  // namespace

const std::vector<Truth>& Evaluator::column(ExprId id, int level) {
  auto& answers = columns_[static_cast<std::size_t>(id)];
  if (!answers.empty()) return answers;
  std::vector<Truth> computed(facts_->rows);
  Frame frame;
  for (std::size_t begin = 0; begin < facts_->rows; begin += kBlock) {
    frame.size = std::min(kBlock, facts_->rows - begin);
    frame.rows[static_cast<std::size_t>(level)] = facts_->row_numbers.data() + begin;
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
    out[slot] = {};
    if (frame.needed != nullptr && frame.needed[slot] == Truth::no) continue;
    const auto others = links.of(rows[slot]);
    out[slot].total = static_cast<int>(others.size());
    for (const int other : others) {
      const Truth filtered =
          filter == nullptr ? Truth::yes : filter[static_cast<std::size_t>(other)];
      if (filtered == Truth::no) continue;
      if (expr.join == kNoExpr) {
        add(out[slot], filtered);
        continue;
      }
      if (pairs.size == kBlock) flush(expr, pairs, out);
      pairs.slots[pairs.size] = slot;
      pairs.selves[pairs.size] = rows[slot];
      pairs.others[pairs.size] = other;
      pairs.filtered[pairs.size++] = filtered;
    }
  }
  if (pairs.size > 0) flush(expr, pairs, out);
}

void Evaluator::flush(const Expr& expr, Pairs& pairs, std::span<Tally> out) {
  Frame frame;
  frame.size = pairs.size;
  frame.rows[static_cast<std::size_t>(expr.level)] = pairs.selves.data();
  frame.rows[static_cast<std::size_t>(expr.level) + 1] = pairs.others.data();
  std::array<Truth, kBlock> joined;
  truths(expr.join, frame, std::span(joined).first(pairs.size));
  for (std::size_t i = 0; i < pairs.size; ++i)
    add(out[pairs.slots[i]], std::min(pairs.filtered[i], joined[i]));
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
