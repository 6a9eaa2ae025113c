#include "interpret/explain/explain.h"

#include "interpret/explain/flip.h"
#include "interpret/explain/proof.h"
#include "interpret/labelling/labelling.h"
#include "interpret/pack/names.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace oriel {

namespace {

using rules::Evaluator;
using rules::ExprId;
using rules::Pack;
using rules::Prover;
using rules::Rule;
using rules::Truth;

std::vector<ConditionReport> prove(Prover& prover, const std::vector<ExprId>& conditions) {
  std::vector<ConditionReport> reports;
  for (const ExprId id : conditions)
    for (ConditionReport& report : prover.conditions(id)) reports.push_back(std::move(report));
  return reports;
}

/// `unless` is one condition to the rule, whatever `and` joins in it.
std::vector<ConditionReport> prove_vetoes(Prover& prover, const std::vector<ExprId>& conditions) {
  std::vector<ConditionReport> reports;
  reports.reserve(conditions.size());
  for (const ExprId id : conditions) reports.push_back(prover.condition(id));
  return reports;
}

RuleReport report_of(const Pack& pack, const Rule& rule, Evaluator& evaluator, int row,
                     Prover& prover) {
  const rules::Class& label = pack.classes[static_cast<std::size_t>(rule.label)];
  RuleReport report;
  report.id = rule.id;
  report.label = label.name;
  report.priority = rule.priority;
  report.is_predicate = label.is_abstract;
  report.place = pack.source.place(rule.span.begin);
  const auto judged = rules::judge(pack, rule, evaluator, std::span(&row, 1));
  report.outcome = judged.empty()                      ? Outcome::fails
                   : judged[0].truth == Truth::unknown ? Outcome::unknown
                                                       : Outcome::holds;
  if (report.outcome == Outcome::holds) report.score = judged[0].score;
  report.require = prove(prover, rule.require);
  report.unless = prove_vetoes(prover, rule.unless);
  for (const rules::ScoreTerm& term : rule.score) report.terms.push_back(prover.term(term));
  return report;
}

RoundReport round_report(const Pack& pack, const rules::Choice& choice) {
  if (choice.rule < 0) return {};
  const Rule& rule = pack.rules[static_cast<std::size_t>(choice.rule)];
  const rules::Class& label = pack.classes[static_cast<std::size_t>(rule.label)];
  return {label.name, choice.score, choice.margin, rule.id};
}

EvidenceReport evidence_report(const Pack& pack, const rules::PackValues& values,
                               const rules::Evidence& evidence, std::vector<std::string> holders) {
  const rules::EvidenceSettings& settings = pack.decide.evidence;
  EvidenceReport report;
  report.shift = evidence.shift;
  report.place = pack.source.place(settings.span.begin);
  const auto names = rules::relation_names(pack);
  for (const int relation : settings.company)
    report.relations.push_back(names[static_cast<std::size_t>(relation)]);
  report.company = static_cast<std::size_t>(evidence.company);
  report.holders = std::move(holders);
  std::ranges::sort(report.holders);
  report.company_shift = values.evidence * evidence.company_share();
  for (const rules::CountEvidence& count : evidence.counts) {
    const rules::Class& of = pack.classes[static_cast<std::size_t>(count.of)];
    const rules::Typical& typical = of.typical[count.typical];
    CountReport& said = report.counts.emplace_back();
    said.label = of.name;
    said.per = typical.per;
    said.others = count.others;
    const rules::CountRange range = values.count_of(pack, typical);
    said.low = range.low;
    if (range.high != rules::CountRange::kNoEnd) said.high = range.high;
    said.shift = values.evidence * count.judged;
    said.place = pack.source.place(typical.span.begin);
  }
  return report;
}

/// A decision in which the feature was weighed: what evidence says of each of its rules, and what
/// they would have decided without it.
void add_evidence(const Pack& pack, const rules::PackValues& values,
                  const rules::Labelling& labelling, const rules::Weighed& weighed,
                  const FeatureTable& table, Explanation& explanation) {
  for (const rules::Evidence& evidence : weighed.evidence) {
    std::vector<std::string> holders;
    for (const int row : labelling.holders(weighed, evidence.rule))
      holders.push_back(table.id(FeatureId{row}));
    explanation.rules[static_cast<std::size_t>(evidence.rule)].evidence =
        evidence_report(pack, values, evidence, std::move(holders));
  }
  RoundReport without = round_report(pack, weighed.without);
  if (without.label != round_report(pack, weighed.with).label)
    explanation.without_evidence = std::move(without);
}

bool is_better(const RuleReport& p, const RuleReport& q) {
  if (p.priority != q.priority) return p.priority > q.priority;
  return p.total() != q.total() ? p.total() > q.total() : p.id < q.id;
}

std::optional<std::size_t> find_best(const std::vector<RuleReport>& reports) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    if (reports[i].is_predicate || reports[i].outcome != Outcome::holds) continue;
    if (!best || is_better(reports[i], reports[*best])) best = i;
  }
  return best;
}

/// Of each label of which no rule holds the rule that misses least, the first of equals; these the
/// nearest first, of equals in the order of the pack.
std::vector<NearestMiss> find_near_misses(const Pack& pack, const Explanation& explanation,
                                          Prover& prover) {
  std::set<std::string> held{explanation.verdict.label.text()};
  for (const RuleReport& rule : explanation.rules)
    if (rule.outcome == Outcome::holds) held.insert(rule.label);
  std::map<std::string, NearestMiss> by_label;
  for (std::size_t i = 0; i < explanation.rules.size(); ++i) {
    const RuleReport& rule = explanation.rules[i];
    if (rule.is_predicate || held.contains(rule.label)) continue;
    const double gap = prover.gap(pack.rules[i]);
    const auto [nearest, is_new] = by_label.try_emplace(rule.label, NearestMiss{i, gap, {}});
    if (!is_new && gap < nearest->second.gap) nearest->second = {i, gap, {}};
  }
  std::vector<NearestMiss> misses;
  for (const auto& [label, miss] : by_label) misses.push_back(miss);
  std::ranges::sort(misses, {}, [](const NearestMiss& m) { return std::pair(m.gap, m.rule); });
  for (NearestMiss& miss : misses) miss.misses = prover.misses(pack.rules[miss.rule]);
  return misses;
}

}  // namespace

struct Explainer::State {
  State(const RuleBase& rule_base, const FeatureTable& features, const FeatureGraph& features_graph,
        const Interpretation& said)
      : base(&rule_base),
        table(&features),
        graph(&features_graph),
        interpretation(&said),
        context(base->pack(), base->values(), features, features_graph),
        labelling(base->pack(), context),
        evaluator(base->pack(), context) {
    labelling.run();
  }

  Explanation explain(Prover& prover, FeatureId feature);

  const RuleBase* base;
  const FeatureTable* table;
  const FeatureGraph* graph;
  const Interpretation* interpretation;
  rules::EvaluationContext context;
  rules::Labelling labelling;
  Evaluator evaluator;
};

Explainer::Explainer(const RuleBase& base, const FeatureTable& table, const FeatureGraph& graph,
                     const Interpretation& interpretation)
    : state_(std::make_unique<State>(base, table, graph, interpretation)) {}
Explainer::~Explainer() = default;
Explainer::Explainer(Explainer&&) noexcept = default;
Explainer& Explainer::operator=(Explainer&&) noexcept = default;

Explanation Explainer::explain(FeatureId feature) const {
  Prover prover(state_->base->pack(), *state_->table, state_->evaluator, feature.value);
  return state_->explain(prover, feature);
}

Explanation Explainer::explain_without_flip(FeatureId feature) const {
  Prover prover(state_->base->pack(), *state_->table, state_->evaluator, feature.value);
  prover.look_for_nearest(state_->context);
  Explanation explanation = state_->explain(prover, feature);
  explanation.near_misses = find_near_misses(state_->base->pack(), explanation, prover);
  if (!explanation.near_misses.empty()) explanation.nearest_miss = explanation.near_misses.front();
  explanation.relations =
      FeatureRelations(*state_->base, *state_->table, *state_->graph).of(feature);
  return explanation;
}

Explanation Explainer::explain_fully(FeatureId feature, const IsGivenUp& is_given_up) const {
  Explanation explanation = explain_without_flip(feature);
  explanation.flip = find_flip(feature, is_given_up);
  return explanation;
}

Explanation Explainer::State::explain(Prover& prover, FeatureId feature) {
  const Pack& pack = base->pack();
  Explanation explanation;
  explanation.building = table->building();
  explanation.feature = table->id(feature);
  explanation.verdict = interpretation->verdicts.at(feature.index());
  explanation.min_score = context.values.min_score;
  for (const Rule& rule : pack.rules)
    explanation.rules.push_back(report_of(pack, rule, evaluator, feature.value, prover));
  for (const auto& round : labelling.rounds())
    explanation.rounds.push_back(round_report(pack, round[feature.index()]));
  for (const rules::Weighed& weighed : labelling.weighed())
    if (weighed.row == feature.value)
      add_evidence(pack, context.values, labelling, weighed, *table, explanation);
  explanation.best = find_best(explanation.rules);
  return explanation;
}

FlipSearch Explainer::find_flip(FeatureId feature, const IsGivenUp& is_given_up) const {
  return rules::find_flip(state_->base->pack(), state_->base->values(), *state_->table,
                          *state_->graph, feature, is_given_up);
}

std::vector<std::size_t> find_rules(const RuleBase& base, std::string_view name) {
  const Pack& pack = base.pack();
  std::vector<std::size_t> of_class;
  for (std::size_t i = 0; i < pack.rules.size(); ++i) {
    const Rule& rule = pack.rules[i];
    if (rule.id == name) return {i};
    if (pack.classes[static_cast<std::size_t>(rule.label)].name == name) of_class.push_back(i);
  }
  return of_class;
}

std::string similar_rule(const RuleBase& base, std::string_view name) {
  const Pack& pack = base.pack();
  std::vector<std::string> names;
  for (const Rule& rule : pack.rules) {
    names.push_back(rule.id);
    names.push_back(pack.classes[static_cast<std::size_t>(rule.label)].name);
  }
  return did_you_mean(name, names);
}

Explanation explain(const RuleBase& base, const FeatureTable& table, const FeatureGraph& graph,
                    const Interpretation& interpretation, FeatureId feature) {
  return Explainer(base, table, graph, interpretation).explain_fully(feature);
}

}  // namespace oriel
