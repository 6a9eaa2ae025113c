#include "interpret/relabelling/variant.h"

#include "interpret/pack/names.h"
#include "interpret/pack/pack.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using rules::ExprId;
using rules::Pack;
using rules::Rule;
using rules::SourceSpan;

/// Goes through a pack and lists what can be left out.
class AblationFinder {
 public:
  explicit AblationFinder(const Pack& pack) : pack_(pack) {}

  std::vector<Variant> run() {
    add_counts();
    for (int rule = 0; rule < static_cast<int>(pack_.rules.size()); ++rule) add_rule(rule);
    add_evidence();
    return std::move(found_);
  }

 private:
  using Kind = DroppedPart::Kind;

  void add(DroppedPart part, std::string name, SourceSpan span) {
    Variant& variant = found_.emplace_back();
    variant.name = "without " + std::move(name);
    variant.without = {part};
    variant.place = pack_.source.place(span.begin);
  }

  [[nodiscard]] SourceSpan span_of(ExprId id) const { return pack_.code[at(id)].span; }
  [[nodiscard]] std::string_view text_of(ExprId id) const {
    return pack_.source.text_of(span_of(id));
  }

  void add_rule(int number) {
    const Rule& rule = pack_.rules[at(number)];
    add({Kind::rule, number}, "rule " + rule.id, rule.span);
    for (int item = 0; item < static_cast<int>(rule.require.size()); ++item)
      add_condition(number, item);
    const auto add_item = [&](Kind kind, int item, ExprId id, const char* what) {
      add({kind, number, item}, fmt::format("{} '{}' of {}", what, text_of(id), rule.id),
          span_of(id));
    };
    for (int item = 0; item < static_cast<int>(rule.unless.size()); ++item)
      add_item(Kind::veto, item, rule.unless[at(item)], "unless");
    for (int item = 0; item < static_cast<int>(rule.score.size()); ++item)
      add_item(Kind::score_term, item, rule.score[at(item)].value, "score");
  }

  /// The conditions that are joined by `and` in the rule itself; what a macro joins is one.
  void add_condition(int number, int item) {
    const Rule& rule = pack_.rules[at(number)];
    const ExprId id = rule.require[at(item)];
    const rules::Expr& expr = pack_.code[at(id)];
    const auto add_one = [&](int part, ExprId dropped) {
      add({Kind::condition, number, item, part},
          fmt::format("'{}' of {}", text_of(dropped), rule.id), span_of(dropped));
    };
    const bool is_joined = expr.op == rules::Op::all_of && expr.args.size() > 1;
    if (is_joined)
      for (int part = 0; part < static_cast<int>(expr.args.size()); ++part)
        add_one(part, expr.args[at(part)]);
    else if (rule.require.size() > 1)
      add_one(-1, id);
  }

  void add_counts() {
    if (!pack_.decide.evidence.is_written()) return;
    for (int id = 0; id < static_cast<int>(pack_.classes.size()); ++id) {
      const rules::Class& c = pack_.classes[at(id)];
      for (int item = 0; item < static_cast<int>(c.typical.size()); ++item)
        add({Kind::typical, id, item},
            fmt::format("typical number of {} per {}", c.name, c.typical[at(item)].per),
            c.typical[at(item)].span);
    }
  }

  void add_evidence() {
    const rules::EvidenceSettings& evidence = pack_.decide.evidence;
    if (!evidence.is_written()) return;
    add({Kind::evidence}, "joint evidence", evidence.span);
    const auto names = rules::relation_names(pack_);
    for (int item = 0; item < static_cast<int>(evidence.company.size()); ++item)
      add({Kind::company, -1, item}, "company " + names[at(evidence.company[at(item)])],
          evidence.span);
  }

  const Pack& pack_;
  std::vector<Variant> found_;
};

template <class T>
void erase_at(std::vector<T>& list, int i) {
  list.erase(list.begin() + i);
}

void drop_condition(Pack& pack, const DroppedPart& part) {
  auto& require = pack.rules[at(part.owner)].require;
  if (part.part < 0) return erase_at(require, part.item);
  rules::Expr rest = pack.code[at(require[at(part.item)])];
  erase_at(rest.args, part.part);
  if (rest.args.empty()) return erase_at(require, part.item);
  pack.code.push_back(std::move(rest));
  require[at(part.item)] = static_cast<ExprId>(pack.code.size()) - 1;
}

void drop(Pack& pack, const DroppedPart& part) {
  using Kind = DroppedPart::Kind;
  switch (part.kind) {
    case Kind::rule:
      // Any of no conditions: never.
      pack.code.push_back({.op = rules::Op::any_of, .type = rules::Type::yes_no});
      pack.rules[at(part.owner)].require = {static_cast<ExprId>(pack.code.size()) - 1};
      break;
    case Kind::condition:
      drop_condition(pack, part);
      break;
    case Kind::veto:
      erase_at(pack.rules[at(part.owner)].unless, part.item);
      break;
    case Kind::score_term:
      erase_at(pack.rules[at(part.owner)].score, part.item);
      break;
    case Kind::evidence:
      pack.decide.evidence = {};
      break;
    case Kind::company:
      if (pack.decide.evidence.is_written()) erase_at(pack.decide.evidence.company, part.item);
      break;
    case Kind::typical:
      erase_at(pack.classes[at(part.owner)].typical, part.item);
      break;
  }
}

}  // namespace

void rules::Ablation::put_back(const DroppedPart& part) {
  if (part.owner < 0)
    pack_.decide = base_.decide;
  else if (part.kind == DroppedPart::Kind::typical)
    pack_.classes[at(part.owner)].typical = base_.classes[at(part.owner)].typical;
  else
    pack_.rules[at(part.owner)] = base_.rules[at(part.owner)];
}

/// From the last of an owner to the first, so that those before keep their numbers.
const Pack& rules::Ablation::without(std::vector<DroppedPart> parts) {
  for (const DroppedPart& part : dropped_) put_back(part);
  pack_.code.resize(base_.code.size());
  dropped_ = std::move(parts);
  std::ranges::sort(dropped_, [](const DroppedPart& p, const DroppedPart& q) {
    return std::pair(p.item, p.part) > std::pair(q.item, q.part);
  });
  for (const DroppedPart& part : dropped_) drop(pack_, part);
  return pack_;
}

Variant variant_with(const RuleBase& base, std::vector<ParamValue> params) {
  Variant variant;
  for (const ParamValue& param : params)
    variant.name += (variant.name.empty() ? "" : ", ") + to_string(param, base);
  variant.params = std::move(params);
  return variant;
}

std::vector<Variant> ablations(const RuleBase& base) { return AblationFinder(base.pack()).run(); }

}  // namespace oriel
