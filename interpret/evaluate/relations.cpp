#include "interpret/evaluate/relations.h"

#include "interpret/compile/refined_classes.h"
#include "interpret/evaluate/evaluator.h"
#include "interpret/explain/constraints.h"

#include <algorithm>
#include <array>
#include <utility>

namespace oriel::rules {

namespace {

/// What levels a condition of a relation reads: bit 0 self, bit 1 other.
constexpr unsigned kSelf = 1, kOther = 2;

/// True if each of `p` stands mirrored in `q`.
bool are_mirrored(const Pack& pack, const std::vector<ExprId>& p, const std::vector<ExprId>& q) {
  return std::ranges::all_of(p, [&](ExprId id) {
    return std::ranges::any_of(q, [&](ExprId other) { return is_mirrored(pack, id, other); });
  });
}

/// Of `f(self) = f(other)` what is asked of self; else kNoExpr.
ExprId compared_in(const Pack& pack, ExprId id) {
  const Expr& expr = pack.code[static_cast<std::size_t>(id)];
  if (expr.op != Op::equal || !is_mirrored(pack, expr.args[0], expr.args[1])) return kNoExpr;
  const bool is_first = pack.code[static_cast<std::size_t>(expr.args[0])].levels == kSelf;
  return expr.args[is_first ? 0 : 1];
}

std::optional<std::vector<ExprId>> compared_in(const Pack& pack, const RelationSides& sides) {
  if (!are_mirrored(pack, sides.of_self, sides.of_other) ||
      !are_mirrored(pack, sides.of_other, sides.of_self))
    return std::nullopt;
  std::vector<ExprId> keys;
  for (const ExprId id : sides.of_both) {
    keys.push_back(compared_in(pack, id));
    if (keys.back() == kNoExpr) return std::nullopt;
  }
  return keys;
}

/// Goes through the pairs of a relation block by block and keeps those that fit. Conditions on one
/// of the two alone are evaluated once for every feature, and only pairs that they leave are looked
/// at.
class Narrowing {
 public:
  Narrowing(const EvaluationContext& context, Evaluator& evaluator, const RelationSides& sides)
      : context_(context), evaluator_(evaluator), sides_(sides) {}

  Narrowed run(const Links& from) {
    const auto selves = answers_of(context_, evaluator_, sides_.of_self, 0);
    const auto others = answers_of(context_, evaluator_, sides_.of_other, 1);
    for (const int row : context_.row_numbers) {
      const Truth self = selves[static_cast<std::size_t>(row)];
      if (self == Truth::no) continue;
      const auto [begin, end] = from.range_of(row);
      for (std::size_t link = begin; link < end; ++link) {
        const int other = from.other(link);
        if (other == row) continue;
        const Truth fits = std::min(self, others[static_cast<std::size_t>(other)]);
        add(row, other, std::min(fits, from.is_other(row, link)));
      }
    }
    flush();
    Narrowed result;
    result.lists.list_of = context_.row_numbers;
    result.lists.starts.assign(context_.rows + 1, 0);
    for (const int self : kept_selves_) ++result.lists.starts[static_cast<std::size_t>(self) + 1];
    for (std::size_t row = 0; row < context_.rows; ++row)
      result.lists.starts[row + 1] += result.lists.starts[row];
    result.lists.others = std::move(kept_others_);
    if (has_unknown_) result.links.certain = std::move(kept_truths_);
    return result;
  }

 private:
  /// Pairs that do not fit are overwritten by the next, without a branch that nobody could foresee.
  void add(int self, int other, Truth truth) {
    if (size_ == kBlock) flush();
    selves_[size_] = self;
    others_[size_] = other;
    truths_[size_] = truth;
    size_ += truth != Truth::no ? 1 : 0;
  }

  void flush() {
    Frame frame;
    frame.size = size_;
    frame.rows[0] = selves_.data();
    frame.rows[1] = others_.data();
    narrow(evaluator_, sides_.of_both, frame, std::span(truths_).first(size_));
    for (std::size_t i = 0; i < size_; ++i) {
      if (truths_[i] == Truth::no) continue;
      has_unknown_ |= truths_[i] == Truth::unknown;
      kept_selves_.push_back(selves_[i]);
      kept_others_.push_back(others_[i]);
      kept_truths_.push_back(truths_[i]);
    }
    size_ = 0;
  }

  const EvaluationContext& context_;
  Evaluator& evaluator_;
  const RelationSides& sides_;
  std::vector<int> kept_selves_, kept_others_;
  std::vector<Truth> kept_truths_;
  bool has_unknown_ = false;
  std::size_t size_ = 0;
  std::array<int, kBlock> selves_;
  std::array<int, kBlock> others_;
  std::array<Truth, kBlock> truths_;
};

}  // namespace

RelationSides sides_of(const Pack& pack, const RelationDefinition& relation) {
  RelationSides sides;
  const Expr& where = pack.code[static_cast<std::size_t>(relation.where)];
  const std::vector<ExprId> whole{relation.where};
  for (const ExprId id : where.op == Op::all_of ? where.args : whole) {
    const unsigned levels = pack.code[static_cast<std::size_t>(id)].levels;
    auto& list = (levels & kOther) == 0  ? sides.of_self
                 : (levels & kSelf) == 0 ? sides.of_other
                                         : sides.of_both;
    list.push_back(id);
  }
  sides.keys = compared_in(pack, sides);
  return sides;
}

Narrowed narrowed(const Pack& pack, const EvaluationContext& context,
                  const RelationDefinition& relation) {
  const Links& from = context.relations[static_cast<std::size_t>(relation.within)];
  const RelationSides& sides = relation.sides;
  Evaluator evaluator(pack, context);
  if (sides.keys && from.lists->are_classes) {
    auto refined = refined_classes(pack, context, evaluator, from, sides.of_self, *sides.keys);
    if (refined) return std::move(*refined);
  }
  return Narrowing(context, evaluator, sides).run(from);
}

}  // namespace oriel::rules
