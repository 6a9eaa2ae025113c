#include "interpret/explain/explain.h"
#include "kernel/base/text/json_text.h"

#include <fmt/format.h>

namespace oriel {

namespace {

const char* name_of(Outcome outcome) {
  if (outcome == Outcome::unknown) return "unknown";
  return outcome == Outcome::holds ? "holds" : "fails";
}

std::string member(const char* name, const std::string& json) {
  return fmt::format("{}:{}", json_string(name), json);
}

/// `,"name":json`
std::string next(const char* name, const std::string& json) {
  return fmt::format(",{}", member(name, json));
}

template <class Element, class Write>
std::string list(const std::vector<Element>& elements, Write write) {
  std::string text;
  for (const Element& element : elements) {
    if (!text.empty()) text += ",";
    text += write(element);
  }
  return fmt::format("[{}]", text);
}

std::string place_json(const Place& place) {
  return fmt::format(R"({{"file":{},"line":{},"column":{}}})", json_string(place.file), place.line,
                     place.column);
}

std::string nearest_json(const std::string& feature, const std::vector<ConditionReport>& misses);

std::string condition_json(const ConditionReport& report) {
  std::string text = member("text", json_string(report.text));
  text += next("place", place_json(report.place));
  text += next("outcome", json_string(name_of(report.outcome)));
  if (!report.value.empty()) text += next("value", json_string(report.value));
  if (!report.bound.empty()) text += next("bound", json_string(report.bound));
  if (!report.miss.empty()) text += next("miss", json_string(report.miss));
  if (!report.missing.empty()) text += next("missing", list(report.missing, json_string));
  if (!report.parts.empty()) text += next("parts", list(report.parts, condition_json));
  if (!report.nearest.empty())
    text += next("nearest", nearest_json(report.nearest, report.nearest_misses));
  return fmt::format("{{{}}}", text);
}

std::string term_json(const TermReport& report) {
  std::string text = member("text", json_string(report.text));
  text += next("place", place_json(report.place));
  text += next("judged", report.judged ? json_number(*report.judged) : "null");
  text += next("weight", json_number(report.weight));
  text += next("value", json_string(report.value));
  text += next("bound", json_string(report.bound));
  if (!report.missing.empty()) text += next("missing", list(report.missing, json_string));
  if (!report.nearest.empty())
    text += next("nearest", nearest_json(report.nearest, report.nearest_misses));
  return fmt::format("{{{}}}", text);
}

std::string nearest_json(const std::string& feature, const std::vector<ConditionReport>& misses) {
  std::string text = member("feature", json_string(feature));
  text += next("misses", list(misses, condition_json));
  return fmt::format("{{{}}}", text);
}

std::string count_json(const CountReport& count) {
  std::string text = member("label", json_string(count.label));
  text += next("per", json_string(count.per));
  text += next("others", std::to_string(count.others));
  text += next("low", std::to_string(count.low));
  text += next("high", count.high ? std::to_string(*count.high) : "null");
  text += next("shift", json_number(count.shift));
  text += next("place", place_json(count.place));
  return fmt::format("{{{}}}", text);
}

std::string evidence_json(const EvidenceReport& evidence) {
  std::string company = member("relations", list(evidence.relations, json_string));
  company += next("others", std::to_string(evidence.company));
  company += next("holders", list(evidence.holders, json_string));
  company += next("shift", json_number(evidence.company_shift));
  std::string text = member("shift", json_number(evidence.shift));
  text += next("place", place_json(evidence.place));
  text += next("company", fmt::format("{{{}}}", company));
  text += next("counts", list(evidence.counts, count_json));
  return fmt::format("{{{}}}", text);
}

std::string rule_json(const RuleReport& rule) {
  std::string text = member("id", json_string(rule.id));
  text += next("label", json_string(rule.label));
  text += next("priority", std::to_string(rule.priority));
  text += next("predicate", rule.is_predicate ? "true" : "false");
  text += next("place", place_json(rule.place));
  text += next("outcome", json_string(name_of(rule.outcome)));
  text += next("score", rule.outcome == Outcome::holds ? json_number(rule.score) : "null");
  if (rule.evidence) text += next("evidence", evidence_json(*rule.evidence));
  text += next("require", list(rule.require, condition_json));
  text += next("unless", list(rule.unless, condition_json));
  text += next("terms", list(rule.terms, term_json));
  return fmt::format("{{{}}}", text);
}

std::string round_json(const RoundReport& round) {
  std::string text = member("label", json_string(round.label));
  text += next("score", json_number(round.score));
  text += next("margin", json_number(round.margin));
  text += next("rule", json_string(round.rule));
  return fmt::format("{{{}}}", text);
}

std::string rule_miss_json(const MissReport& miss) {
  std::string text = member("rule", json_string(miss.rule));
  text += next("veto", miss.is_veto ? "true" : "false");
  text += next("condition", condition_json(miss.condition));
  return fmt::format("{{{}}}", text);
}

std::string nearest_miss_json(const Explanation& explanation) {
  const NearestMiss& nearest = *explanation.nearest_miss;
  std::string text = member("rule", json_string(explanation.rules[nearest.rule].id));
  text += next("gap", json_number(nearest.gap));
  text += next("misses", list(nearest.misses, rule_miss_json));
  return fmt::format("{{{}}}", text);
}

std::string flip_json(const Flip& flip) {
  std::string text = member("param", json_string(flip.param));
  text += next("place", place_json(flip.place));
  text += next("from", json_number(flip.from));
  text += next("to", json_number(flip.to));
  text += next("from_text", json_string(flip.from_text));
  text += next("to_text", json_string(flip.to_text));
  text += next("label", json_string(flip.label));
  text += next("score", json_number(flip.score));
  text += next("rule", json_string(flip.rule));
  return fmt::format("{{{}}}", text);
}

std::string search_json(const FlipSearch& search) {
  std::string text = member("nearest", search.nearest ? flip_json(*search.nearest) : "null");
  text += next("params", std::to_string(search.params));
  text += next("without_range", list(search.without_range, json_string));
  text += next("tried", std::to_string(search.tried));
  text += next("reach", json_number(search.reach));
  return fmt::format("{{{}}}", text);
}

/// Built-in ones have no place.
std::string relation_json(const RelatedFeatures& related) {
  std::string text = member("name", json_string(related.relation));
  text += next("meaning", json_string(related.meaning));
  text += next("place", related.place.line == 0 ? "null" : place_json(related.place));
  text += next("others", list(related.ids, json_string));
  return fmt::format("{{{}}}", text);
}

std::string corrected_json(const CorrectedLabel& corrected) {
  std::string text = member("label", json_string(corrected.label));
  text += next("by", json_string(corrected.by));
  text += next("why", json_string(corrected.why));
  return fmt::format("{{{}}}", text);
}

}  // namespace

std::string to_json(const Explanation& explanation) {
  const Verdict& verdict = explanation.verdict;
  std::string text = member("building", json_string(explanation.building));
  text += next("feature", json_string(explanation.feature));
  if (!explanation.name.empty()) text += next("name", json_string(explanation.name));
  text += next("sentence", json_string(sentence(explanation)));
  text += next("label", json_string(verdict.label));
  text += next("score", json_number(verdict.score));
  text += next("margin", json_number(verdict.margin));
  text += next("rule", json_string(verdict.rule));
  text += next("runner_up", json_string(verdict.runner_up));
  text += next("min_score", json_number(explanation.min_score));
  text += next("best",
               explanation.best ? json_string(explanation.rules[*explanation.best].id) : "null");
  if (!explanation.rounds.empty()) text += next("rounds", list(explanation.rounds, round_json));
  if (explanation.without_evidence)
    text += next("without_evidence", round_json(*explanation.without_evidence));
  text += next("rules", list(explanation.rules, rule_json));
  if (explanation.nearest_miss) text += next("nearest_miss", nearest_miss_json(explanation));
  if (explanation.flip) text += next("flip", search_json(*explanation.flip));
  if (!explanation.relations.empty())
    text += next("relations", list(explanation.relations, relation_json));
  if (explanation.corrected) text += next("corrected", corrected_json(*explanation.corrected));
  return fmt::format("{{{}}}", text);
}

std::string to_json(const std::string& building, const std::vector<Explanation>& features) {
  const auto write = [](const Explanation& explanation) { return to_json(explanation); };
  return fmt::format("{{{}{}}}", member("building", json_string(building)),
                     next("features", list(features, write)));
}

}  // namespace oriel
