#include "experiments/plan/experiment_plan.h"
#include "experiments/plan/plan_grammar.h"
#include "experiments/plan/plan_reader.h"
#include "interpret/yaml/section.h"
#include "kernel/base/sha256.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace oriel {

namespace {

using rules::Findings;
using rules::PlanReader;
using rules::YamlNode;
using rules::YamlSection;

constexpr const char* kExperimentSchema = "oriel-experiment/1";
/// What rules are measured by; `count_as_paper` asks nothing of them.
constexpr const char* kExperimentParts[] = {"sweep",     "ablate",         "compare",
                                            "stability", "learning_curve", "learn"};

void read_plan_header(YamlSection& top, PlanReader& reader) {
  Findings& findings = reader.findings;
  if (const YamlNode* schema = top.require("schema"))
    rules::read_word(*schema, "'schema'", {kExperimentSchema}, findings);
  if (const YamlNode* name = top.require("name"))
    reader.plan.name = rules::read_text(*name, "'name'", findings).value_or("");
  if (const YamlNode* about = top.find("about"))
    reader.plan.about = rules::read_text(*about, "'about'", findings).value_or("");
  if (const YamlNode* seed = top.find("seed"))
    reader.plan.seed =
        static_cast<std::uint64_t>(rules::read_count(*seed, "'seed'", 0, findings).value_or(0));
  if (const YamlNode* samples = top.find("bootstrap"))
    reader.plan.bootstrap = rules::read_count(*samples, "'bootstrap'", 1, findings).value_or(1);
}

void read_whole_plan(const YamlNode& root, PlanReader& reader) {
  YamlSection top(root, "an experiment", plan_grammar().keys(""), reader.findings);
  if (!top.is_map()) return;
  read_plan_header(top, reader);
  const YamlNode* counted = top.find("count_as_paper");
  reader.plan.count_as_paper = rules::read_plan_patterns(counted, "'count_as_paper'", reader);
  const bool asks_rules = std::ranges::any_of(
      kExperimentParts, [&](const char* part) { return top.find(part) != nullptr; });
  const bool needs_sets = asks_rules || counted == nullptr;
  const auto find = [&](const char* key) { return needs_sets ? top.require(key) : top.find(key); };
  if (const YamlNode* sets = find("sets")) rules::read_plan_sets(*sets, reader);
  // The parts speak of the pack's params.
  if (const YamlNode* own = find("rules")) rules::read_plan_rules(*own, reader);
  if (const YamlNode* options = top.find("options"))
    rules::read_plan_options(*options, reader.plan.options, reader);
  if (const YamlNode* sweep = top.find("sweep")) rules::read_plan_sweep(*sweep, reader);
  if (const YamlNode* ablate = top.find("ablate")) rules::read_plan_ablate(*ablate, reader);
  if (const YamlNode* compare = top.find("compare")) rules::read_plan_compare(*compare, reader);
  if (const YamlNode* stability = top.find("stability"))
    rules::read_plan_stability(*stability, reader);
  if (const YamlNode* curve = top.find("learning_curve"))
    rules::read_plan_learning(*curve, true, reader);
  if (const YamlNode* learn = top.find("learn")) rules::read_plan_learning(*learn, false, reader);
  if (needs_sets && !asks_rules)
    reader.findings.error(Code::R287, root.span,
                          "nothing is measured: add sweep, ablate, compare, stability, "
                          "learning_curve, learn or count_as_paper");
}

}  // namespace

Issue PlanSpot::issue(Severity severity, Code code, std::string sentence) const {
  return {severity, code, std::move(sentence), place, excerpt};
}

SegmentationPlan SegmentationPlan::with(const SegmentationPlan& other) const {
  SegmentationPlan both = *this;
  const auto take = [](auto& mine, const auto& theirs) {
    if (theirs) mine = theirs;
  };
  take(both.order, other.order);
  take(both.coplanar_deg, other.coplanar_deg);
  take(both.plane_offset_m, other.plane_offset_m);
  take(both.weld_m, other.weld_m);
  take(both.value_rel, other.value_rel);
  take(both.close, other.close);
  take(both.crossings, other.crossings);
  take(both.close_area_m2, other.close_area_m2);
  take(both.budget, other.budget);
  take(both.lod, other.lod);
  return both;
}

std::string value_text(double value, const std::string& unit) {
  return fmt::format("{}{}{}", value, unit.empty() ? "" : " ", unit);
}

double rounded_for_name(double value) {
  const std::string text = fmt::format("{:.10g}", value);
  double read = value;
  std::from_chars(text.data(), text.data() + text.size(), read);
  return read;
}

Checked<ExperimentPlan> load_experiment(std::string text, const std::string& file) {
  ExperimentPlan plan;
  plan.file = file;
  plan.sha256 = sha256(text);
  const rules::Source source(file, std::move(text));
  Findings findings(source);
  const std::size_t bad = rules::find_bad_byte(source.text());
  if (bad != std::string_view::npos) {
    findings.error(Code::R200, {bad, bad}, "this is not UTF-8 text");
  } else if (const auto root = rules::parse_yaml({0, source.text().size()}, findings)) {
    rules::check_traps(*root, findings);
    PlanReader reader(plan, findings);
    read_whole_plan(*root, reader);
  }
  Checked<ExperimentPlan> checked{std::nullopt, findings.issues()};
  if (!findings.has_errors()) checked.value = std::move(plan);
  return checked;
}

Checked<ExperimentPlan> load_experiment_file(const std::string& path) {
  if (auto text = rules::read_file(path)) return load_experiment(std::move(*text), path);
  Issue issue;
  issue.code = Code::R200;
  issue.sentence =
      "there is no experiment here that can be read; docs/experiments.md has one to start with";
  issue.place.file = path;
  return {std::nullopt, {std::move(issue)}};
}

}  // namespace oriel
