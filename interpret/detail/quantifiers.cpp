#include "interpret/detail/arithmetic.h"
#include "interpret/detail/pairs.h"
#include "kernel/model/detail/index.h"

#include <algorithm>
#include <limits>

namespace oriel::rules {

namespace {

void add(Evaluator::Tally& tally, Truth answer) {
  tally.yes += answer == Truth::yes ? 1 : 0;
  tally.unknown += answer == Truth::unknown ? 1 : 0;
  tally.no += answer == Truth::no ? 1 : 0;
}

/// How a pair answers a quantifier. Where it is unknown whether the other is one at all, the answer
/// is that of `is one and …`; of `all` it is that of `is none or …`.
Truth answer_of(Op op, Truth is_other, Truth answer) {
  return op == Op::all ? std::max(negated(is_other), answer) : std::min(is_other, answer);
}

/// Whether it is unknown of an other of the row that it is one, or how it answers the filter.
bool has_unknown(const Links& links, int row, const Truth* filter) {
  const auto [begin, end] = links.range_of(row);
  bool is_unknown = false;
  for (std::size_t link = begin; link < end; ++link) {
    const int other = links.other(link);
    const Truth filtered = filter == nullptr ? Truth::yes : filter[oriel::at(other)];
    is_unknown |= other != row && std::min(links.is_other(row, link), filtered) == Truth::unknown;
  }
  return is_unknown;
}

/// How many others of a slot are asked at first: some more than could be enough.
std::size_t first_share(Evaluator::Enough enough) {
  constexpr int kAll = std::numeric_limits<int>::max() / 4;
  const int least = std::min(enough.yes, enough.no);
  return static_cast<std::size_t>(least > kAll ? kAll : least + 2);
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

/// Pairs are asked in rounds, of each slot that is still open some of its others, then twice as
/// many: so a block holds pairs of many slots, and few pairs are asked that nobody needs.
void Evaluator::tally(ExprId id, const Frame& frame, std::span<Tally> out, Enough enough) {
  const Expr& expr = at(id);
  const Links& links = facts_->relations[static_cast<std::size_t>(expr.index)];
  const Truth* filter =
      expr.filter == kNoExpr ? nullptr : column(expr.filter, expr.level + 1).data();
  const int* rows = frame.rows[static_cast<std::size_t>(expr.level)];
  Pairs pairs;
  // Of each slot the links that are left, and whether it is settled by nothing but all answers;
  // then the open slots.
  std::array<Links::Range, kBlock> left_of;
  std::array<bool, kBlock> asks_all;
  std::array<std::uint16_t, kBlock> open;
  std::size_t open_count = 0;
  const bool may_be_unknown =
      enough.minds_unknown &&
      (!links.are_all_certain() ||
       (filter != nullptr &&
        std::find(filter, filter + facts_->rows, Truth::unknown) != filter + facts_->rows));
  for (std::size_t slot = 0; slot < out.size(); ++slot) {
    out[slot] = {0, 0, 0};
    if (frame.needed != nullptr && frame.needed[slot] == Truth::no) continue;
    left_of[slot] = links.range_of(rows[slot]);
    asks_all[slot] = may_be_unknown && has_unknown(links, rows[slot], filter);
    open[open_count++] = static_cast<std::uint16_t>(slot);
  }
  const auto is_settled = [&](std::size_t slot) {
    return !asks_all[slot] && enough.settles(out[slot]);
  };
  /// Asks up to `share` others of a slot; true if some are left.
  const auto ask = [&](std::size_t slot, std::size_t share) {
    auto& [link, end] = left_of[slot];
    for (; link < end && share > 0 && !is_settled(slot); ++link) {
      const int other = links.other(link);
      if (other == rows[slot]) continue;
      const Truth is_other = links.is_other(rows[slot], link);
      const Truth filtered = filter == nullptr ? Truth::yes : filter[oriel::at(other)];
      if (filtered == Truth::no || expr.join == kNoExpr) {
        add(out[slot], answer_of(expr.op, is_other, filtered));
        continue;
      }
      if (pairs.size == kBlock) flush(expr, pairs, out);
      pairs.add(slot, rows[slot], other, is_other, filtered);
      --share;
    }
    return link < end;
  };
  for (std::size_t share = first_share(enough); open_count > 0; share *= 2) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < open_count; ++i)
      if (ask(open[i], share)) open[left++] = open[i];
    if (pairs.size > 0) flush(expr, pairs, out);
    open_count = 0;
    for (std::size_t i = 0; i < left; ++i)
      if (!is_settled(open[i])) open[open_count++] = open[i];
  }
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
  Enough enough;
  (op == Op::all ? enough.no : enough.yes) = 1;
  std::array<Tally, kBlock> tallies;
  tally(id, frame, std::span(tallies).first(out.size()), enough);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Tally& t = tallies[i];
    const Truth open = t.unknown > 0 ? Truth::unknown : Truth::no;
    const Truth exists = t.yes > 0 ? Truth::yes : open;
    const Truth all = t.no > 0 ? Truth::no : negated(open);
    out[i] = op == Op::all ? all : op == Op::none ? negated(exists) : exists;
  }
}

/// One unknown answer makes the count unknown, so all must be asked where there may be one.
void Evaluator::count(ExprId id, const Frame& frame, std::span<double> out, int limit) {
  Enough enough;
  const ExprId join = at(id).join;
  if (limit < enough.yes && (join == kNoExpr || is_always_known(join))) {
    enough.yes = limit;
    enough.minds_unknown = true;
  }
  std::array<Tally, kBlock> tallies;
  tally(id, frame, std::span(tallies).first(out.size()), enough);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = tallies[i].unknown > 0 ? kUnknown : tallies[i].yes;
}

}  // namespace oriel::rules
