#include "interpret/evaluate/relations.h"

#include "interpret/evaluate/evaluator.h"
#include "interpret/explain/constraints.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <optional>
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
  const Expr& expr = pack.code[oriel::at(id)];
  if (expr.op != Op::equal || !is_mirrored(pack, expr.args[0], expr.args[1])) return kNoExpr;
  const bool is_first = pack.code[oriel::at(expr.args[0])].levels == kSelf;
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

bool has_unknown(const std::vector<Truth>& truths) {
  return std::ranges::find(truths, Truth::unknown) != truths.end();
}

/// For every feature whether all of the conditions hold, which read that level only.
std::vector<Truth> answers_of(const EvaluationContext& context, Evaluator& evaluator,
                              const std::vector<ExprId>& conditions, int level) {
  std::vector<Truth> answers;
  answers.reserve(context.rows);
  for (const int row : context.row_numbers)
    answers.push_back(evaluator.all_hold(conditions, rows_of(row, level)));
  return answers;
}

/// Keeps the pairs that fit. Conditions on one of the two alone are evaluated once for every
/// feature.
NarrowedRelation narrowed_pairs(const EvaluationContext& context, Evaluator& evaluator,
                                const Links& from, const RelationSides& sides) {
  const auto selves = answers_of(context, evaluator, sides.of_self, 0);
  const auto others = answers_of(context, evaluator, sides.of_other, 1);
  NarrowedRelation result;
  result.lists.list_of = context.row_numbers;
  result.lists.starts.clear();
  std::vector<Truth> certain;
  for (const int self : context.row_numbers) {
    result.lists.starts.push_back(static_cast<int>(certain.size()));
    const auto [begin, end] = from.range_of(self);
    for (std::size_t link = begin; link < end; ++link) {
      const int other = from.other(link);
      if (other == self) continue;
      Truth fits =
          std::min({selves[oriel::at(self)], others[oriel::at(other)], from.is_other(self, link)});
      FeatureRows pair = rows_of(self);
      pair[1] = other;
      if (fits != Truth::no) fits = std::min(fits, evaluator.all_hold(sides.of_both, pair));
      if (fits == Truth::no) continue;
      result.lists.others.push_back(other);
      certain.push_back(fits);
    }
  }
  result.lists.starts.push_back(static_cast<int>(certain.size()));
  if (has_unknown(certain)) result.links.certain = std::move(certain);
  return result;
}

/// Cuts the classes of `from` where their members differ in `values`; those that do not fit are
/// left out. Rows of one value stay in their order.
FeatureLinks divided(const FeatureLinks& from, const std::vector<Truth>& fits,
                     const std::vector<double>& values) {
  FeatureLinks parts;
  parts.are_classes = true;
  parts.starts.clear();
  parts.list_of.assign(fits.size(), -1);
  std::vector<int> members;
  for (std::size_t list = 0; list < from.lists(); ++list) {
    members.clear();
    for (const int row : from.list(list))
      if (fits[oriel::at(row)] != Truth::no) members.push_back(row);
    std::ranges::stable_sort(members, {}, [&](int row) { return values[oriel::at(row)]; });
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i == 0 || values[oriel::at(members[i])] != values[oriel::at(members[i - 1])])
        parts.starts.push_back(static_cast<int>(parts.others.size()));
      parts.list_of[oriel::at(members[i])] = static_cast<int>(parts.starts.size()) - 1;
      parts.others.push_back(members[i]);
    }
  }
  parts.starts.push_back(static_cast<int>(parts.others.size()));
  return parts;
}

/// The classes of `from` without the features that do not fit the conditions on self, divided by
/// the keys. Nothing if a value is missing: then it is unknown of pairs, not of features, whether
/// they belong together.
std::optional<NarrowedRelation> divided_classes(const EvaluationContext& context,
                                                Evaluator& evaluator, const Links& from,
                                                const RelationSides& sides) {
  std::vector<Truth> fits = answers_of(context, evaluator, sides.of_self, 0);
  for (std::size_t row = 0; row < from.certain_rows.size(); ++row)
    fits[row] = std::min(fits[row], from.certain_rows[row]);
  NarrowedRelation result;
  result.lists = divided(*from.lists, fits, std::vector<double>(context.rows));
  std::vector<double> values(context.rows);
  for (const ExprId key : *sides.keys) {
    for (const int row : result.lists.others) {
      values[oriel::at(row)] = evaluator.number(key, rows_of(row));
      if (std::isnan(values[oriel::at(row)])) return std::nullopt;
    }
    result.lists = divided(result.lists, fits, values);
  }
  if (has_unknown(fits)) result.links.certain_rows = std::move(fits);
  return result;
}

}  // namespace

RelationSides sides_of(const Pack& pack, const RelationDefinition& relation) {
  RelationSides sides;
  const Expr& where = pack.code[oriel::at(relation.where)];
  const std::vector<ExprId> whole{relation.where};
  for (const ExprId id : where.op == Op::all_of ? where.args : whole) {
    const unsigned levels = pack.code[oriel::at(id)].levels;
    auto& list = (levels & kOther) == 0  ? sides.of_self
                 : (levels & kSelf) == 0 ? sides.of_other
                                         : sides.of_both;
    list.push_back(id);
  }
  sides.keys = compared_in(pack, sides);
  return sides;
}

NarrowedRelation narrowed(const Pack& pack, const EvaluationContext& context,
                          const RelationDefinition& relation) {
  const Links& from = context.relations[oriel::at(relation.within)];
  Evaluator evaluator(pack, context);
  if (relation.sides.keys && from.lists->are_classes)
    if (auto classes = divided_classes(context, evaluator, from, relation.sides))
      return std::move(*classes);
  return narrowed_pairs(context, evaluator, from, relation.sides);
}

}  // namespace oriel::rules
