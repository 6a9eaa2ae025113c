#include "interpret/explain/constraints.h"

#include "interpret/evaluate/arithmetic.h"
#include "interpret/evaluate/evaluator.h"
#include "interpret/pack/names.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace oriel::rules {

namespace {

/// Predicates of predicates are looked into so deep; what is deeper constrains nothing.
constexpr int kDeepest = 4;

const Expr& at(const Pack& pack, ExprId id) { return pack.code[static_cast<std::size_t>(id)]; }

bool is_own_attribute(const Expr& expr) { return expr.op == Op::attribute && expr.level == 0; }

bool is_same_but_for_level(const Expr& x, const Expr& y) {
  return x.op == y.op && x.type == y.type && x.number == y.number && x.index == y.index &&
         x.is_previous == y.is_previous && x.args.size() == y.args.size();
}

Op negated(Op op) {
  switch (op) {
    case Op::less:
      return Op::greater_equal;
    case Op::less_equal:
      return Op::greater;
    case Op::greater:
      return Op::less_equal;
    case Op::greater_equal:
      return Op::less;
    default:
      return op == Op::equal ? Op::not_equal : Op::equal;
  }
}

std::optional<ValueInterval> interval_of(Op op, double bound, ExprId by) {
  ValueInterval all;
  if (op == Op::less || op == Op::less_equal || op == Op::equal) {
    all.high = bound;
    all.high_by = by;
    all.is_high_open = op == Op::less;
  }
  if (op == Op::greater || op == Op::greater_equal || op == Op::equal) {
    all.low = bound;
    all.low_by = by;
    all.is_low_open = op == Op::greater;
  }
  return op == Op::not_equal ? std::nullopt : std::optional(all);
}

std::optional<AttributeTest> comparison_test(const Pack& pack, ExprId id, bool is_negated) {
  const Expr& expr = at(pack, id);
  const bool is_turned = is_constant(at(pack, expr.args[0]));
  const Expr& value = at(pack, expr.args[is_turned ? 1 : 0]);
  const auto bound = fold(pack, expr.args[is_turned ? 0 : 1]);
  if (!is_own_attribute(value) || value.type != Type::number || !bound || std::isnan(*bound))
    return std::nullopt;
  Op op = is_turned ? mirrored(expr.op) : expr.op;
  if (is_negated) op = negated(op);
  const auto interval = interval_of(op, *bound, id);
  if (!interval) return std::nullopt;
  return AttributeTest{value.index, *interval};
}

std::optional<AttributeTest> range_test(const Pack& pack, ExprId id) {
  const Expr& expr = at(pack, id);
  const auto low = fold(pack, expr.args[1]);
  const auto high = fold(pack, expr.args[2]);
  if (!is_own_attribute(at(pack, expr.args[0])) || !low || !high) return std::nullopt;
  return AttributeTest{at(pack, expr.args[0]).index, {*low, *high, false, false, id, id}};
}

std::optional<AttributeTest> facet_test(const Pack& pack, ExprId id) {
  const Expr& expr = at(pack, id);
  if (expr.level != 0) return std::nullopt;
  const AngleRange range = PackValues(pack).range_of(static_cast<HostKind>(expr.index));
  return AttributeTest{static_cast<int>(column_of(Attribute::host_inclination)),
                       {range.low_deg, range.high_deg, false, false, id, id}};
}

/// The words that `text = word` or `text in [..]` compares with; nothing if one is no constant.
std::optional<std::set<double>> words_of(const Pack& pack, const Expr& expr) {
  std::set<double> words;
  for (std::size_t i = 1; i < expr.args.size(); ++i) {
    const Expr& word = at(pack, expr.args[i]);
    if (word.op != Op::constant || word.type != Type::text) return std::nullopt;
    words.insert(word.number);
  }
  return words;
}

bool is_word_test(const Pack& pack, const Expr& expr) {
  const bool is_test = expr.op == Op::equal || expr.op == Op::not_equal || expr.op == Op::in_list;
  return is_test && is_own_attribute(at(pack, expr.args[0])) &&
         at(pack, expr.args[0]).type == Type::text;
}

}  // namespace

bool ValueInterval::is_inside(const ValueInterval& other) const {
  const bool is_low = low > other.low || (low == other.low && (is_low_open || !other.is_low_open));
  const bool is_high =
      high < other.high || (high == other.high && (is_high_open || !other.is_high_open));
  return is_low && is_high;
}

std::optional<AttributeTest> attribute_test(const Pack& pack, ExprId id, bool is_negated) {
  switch (at(pack, id).op) {
    case Op::less:
    case Op::less_equal:
    case Op::greater:
    case Op::greater_equal:
    case Op::equal:
    case Op::not_equal:
      return comparison_test(pack, id, is_negated);
    case Op::in_range:
      return is_negated ? std::nullopt : range_test(pack, id);
    case Op::facet_is:
      return is_negated ? std::nullopt : facet_test(pack, id);
    default:
      return std::nullopt;
  }
}

bool is_same(const Pack& pack, ExprId p, ExprId q) {
  if (p == q) return true;
  if (p == kNoExpr || q == kNoExpr) return false;
  const Expr& x = at(pack, p);
  const Expr& y = at(pack, q);
  if (!is_same_but_for_level(x, y) || x.level != y.level) return false;
  for (std::size_t i = 0; i < x.args.size(); ++i)
    if (!is_same(pack, x.args[i], y.args[i])) return false;
  return is_same(pack, x.filter, y.filter) && is_same(pack, x.join, y.join) &&
         is_same(pack, x.value, y.value);
}

bool is_mirrored(const Pack& pack, ExprId p, ExprId q) {
  const Expr& x = at(pack, p);
  const Expr& y = at(pack, q);
  const bool reads_feature = x.args.empty() && x.levels != 0;
  const int level = reads_feature ? 1 - x.level : x.level;
  if (is_quantifier(x.op) || !is_same_but_for_level(x, y) || level != y.level) return false;
  for (std::size_t i = 0; i < x.args.size(); ++i)
    if (!is_mirrored(pack, x.args[i], y.args[i])) return false;
  return true;
}

Constraints::Constraints(const Pack& pack, const std::vector<ExprId>& conditions)
    : Constraints(pack, 0) {
  for (const ExprId id : conditions) add(id, false);
}

void Constraints::contradict(ExprId earlier, ExprId later) {
  if (!contradiction_) contradiction_ = {earlier, later};
}

void Constraints::add(ExprId id, bool is_negated) {
  const Expr& expr = at(*pack_, id);
  if (expr.op == Op::negation) return add(expr.args[0], !is_negated);
  const bool is_conjunction = expr.op == (is_negated ? Op::any_of : Op::all_of);
  if (is_conjunction) {
    for (const ExprId arg : expr.args) add(arg, is_negated);
    return;
  }
  if (const auto test = attribute_test(*pack_, id, is_negated))
    add_interval(test->column, test->interval);
  else if (is_word_test(*pack_, expr))
    add_words(expr, id, is_negated);
  add_other(id, is_negated);
}

void Constraints::add_interval(int column, const ValueInterval& interval) {
  ValueInterval& left = intervals_[column];
  const bool was_empty = left.is_empty();
  if (interval.low > left.low || (interval.low == left.low && interval.is_low_open)) {
    left.low = interval.low;
    left.is_low_open = interval.is_low_open;
    left.low_by = interval.low_by;
  }
  if (interval.high < left.high || (interval.high == left.high && interval.is_high_open)) {
    left.high = interval.high;
    left.is_high_open = interval.is_high_open;
    left.high_by = interval.high_by;
  }
  if (was_empty || !left.is_empty()) return;
  contradict(std::min(left.low_by, left.high_by), std::max(left.low_by, left.high_by));
}

void Constraints::add_words(const Expr& expr, ExprId id, bool is_negated) {
  auto allowed = words_of(*pack_, expr);
  if (!allowed || is_negated != (expr.op == Op::not_equal)) return;
  const auto [place, is_new] = words_.try_emplace(at(*pack_, expr.args[0]).index);
  Words& words = place->second;
  if (!is_new) std::erase_if(*allowed, [&](double w) { return !words.allowed.contains(w); });
  if (allowed->empty()) contradict(is_new ? id : words.by, id);
  words.allowed = std::move(*allowed);
  words.by = id;
}

/// What all rules of a predicate have in common holds for every feature that is one.
void Constraints::add_predicate(ClassId id, ExprId by) {
  const Class& c = pack_->classes[static_cast<std::size_t>(id)];
  if (!c.is_abstract || !c.has_rules || depth_ >= kDeepest) return;
  std::optional<Constraints> common;
  for (const Rule& rule : pack_->rules) {
    if (rule.label != id) continue;
    Constraints constraints(*pack_, depth_ + 1);
    for (const ExprId condition : rule.require) constraints.add(condition, false);
    if (!common)
      common = std::move(constraints);
    else
      common->keep_common(constraints);
  }
  if (!common) return;
  for (auto [column, interval] : common->intervals_) {
    interval.low_by = interval.high_by = by;
    add_interval(column, interval);
  }
  for (const auto& [column, theirs] : common->words_) {
    const auto [place, is_new] = words_.try_emplace(column, Words{theirs.allowed, by});
    if (is_new) continue;
    std::erase_if(place->second.allowed, [&](double w) { return !theirs.allowed.contains(w); });
    if (place->second.allowed.empty())
      contradict(std::min(place->second.by, by), std::max(place->second.by, by));
  }
}

/// Conditions of any kind contradict their own opposite.
void Constraints::add_other(ExprId id, bool is_negated) {
  const Expr& expr = at(*pack_, id);
  // The bounds of walls, roofs and grounds touch, but no facet is two of them.
  const auto is_other_facet = [&](const Expr& mine) {
    return !is_negated && expr.op == Op::facet_is && mine.op == Op::facet_is && expr.level == 0 &&
           mine.level == 0 && expr.index != mine.index;
  };
  for (const auto& [other, is_other_negated] : others_) {
    const bool is_opposite = is_negated != is_other_negated && is_same(*pack_, id, other);
    if (is_opposite || (!is_other_negated && is_other_facet(at(*pack_, other))))
      contradict(other, id);
  }
  others_.emplace_back(id, is_negated);
  if (expr.op == Op::is_class && expr.level == 0 && !is_negated) add_predicate(expr.index, id);
}

/// The smallest interval around both.
void Constraints::keep_common(const Constraints& other) {
  for (auto mine = intervals_.begin(); mine != intervals_.end();) {
    const auto theirs = other.intervals_.find(mine->first);
    if (theirs == other.intervals_.end()) {
      mine = intervals_.erase(mine);
      continue;
    }
    ValueInterval& all = mine->second;
    const ValueInterval& more = theirs->second;
    const bool is_low_same = all.low == more.low;
    const bool is_high_same = all.high == more.high;
    if (is_low_same) all.is_low_open = all.is_low_open && more.is_low_open;
    if (is_high_same) all.is_high_open = all.is_high_open && more.is_high_open;
    if (more.low < all.low)
      std::tie(all.low, all.is_low_open) = std::tie(more.low, more.is_low_open);
    if (more.high > all.high)
      std::tie(all.high, all.is_high_open) = std::tie(more.high, more.is_high_open);
    ++mine;
  }
  for (auto mine = words_.begin(); mine != words_.end();) {
    const auto theirs = other.words_.find(mine->first);
    if (theirs == other.words_.end()) {
      mine = words_.erase(mine);
      continue;
    }
    mine->second.allowed.insert(theirs->second.allowed.begin(), theirs->second.allowed.end());
    ++mine;
  }
}

bool Constraints::imply(ExprId condition) const { return implies(condition, false); }

bool Constraints::implies_words(const Expr& expr, bool is_negated) const {
  const auto words = words_of(*pack_, expr);
  const auto mine = words_.find(at(*pack_, expr.args[0]).index);
  if (!words || mine == words_.end()) return false;
  const bool wants_in = is_negated == (expr.op == Op::not_equal);
  return std::ranges::all_of(mine->second.allowed,
                             [&](double w) { return words->contains(w) == wants_in; });
}

bool Constraints::implies(ExprId id, bool is_negated) const {
  const Expr& expr = at(*pack_, id);
  if (expr.op == Op::negation) return implies(expr.args[0], !is_negated);
  const auto is_implied = [&](ExprId arg) { return implies(arg, is_negated); };
  if (expr.op == Op::all_of || expr.op == Op::any_of) {
    const bool is_conjunction = (expr.op == Op::all_of) != is_negated;
    return is_conjunction ? std::ranges::all_of(expr.args, is_implied)
                          : std::ranges::any_of(expr.args, is_implied);
  }
  for (const auto& [other, is_other_negated] : others_)
    if (is_negated == is_other_negated && is_same(*pack_, id, other)) return true;
  if (const auto test = attribute_test(*pack_, id, is_negated)) {
    // Bounds of `host is` belong to walls first: they say less than their interval.
    const auto mine = intervals_.find(test->column);
    return expr.op != Op::facet_is && mine != intervals_.end() &&
           mine->second.is_inside(test->interval);
  }
  if (is_word_test(*pack_, expr)) return implies_words(expr, is_negated);
  if (expr.op != Op::is_class || expr.level != 0 || is_negated || expr.is_previous) return false;
  return std::ranges::any_of(others_, [&](const auto& other) {
    const Expr& mine = at(*pack_, other.first);
    return !other.second && mine.op == Op::is_class && mine.level == 0 && !mine.is_previous &&
           is_within(pack_->classes, mine.index, expr.index);
  });
}

}  // namespace oriel::rules
