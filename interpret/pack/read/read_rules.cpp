#include "interpret/evaluate/arithmetic.h"
#include "interpret/language/parser.h"
#include "interpret/pack/loader.h"
#include "interpret/pack/pack_grammar.h"
#include "interpret/yaml/section.h"

#include <set>
#include <string>
#include <utility>

namespace oriel::rules {

namespace {

/// The conditions of a list, or the one condition that stands there alone.
std::vector<ExprId> read_conditions(const YamlNode& node, Loader& loader) {
  std::vector<ExprId> conditions;
  const auto read = [&](const YamlNode& item) {
    const ExprId id = read_condition(item, loader);
    if (id != kNoExpr) conditions.push_back(id);
  };
  if (node.kind == YamlNode::Kind::sequence)
    for (const YamlNode& item : node.items) read(item);
  else
    read(node);
  return conditions;
}

void read_require(const YamlNode& node, Rule& rule, Loader& loader) {
  rule.require = read_conditions(node, loader);
  if (node.kind == YamlNode::Kind::sequence && node.items.empty())
    loader.findings.error(Code::R210, node.span, "a rule needs a condition under 'require'");
}

std::optional<Ramp> read_ramp(const YamlNode* node, Dimension dimension, Loader& loader) {
  if (node == nullptr) return std::nullopt;
  const auto range = read_range(*node, dimension, loader);
  if (!range) return std::nullopt;
  return Ramp{range->low_expr, range->high_expr};
}

double read_weight(const YamlNode* node, Loader& loader) {
  if (node == nullptr) return 1;
  const auto weight = read_number(*node, "a weight", loader.findings);
  if (weight && *weight > 0 && *weight <= 1e6) return *weight;
  if (weight)
    loader.findings.error(Code::R212, node->span, "a weight is more than 0, at most 1000000");
  return 1;
}

void check_ramps(const ScoreTerm& term, const YamlNode& node, Loader& loader) {
  if (!term.rise || !term.fall) return;
  const auto top = fold(loader.pack, term.rise->to);
  const auto drop = fold(loader.pack, term.fall->from);
  if (top && drop && *top > *drop)
    loader.findings.error(Code::R212, node.span, "the fall begins before the rise has ended");
}

/// What stands after `expression:` in a score.
void read_judgement(const YamlNode& node, ScoreTerm& term, Loader& loader) {
  YamlSection section(node, "a score term", pack_grammar().keys("judgement"), loader.findings);
  if (!section.is_map()) return;
  term.weight = read_weight(section.find("weight"), loader);
  if (term.value == kNoExpr) return;
  const Expr value = loader.pack.code[static_cast<std::size_t>(term.value)];
  const YamlNode* rise = section.find("rise");
  const YamlNode* fall = section.find("fall");
  if (value.type == Type::number) {
    if (rise == nullptr && fall == nullptr)
      loader.findings.error(Code::R210, node.span, "a number in a score needs 'rise' or 'fall'");
    term.rise = read_ramp(rise, value.dimension, loader);
    term.fall = read_ramp(fall, value.dimension, loader);
    check_ramps(term, node, loader);
  } else if (rise != nullptr || fall != nullptr) {
    loader.findings.error(Code::R232, (rise != nullptr ? rise : fall)->span,
                          "a condition is 0 or 1; 'rise' and 'fall' are for numbers");
  }
}

ExprId read_term_value(const YamlNode& node, Loader& loader) {
  const auto where = expression_span(node, loader.findings);
  const auto syntax = where ? parse_expression(*where, loader.findings) : std::nullopt;
  return syntax ? loader.checker.term(*syntax) : kNoExpr;
}

std::optional<ScoreTerm> read_term(const YamlNode& node, Loader& loader) {
  ScoreTerm term;
  if (node.kind == YamlNode::Kind::scalar) {
    term.value = read_condition(node, loader);
  } else if (node.kind == YamlNode::Kind::map && node.entries.size() == 1) {
    term.value = read_term_value(node.entries[0].key, loader);
    read_judgement(node.entries[0].value, term, loader);
  } else {
    loader.findings.error(Code::R211, node.span,
                          "a score term is a condition or 'number: {rise: lo .. hi}'");
  }
  return term.value == kNoExpr ? std::nullopt : std::optional(term);
}

void read_score(const YamlNode& node, Rule& rule, Loader& loader) {
  if (!expect_list(node, "'score'", loader.findings)) return;
  loader.checker.read_previous_round(loader.pack.rounds > 0);
  for (const YamlNode& item : node.items)
    if (auto term = read_term(item, loader)) rule.score.push_back(*term);
  loader.checker.read_previous_round(false);
}

void read_rule_id(const YamlNode& node, Rule& rule, std::set<std::string>& ids, Loader& loader) {
  const auto id = read_text(node, "a rule's id", loader.findings);
  if (!id) return;
  rule.id = *id;
  if (!is_rule_id(*id))
    loader.findings.error(Code::R216, node.span,
                          "a rule cannot be called '" + *id +
                              "': an id is names joined by points, such as door.ground");
  else if (!ids.insert(*id).second)
    loader.findings.error(Code::R240, node.span, "there is a rule '" + *id + "' already");
}

void read_rule(const YamlNode& node, std::set<std::string>& ids, Loader& loader) {
  YamlSection section(node, name_with_id(node, "rule", "a rule"), pack_grammar().keys("rule"),
                      loader.findings);
  if (!section.is_map()) return;
  Rule rule;
  rule.span = node.span;
  if (const YamlNode* id = section.require("id")) read_rule_id(*id, rule, ids, loader);
  if (const YamlNode* label = section.require("label"))
    rule.label = read_class(*label, "a label", loader);
  if (const YamlNode* priority = section.find("priority"))
    rule.priority = read_integer(*priority, "a priority", loader.findings).value_or(0);
  if (const YamlNode* require = section.require("require")) read_require(*require, rule, loader);
  if (const YamlNode* unless = section.find("unless"))
    rule.unless = read_conditions(*unless, loader);
  if (const YamlNode* score = section.find("score")) read_score(*score, rule, loader);
  if (rule.label == kNoClass) return;
  Class& label = loader.pack.classes[static_cast<std::size_t>(rule.label)];
  label.has_rules = true;
  if (label.is_abstract &&
      (section.find("score") != nullptr || section.find("priority") != nullptr))
    loader.findings.error(
        Code::R232, node.span,
        "'" + label.name + "' is abstract: it holds or not, and has neither score nor priority");
  loader.pack.rules.push_back(std::move(rule));
}

}  // namespace

void read_rules(const YamlNode& node, Loader& loader) {
  if (!expect_list(node, "'rules'", loader.findings)) return;
  std::set<std::string> ids;
  for (const YamlNode& item : node.items) read_rule(item, ids, loader);
}

}  // namespace oriel::rules
