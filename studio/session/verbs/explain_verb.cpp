#include "model/description/attributes.h"
#include "oriel/explain.h"
#include "oriel/rules.h"
#include "studio/session/desk.h"
#include "studio/session/labels/pack_answer.h"
#include "studio/session/reply_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

/// Writes an explanation for the page.
class ExplanationWriter {
 public:
  ExplanationWriter(const RuleBase& rules, const LabelledFeatures& labelled,
                    const Explanation& explanation, FeatureId feature)
      : rules_(rules), labelled_(labelled), explanation_(explanation), feature_(feature) {}

  [[nodiscard]] StudioJson json() const {
    const Verdict& verdict = explanation_.verdict;
    const bool has_label = !verdict.label.empty();
    return {{"sentence",
             plain_sentence(labelled_.building->segmented, labelled_.interpretation, feature_)},
            {"name", explanation_.name},
            {"label", has_label ? StudioJson(verdict.label.text()) : StudioJson()},
            {"rule", has_label ? StudioJson(verdict.rule.text()) : StudioJson()},
            {"rule_line", rule_line()},
            {"score", rounded(verdict.score, 3)},
            {"margin", rounded(verdict.margin, 3)},
            {"why", why()},
            {"why_not", why_not()},
            {"flip", flip()},
            {"relations", relations()},
            {"attributes", attributes()},
            {"correction", StudioJson()},
            {"head", headline(explanation_)}};
  }

 private:
  /// Null where it stands in a pack that the edited one extends.
  [[nodiscard]] StudioJson line(const Place& place) const {
    return place.file == rules_.file() && place.line > 0 ? StudioJson(place.line) : StudioJson();
  }

  [[nodiscard]] StudioJson rule_line() const {
    const auto rule =
        std::ranges::find(explanation_.rules, explanation_.verdict.rule.text(), &RuleReport::id);
    return rule == explanation_.rules.end() ? StudioJson() : line(rule->place);
  }

  static StudioJson holds(Outcome outcome) {
    return outcome == Outcome::unknown ? StudioJson() : StudioJson(outcome == Outcome::holds);
  }

  void add(const ConditionReport& condition, bool is_veto, int depth, StudioJson& list) const {
    StudioJson row{{"text", is_veto ? "not: " + condition.text : condition.text},
                   {"found", condition.value},
                   {"asked", condition.bound},
                   {"holds", holds(condition.outcome)},
                   {"line", line(condition.place)},
                   {"depth", depth}};
    if (is_veto && condition.outcome != Outcome::unknown)
      row["holds"] = condition.outcome == Outcome::fails;
    if (!condition.miss.empty()) row["missed_by"] = condition.miss;
    if (!condition.missing.empty()) row["without_value"] = condition.missing;
    list.push_back(std::move(row));
    for (const ConditionReport& part : condition.parts) add(part, false, depth + 1, list);
  }

  void add(const TermReport& term, StudioJson& list) const {
    list.push_back({{"text", term.text},
                    {"found", term.value},
                    {"asked", term.bound},
                    {"holds", StudioJson()},
                    {"score", term.judged ? StudioJson(rounded(*term.judged, 3)) : StudioJson()},
                    {"weight", term.weight},
                    {"line", line(term.place)},
                    {"depth", 0}});
  }

  [[nodiscard]] StudioJson conditions(const RuleReport& rule) const {
    StudioJson list = StudioJson::array();
    for (const ConditionReport& condition : rule.require) add(condition, false, 0, list);
    for (const ConditionReport& condition : rule.unless) add(condition, true, 0, list);
    if (rule.outcome == Outcome::holds)
      for (const TermReport& term : rule.terms) add(term, list);
    for (const ExplanationRow& row : rows_of(rule))
      if (row.cells[0].starts_with("evidence "))
        list.push_back({{"text", row.cells[0]},
                        {"found", row.cells[1]},
                        {"asked", row.cells[2]},
                        {"holds", StudioJson()},
                        {"line", line(row.place)},
                        {"depth", 0}});
    return list;
  }

  /// The rule that decided first, then those that hold, too, then the others, as in the pack.
  [[nodiscard]] StudioJson why() const {
    std::vector<const RuleReport*> order;
    for (const RuleReport& rule : explanation_.rules) order.push_back(&rule);
    const auto rank = [&](const RuleReport* rule) {
      if (rule->id == explanation_.verdict.rule.text()) return 0;
      return rule->outcome == Outcome::holds && !rule->is_predicate ? 1 : 2;
    };
    std::ranges::stable_sort(order, {}, rank);
    StudioJson list = StudioJson::array();
    for (const RuleReport* rule : order)
      list.push_back({{"rule", rule->id},
                      {"label", rule->label},
                      {"holds", holds(rule->outcome)},
                      {"score", rounded(rule->total(), 3)},
                      {"line", line(rule->place)},
                      {"place", place_text(rule->place)},
                      {"conditions", conditions(*rule)}});
    return list;
  }

  /// "width is 2.7 m, must be at most 2.4 m; is no opening".
  static std::string sentence_of(const NearestMiss& near) {
    std::string sentence;
    for (const MissReport& miss : near.misses)
      sentence += (sentence.empty() ? "" : "; ") + one_line(row_of(miss));
    return sentence;
  }

  [[nodiscard]] StudioJson why_not() const {
    StudioJson list = StudioJson::array();
    for (const NearestMiss& near : explanation_.near_misses) {
      const RuleReport& rule = explanation_.rules[near.rule];
      list.push_back({{"label", rule.label},
                      {"rule", rule.id},
                      {"line", line(rule.place)},
                      {"sentence", sentence_of(near)}});
    }
    return list;
  }

  [[nodiscard]] StudioJson flip() const {
    if (!explanation_.flip || !explanation_.flip->nearest) return nullptr;
    const Flip& flip = *explanation_.flip->nearest;
    const std::string becomes = flip.label.empty() ? "without a label" : "labelled " + flip.label;
    return {{"sentence", fmt::format("with {} at {} instead of {} it would be {}", flip.param,
                                     flip.to_text, flip.from_text, becomes)},
            {"param", flip.param},
            {"value", flip.to_text},
            {"label", flip.label},
            {"line", line(flip.place)}};
  }

  static StudioJson numbers(const std::vector<FeatureId>& features) {
    StudioJson list = StudioJson::array();
    for (const FeatureId feature : features) list.push_back(feature.value);
    return list;
  }

  /// The relations that lead to others, and the groups that it is in.
  [[nodiscard]] StudioJson relations() const {
    StudioJson list = StudioJson::array();
    for (const RelatedFeatures& related : explanation_.relations)
      list.push_back({{"name", related.relation},
                      {"meaning", related.meaning},
                      {"line", line(related.place)},
                      {"features", numbers(related.others)}});
    for (const Group& group : labelled_.interpretation.groups) {
      if (std::ranges::find(group.members, feature_) == group.members.end()) continue;
      list.push_back({{"name", group.kind},
                      {"meaning", "a group of the pack"},
                      {"line", StudioJson()},
                      {"features", numbers(group.members)}});
    }
    return list;
  }

  [[nodiscard]] std::string value_of(Attribute attribute, Unit unit) const {
    const FeatureTable& table = labelled_.building->segmented.description.table;
    if (unit == Unit::text) return table.text(feature_, attribute);
    const auto number = table.number(feature_, attribute);
    if (!number) return "";
    if (unit == Unit::yes_no) return *number == 0 ? "no" : "yes";
    if (unit == Unit::count) return fmt::format("{:.0f}", *number);
    return fmt::format("{:.{}f}", *number, unit == Unit::degree ? 1 : 2);
  }

  [[nodiscard]] StudioJson attributes() const {
    StudioJson list = StudioJson::array();
    for (const Attribute attribute : kAttributes) {
      const AttributeInfo& info = info_of(attribute);
      std::string value = value_of(attribute, info.unit);
      if (value.empty()) continue;
      list.push_back({{"name", info.name},
                      {"value", std::move(value)},
                      {"unit", suffix_of(info.unit)},
                      {"meaning", info.meaning}});
    }
    return list;
  }

  const RuleBase& rules_;
  const LabelledFeatures& labelled_;
  const Explanation& explanation_;
  FeatureId feature_;
};

/// What somebody says of the feature, or null.
StudioJson correction_of(const Desk& desk, const AskedBuilding& asked, FeatureId feature) {
  std::vector<Issue> issues;
  const auto truth = desk.corrections.truth();
  const OpenBuilding& open = *asked.labelled->building;
  for (const CorrectedFeature& corrected :
       truth->corrections.find(open.building->id, open.features, issues)) {
    if (corrected.feature != feature.index()) continue;
    const Correction& said = *corrected.correction;
    return {{"building", asked.number},
            {"feature", feature.value},
            {"class", said.label.empty() ? "unknown" : said.label},
            {"by", said.by},
            {"why", said.why}};
  }
  return nullptr;
}

/// With the flip; given up where another one, or another pack, is asked for.
Explanation explain_fully(Desk& desk, const Explainer& explainer, const AskedBuilding& asked,
                          FeatureId feature) {
  const std::uint64_t packs = desk.runner.requests();
  const auto is_overtaken =
      desk.explanations.begin(fmt::format("{} {}", asked.number, feature.value));
  Explanation explanation = explainer.explain_fully(
      feature, [&] { return is_overtaken() || desk.runner.requests() != packs; });
  if (explanation.flip && explanation.flip->is_given_up)
    refuse_superseded("something newer was asked for");
  return explanation;
}

}  // namespace

StudioJson explanation_json(const RuleBase& rules, const LabelledFeatures& labelled,
                            const Explanation& explanation, FeatureId feature) {
  return ExplanationWriter(rules, labelled, explanation, feature).json();
}

StudioJson answer_explain(Desk& desk, const RequestBody& body) {
  const AskedBuilding asked = asked_building(desk, body);
  const OpenBuilding& open = *asked.labelled->building;
  const FeatureId feature = asked_feature(body, open);
  const auto& [table, graph, issues] = open.segmented.description;
  const Interpretation& interpretation = asked.labelled->interpretation;
  const Explainer explainer(asked.all->rules, table, graph, interpretation);
  // The page shows what is known at once, and asks for the flip where somebody stays.
  const bool is_quick = body.flag("quick");
  Explanation explanation = is_quick ? explainer.explain_without_flip(feature)
                                     : explain_fully(desk, explainer, asked, feature);
  explanation.name =
      feature_names(*open.segmented.segmentation, table, &interpretation).at(feature.index());
  StudioJson answer = explanation_json(asked.all->rules, *asked.labelled, explanation, feature);
  answer["correction"] = correction_of(desk, asked, feature);
  return answer;
}

}  // namespace oriel::studio
