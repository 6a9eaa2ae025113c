#include "experiments/plan/plan_grammar.h"
#include "experiments/plan/plan_reader.h"
#include "interpret/yaml/section.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

constexpr Dimension kOfLength{1, 0}, kOfAngle{0, 1}, kOfShare{};

/// A param that is set already gets the other value.
void set_param(ParamValue setting, std::vector<ParamValue>& params) {
  const auto found = std::ranges::find(params, setting.name, &ParamValue::name);
  if (found == params.end())
    params.push_back(std::move(setting));
  else
    *found = std::move(setting);
}

void read_compared(const YamlEntry& entry, PlanReader& reader) {
  ComparedPlan compared;
  compared.name = entry.key.text;
  if (compared.name.empty() || compared.name == kBaselineName)
    reader.findings.error(
        Code::R240, entry.key.span,
        fmt::format("a run needs a name of its own, and '{}' is the experiment's own rules and "
                    "options",
                    kBaselineName));
  compared.spot = reader.spot(entry.key.span);
  compared.rules = reader.plan.rules;
  if (entry.value.kind == YamlNode::Kind::scalar) {
    compared.rules = {
        entry.value.text, read_plan_pack(entry.value, reader), {}, reader.spot(entry.value.span)};
    reader.plan.compare.push_back(std::move(compared));
    return;
  }
  const YamlSection section(entry.value, fmt::format("'{}'", compared.name),
                            plan_grammar().keys("compared"), reader.findings);
  if (!section.is_map()) return;
  if (const YamlNode* pack = section.find("pack"))
    compared.rules = {pack->text, read_plan_pack(*pack, reader), {}, reader.spot(pack->span)};
  const YamlNode* params = section.find("params");
  if (params != nullptr && compared.rules.base)
    for (ParamValue& setting : read_plan_params(*params, *compared.rules.base, reader))
      set_param(std::move(setting), compared.rules.params);
  read_segmentation(entry.value, compared.options, reader);
  if (entry.value.entries.empty())
    reader.findings.error(Code::R287, entry.key.span,
                          fmt::format("'{}' is the experiment's own rules and options, which the "
                                      "others are compared with anyway",
                                      compared.name));
  reader.plan.compare.push_back(std::move(compared));
}

/// Reads what is done to the buildings.
class DisturbanceReader {
 public:
  explicit DisturbanceReader(PlanReader& reader)
      : reader_(reader), quantities_(nullptr, reader.findings) {}

  StabilityPlan read(const YamlNode& node) {
    plan_.spot = reader_.spot(node.span);
    const YamlSection section(node, "'stability'", plan_grammar().keys("stability"),
                              reader_.findings);
    if (!section.is_map()) return plan_;
    using Kind = DisturbancePlan::Kind;
    constexpr double kMostNoise_m = 1, kMostShare = 1, kMostTurn_deg = 360;
    if (const YamlNode* noise = section.find("noise"))
      read_amounts(*noise, Kind::noise, kOfLength, kMostNoise_m);
    if (const YamlNode* triangulation = section.find("triangulation"))
      if (read_flag(*triangulation, "'triangulation'", reader_.findings).value_or(false))
        plan_.disturbances.push_back({Kind::triangulation, "triangulation", "", 0, "", {}});
    if (const YamlNode* rotation = section.find("rotation"))
      read_amounts(*rotation, Kind::rotation, kOfAngle, kMostTurn_deg);
    if (const YamlNode* missing = section.find("missing_faces"))
      read_amounts(*missing, Kind::missing_faces, kOfShare, kMostShare);
    if (const YamlNode* tolerances = section.find("tolerances")) read_tolerances(*tolerances);
    if (const YamlNode* times = section.find("times"))
      plan_.times = read_count(*times, "'times'", 1, reader_.findings).value_or(1);
    if (plan_.disturbances.empty() && !reader_.findings.has_errors())
      reader_.findings.error(Code::R287, node.span, "nothing is disturbed");
    return plan_;
  }

 private:
  /// An amount, or a list of them, above 0.
  void read_amounts(const YamlNode& node, DisturbancePlan::Kind kind, Dimension dimension,
                    double most) {
    for (const YamlNode* text : texts_of(node, "'" + node.of_key + "'", reader_.findings)) {
      auto amount = quantities_.value(*text, dimension);
      if (!amount) continue;
      amount = rounded_for_name(*amount);
      if (!(*amount > 0 && *amount <= most)) {
        reader_.findings.error(Code::R212, text->span,
                               fmt::format("'{}' is above 0 and at most {}", node.of_key,
                                           value_text(most, unit_of(dimension))));
        continue;
      }
      // Shares are shown in per cent.
      const bool is_share = kind == DisturbancePlan::Kind::missing_faces;
      const std::string unit = is_share ? "%" : unit_of(dimension);
      if (is_share) amount = rounded_for_name(*amount * 100);
      add({kind,
           fmt::format("{} = {}", node.of_key, value_text(*amount, unit)),
           node.of_key,
           *amount,
           unit,
           {}},
          *text);
    }
  }

  /// `plane_offset: [5 mm, 2 cm]`: an option and the values that it takes.
  void read_tolerances(const YamlNode& node) {
    const auto& keys = plan_grammar().keys("tolerances");
    const YamlSection section(node, "'tolerances'", keys, reader_.findings);
    if (!section.is_map()) return;
    for (const YamlEntry& entry : node.entries)
      for (const YamlNode* text :
           texts_of(entry.value, "'" + entry.key.text + "'", reader_.findings))
        if (contains(keys, entry.key.text)) add_tolerance(entry.key.text, *text);
  }

  void add_tolerance(const std::string& key, const YamlNode& text) {
    DisturbancePlan disturbance;
    disturbance.kind = DisturbancePlan::Kind::options;
    SegmentationPlan& options = disturbance.options;
    read_segmentation_key(key, text, options, reader_);
    disturbance.variable = key;
    disturbance.unit = key == "coplanar" ? "deg" : key == "value_rel" ? "" : "m";
    for (const auto& value :
         {options.coplanar_deg, options.plane_offset_m, options.weld_m, options.value_rel})
      if (value) disturbance.value = rounded_for_name(*value);
    disturbance.name = fmt::format("{} = {}", key, value_text(disturbance.value, disturbance.unit));
    add(std::move(disturbance), text);
  }

  /// Runs have names of their own.
  void add(DisturbancePlan disturbance, const YamlNode& text) {
    const auto& all = plan_.disturbances;
    if (std::ranges::find(all, disturbance.name, &DisturbancePlan::name) != all.end())
      reader_.findings.error(Code::R240, text.span,
                             fmt::format("there is a run '{}' already", disturbance.name));
    plan_.disturbances.push_back(std::move(disturbance));
  }

  PlanReader& reader_;
  QuantityReader quantities_;
  StabilityPlan plan_;
};

std::vector<int> read_building_counts(const YamlNode& node, PlanReader& reader) {
  std::vector<int> counts;
  for (const YamlNode* text : texts_of(node, "'buildings'", reader.findings))
    if (const auto count =
            read_count(*text, "a number of buildings to learn from", 2, reader.findings))
      counts.push_back(*count);
  std::ranges::sort(counts);
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

}  // namespace

void read_plan_ablate(const YamlNode& node, PlanReader& reader) {
  AblatePlan ablate;
  ablate.spot = reader.spot(node.span);
  for (const YamlNode* text : texts_of(node, "'ablate'", reader.findings)) {
    const auto word =
        read_word(*text, "'ablate'", {"rules", "conditions", "evidence"}, reader.findings);
    if (word == "rules") ablate.rules = true;
    if (word == "conditions") ablate.conditions = true;
    if (word == "evidence") ablate.evidence = true;
  }
  reader.plan.ablate = ablate;
}

void read_plan_compare(const YamlNode& node, PlanReader& reader) {
  if (!expect_map(node, "'compare'", reader.findings)) return;
  if (node.entries.empty()) reader.findings.error(Code::R287, node.span, "nothing is compared");
  if (!reader.plan.rules.base) return;
  for (const YamlEntry& entry : node.entries) read_compared(entry, reader);
}

void read_plan_stability(const YamlNode& node, PlanReader& reader) {
  reader.plan.stability = DisturbanceReader(reader).read(node);
}

void read_plan_learning(const YamlNode& node, bool is_curve, PlanReader& reader) {
  LearnPlan learn;
  learn.spot = reader.spot(node.span);
  const std::string part = is_curve ? "learning_curve" : "learn";
  YamlSection section(node, "'" + part + "'", plan_grammar().keys(part), reader.findings);
  if (!section.is_map() || !reader.plan.rules.base) return;
  const RuleBase& base = *reader.plan.rules.base;
  const YamlNode* params = section.find("params");
  if (params != nullptr && !(params->kind == YamlNode::Kind::scalar && params->text == "all"))
    for (const YamlNode* name : texts_of(*params, "'params'", reader.findings))
      if (const Param* param = find_plan_param(*name, base, reader))
        learn.params.push_back(param->name);
  if (const YamlNode* objective = section.find("objective")) {
    std::vector<std::string> words = base.labels();
    words.insert(words.begin(), "macro_f1");
    learn.objective =
        read_word(*objective, "'objective'", words, reader.findings).value_or("macro_f1");
  }
  const YamlNode* buildings = is_curve ? section.require("buildings") : nullptr;
  if (buildings != nullptr) learn.buildings = read_building_counts(*buildings, reader);
  if (const YamlNode* times = section.find("times"); is_curve && times != nullptr)
    learn.times = read_count(*times, "'times'", 1, reader.findings).value_or(1);
  (is_curve ? reader.plan.learning_curve : reader.plan.learn) = std::move(learn);
}

}  // namespace oriel::rules
