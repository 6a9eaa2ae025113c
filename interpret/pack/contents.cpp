#include "interpret/pack/contents.h"

#include "interpret/evaluate/pack_values.h"
#include "interpret/pack/pack.h"

#include <algorithm>
#include <cstddef>

namespace oriel {

namespace {

using rules::Expr;
using rules::ExprId;
using rules::kNoExpr;
using rules::Op;
using rules::Pack;

/// Compares what two packs say, whose classes, relations and params may have other numbers in their
/// expressions only where they say the same.
class PackComparison {
 public:
  PackComparison(const RuleBase& one, const RuleBase& other)
      : one_(&one.pack()),
        other_(&other.pack()),
        one_values_(one.values()),
        other_values_(other.values()) {}

  [[nodiscard]] bool is_same() const {
    return is_same_settings() && one_->rounds == other_->rounds &&
           are_same(one_->classes, other_->classes,
                    [this](const auto& p, const auto& q) { return is_same_class(p, q); }) &&
           are_same(one_->relations, other_->relations,
                    [this](const auto& p, const auto& q) {
                      return p.name == q.name && p.within == q.within && is_same(p.where, q.where);
                    }) &&
           are_same(one_->groups, other_->groups,
                    [](const auto& p, const auto& q) {
                      return p.name == q.name && p.of == q.of && p.by == q.by &&
                             p.at_least == q.at_least;
                    }) &&
           are_same(one_->rules, other_->rules,
                    [this](const auto& p, const auto& q) { return is_same_rule(p, q); });
  }

 private:
  template <class Items, class IsSame>
  static bool are_same(const Items& p, const Items& q, const IsSame& is_same) {
    return std::ranges::equal(p, q, is_same);
  }

  [[nodiscard]] bool is_same_settings() const {
    const rules::PackSettings &p = one_values_, &q = other_values_;
    const rules::EvidenceSettings &s = one_->decide.evidence, &t = other_->decide.evidence;
    return p == q && s.is_written() == t.is_written() && s.company == t.company;
  }

  [[nodiscard]] bool is_same_class(const rules::Class& p, const rules::Class& q) const {
    return p.name == q.name && p.parent == q.parent && p.is_abstract == q.is_abstract &&
           are_same(p.typical, q.typical, [&](const rules::Typical& s, const rules::Typical& t) {
             return s.per == t.per && s.relation == t.relation &&
                    one_values_.count_of(*one_, s) == other_values_.count_of(*other_, t);
           });
  }

  [[nodiscard]] bool is_same_rule(const rules::Rule& p, const rules::Rule& q) const {
    const auto is_same_expr = [this](ExprId s, ExprId t) { return is_same(s, t); };
    return p.id == q.id && p.label == q.label && p.priority == q.priority &&
           are_same(p.require, q.require, is_same_expr) &&
           are_same(p.unless, q.unless, is_same_expr) &&
           are_same(p.score, q.score,
                    [this](const auto& s, const auto& t) { return is_same_term(s, t); });
  }

  [[nodiscard]] bool is_same_term(const rules::ScoreTerm& p, const rules::ScoreTerm& q) const {
    return p.weight == q.weight && is_same(p.value, q.value) && is_same_ramp(p.rise, q.rise) &&
           is_same_ramp(p.fall, q.fall);
  }

  [[nodiscard]] bool is_same_ramp(const std::optional<rules::Ramp>& p,
                                  const std::optional<rules::Ramp>& q) const {
    if (!p || !q) return p.has_value() == q.has_value();
    return is_same(p->from, q->from) && is_same(p->to, q->to);
  }

  /// Params are the same where their values are; words where they are written the same.
  [[nodiscard]] bool is_same(ExprId p, ExprId q) const {
    if (p == kNoExpr || q == kNoExpr) return p == q;
    const Expr& s = one_->code[static_cast<std::size_t>(p)];
    const Expr& t = other_->code[static_cast<std::size_t>(q)];
    if (s.op != t.op || s.type != t.type || s.level != t.level || s.is_previous != t.is_previous)
      return false;
    if (s.op == Op::parameter)
      return one_values_.params[static_cast<std::size_t>(s.index)] ==
             other_values_.params[static_cast<std::size_t>(t.index)];
    if (s.op == Op::constant && s.type == rules::Type::text)
      return one_->words[static_cast<std::size_t>(s.number)] ==
             other_->words[static_cast<std::size_t>(t.number)];
    return s.number == t.number && s.index == t.index && is_same(s.filter, t.filter) &&
           is_same(s.join, t.join) && is_same(s.value, t.value) &&
           are_same(s.args, t.args, [this](ExprId a, ExprId b) { return is_same(a, b); });
  }

  const Pack* one_;
  const Pack* other_;
  const rules::PackValues& one_values_;
  const rules::PackValues& other_values_;
};

}  // namespace

std::vector<ClassOfPack> classes_of(const RuleBase& base) {
  const Pack& pack = base.pack();
  std::vector<ClassOfPack> classes;
  classes.reserve(pack.classes.size());
  for (const rules::Class& c : pack.classes)
    classes.push_back({c.name, c.parent, c.is_abstract, pack.source.place(c.span.begin)});
  return classes;
}

std::vector<RuleOfPack> rules_of(const RuleBase& base) {
  const Pack& pack = base.pack();
  std::vector<RuleOfPack> all;
  all.reserve(pack.rules.size());
  for (const rules::Rule& rule : pack.rules)
    all.push_back({rule.id, pack.classes[static_cast<std::size_t>(rule.label)].name,
                   pack.source.place(rule.span.begin)});
  return all;
}

std::vector<Place> places_of_params(const RuleBase& base) {
  const Pack& pack = base.pack();
  std::vector<Place> places;
  places.reserve(pack.params.size());
  for (const rules::Param& param : pack.params)
    places.push_back(pack.source.place(param.span.begin));
  return places;
}

bool is_labelling_alike(const RuleBase& one, const RuleBase& other) {
  return PackComparison(one, other).is_same();
}

}  // namespace oriel
