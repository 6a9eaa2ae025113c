#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/output/named_files.h"
#include "cli/output/safe_cells.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/option_values.h"
#include "cli/terminal/print_out.h"
#include "io/files/output_file.h"
#include "io/records/feature_records.h"
#include "kernel/base/text/counted.h"
#include "oriel/corrections.h"
#include "oriel/score.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

std::string cell_of(double ratio) { return std::isnan(ratio) ? "" : fmt::format("{}", ratio); }

void append_row(std::string& out, std::string first, std::string second, const ClassScore& counts) {
  append_csv_line(out,
                  {std::move(first), std::move(second), std::to_string(counts.true_positives),
                   std::to_string(counts.false_positives), std::to_string(counts.false_negatives),
                   cell_of(counts.precision()), cell_of(counts.recall()), cell_of(counts.f1())});
}

/// A line for each building and class, then one for all its classes together ("all"), as CSV:
/// building, class, tp, fp, fn, precision, recall, f1. Ratios without a denominator are empty.
std::string per_building_csv(const std::map<std::string, Score>& buildings) {
  std::string text = "building,class,tp,fp,fn,precision,recall,f1\n";
  for (const auto& [building, score] : buildings) {
    ClassScore all;
    for (const auto& [label, counts] : score.classes) {
      append_row(text, building, label, counts);
      all += counts;
    }
    append_row(text, building, "all", all);
  }
  return text;
}

/// A line for each point: class, threshold, tp, fp, fn, precision, recall, f1; class by class, the
/// highest threshold first.
std::string curve_csv(const std::vector<CurvePoint>& curve) {
  std::vector<const CurvePoint*> points;
  points.reserve(curve.size());
  for (const CurvePoint& point : curve) points.push_back(&point);
  std::ranges::stable_sort(points, {}, [](const CurvePoint* point) { return point->label; });
  std::string text = "class,threshold,tp,fp,fn,precision,recall,f1\n";
  for (const CurvePoint* point : points)
    append_row(text, point->label, fmt::format("{}", point->threshold), point->counts);
  return text;
}

/// A line for each match, in their order (docs/formats.md): building, feature, name, label, score,
/// rule, truth, class, iou, outcome. What is not there is empty.
std::string joined_csv(const std::vector<ObjectMatch>& matches) {
  std::string text = "building,feature,name,label,score,rule,truth,class,iou,outcome\n";
  const Prediction no_prediction;
  const ExpectedObject no_object;
  for (const ObjectMatch& match : matches) {
    const Prediction& found = match.prediction ? *match.prediction : no_prediction;
    const ExpectedObject& object = match.truth ? *match.truth : no_object;
    append_csv_line(
        text, {match.truth ? object.building : found.building, found.id, found.name, found.label,
               found.label.empty() ? "" : fmt::format("{}", found.score), found.rule, object.id,
               object.label, match.iou > 0 ? fmt::format("{}", match.iou) : "",
               to_string(match.outcome)});
  }
  return text;
}

struct ScoreArguments : RunOptions, RulesChoice {
  bool is_of_surfaces = false;
  std::vector<std::string> truth;
  std::vector<std::string> models;
  double min_iou = ScoreOptions{}.min_iou;
  std::string per_building;
  std::string curve;
  std::string joined;
  std::string corrections_file;
  std::size_t samples = 0;
  bool is_paired = false;
  bool is_by_rule = false;
  bool has_safe_cells = false;
  bool is_json = false;
};

void read_records(const std::string& path, LabelsAndTruth& all, Report& report, ExitCode& code) {
  auto records = read_feature_records(path);
  report.add(records.issues);
  if (has_errors(records.issues))
    code = graver(code, records.value ? ExitCode::set_aside : ExitCode::input);
  if (records.value) add(std::move(*records.value), all);
}

void read_truth_files(const ScoreArguments& arguments, LabelsAndTruth& all, Report& report,
                      ExitCode& code) {
  for (const std::string& path : arguments.truth) {
    const auto truths = read_truths(path);
    report.add(truths.issues);
    if (has_errors(truths.issues)) code = graver(code, ExitCode::input);
    if (truths.value)
      for (const GroundTruth& truth : *truths.value) add(truth, all);
  }
}

/// Corrections are the truth of their features where there is no other.
void add_corrections(const ScoreArguments& arguments, const ScoreOptions& options,
                     LabelsAndTruth& all, Report& report, ExitCode& code) {
  if (arguments.corrections_file.empty()) return;
  const auto read = read_corrections(arguments.corrections_file);
  std::vector<Issue> issues = read.issues;
  oriel::add_corrections(Corrections(*read.value), all, issues, options);
  report.add(issues);
  if (!issues.empty()) code = graver(code, ExitCode::set_aside);
}

/// Areas come from the models that were labelled: neither records nor truth know them.
AreaScore compare_models(const ScoreArguments& arguments, const LabelsAndTruth& all, Report& report,
                         ExitCode& code) {
  RunOptions models = arguments;
  models.inputs = arguments.models;
  settle_inputs(models, report);
  models.ends_at_reading = true;
  models.joins_installations = true;
  BatchRunner runner(models, nullptr, report);
  AreaScore score;
  std::set<std::string> compared;
  RecordVisitor visitor([&](const Document& document, std::vector<PipelineResult>&) {
    for (const Building& building : document.buildings)
      if (!compared.contains(building.id) && compare_areas(building, all, {}, score))
        compared.insert(building.id);
  });
  code = graver(code, runner.run(visitor));
  if (compared.empty()) {
    report.add(nothing_compared("no building of the models is in the truth: no area is compared"));
    code = graver(code, ExitCode::set_aside);
  }
  for (const auto& [building, faces] : all.faces)
    if (!faces.truth.empty() && !compared.contains(building))
      report.add(building_issue(Severity::warning, Code::E129, building,
                                "is in none of the models: its areas are not compared"));
  return score;
}

std::string cells_of(const std::string& csv, const ScoreArguments& arguments) {
  return arguments.has_safe_cells ? with_safe_cells(csv) : csv;
}

/// The first ones, and "..." if there are more.
std::string listed(const std::vector<std::string>& buildings) {
  constexpr std::size_t kShown = 5;
  const std::size_t shown = std::min(kShown, buildings.size());
  const auto end = buildings.begin() + static_cast<std::ptrdiff_t>(shown);
  return fmt::format("{}{}", fmt::join(buildings.begin(), end, ", "),
                     shown < buildings.size() ? ", ..." : "");
}

std::set<std::string> recorded_buildings(const LabelsAndTruth& all) {
  std::set<std::string> buildings;
  for (const Prediction& prediction : all.predictions) buildings.insert(prediction.building);
  return buildings;
}

/// A warning E131: no building of the truth has records, or some have none.
std::optional<Issue> missing_records(const LabelsAndTruth& all, const ScoreOptions& options) {
  const std::set<std::string> recorded = recorded_buildings(all);
  std::set<std::string> expected;
  for (const ExpectedObject& object : all.truth)
    if (!is_left_out(object) &&
        std::ranges::find(options.not_scored, object.label) == options.not_scored.end())
      expected.insert(object.building);
  std::vector<std::string> missing;
  std::ranges::set_difference(expected, recorded, std::back_inserter(missing));
  if (missing.empty() && !expected.empty()) return std::nullopt;
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E131;
  if (expected.empty()) {
    issue.sentence = "the truth has no objects: nothing is compared";
    return issue;
  }
  issue.sentence =
      missing.size() == expected.size()
          ? "no building of the truth has a record"
          : fmt::format("{} of the truth {} no record, and all {} objects count as missed",
                        counted_of(missing.size(), expected.size(), "building"),
                        agreeing_of(missing.size(), expected.size(), "has", "have"),
                        agreeing_of(missing.size(), expected.size(), "its", "their"));
  issue.sentence += ": " + listed(missing);
  if (missing.size() == expected.size())
    issue.sentence += recorded.empty() ? "; there are no records"
                                       : fmt::format("; the records are of {}{}", *recorded.begin(),
                                                     recorded.size() > 1 ? ", ..." : "");
  return issue;
}

ExitCode score_features(const ScoreArguments& arguments) {
  Report report(arguments.is_verbose);
  std::optional<RuleBase> pack;
  if (arguments.is_by_rule && !(pack = load_rules(arguments, report))) return ExitCode::rules;
  ExitCode code = ExitCode::clean;
  LabelsAndTruth all;
  for (const std::string& path : arguments.inputs) read_records(path, all, report, code);
  read_truth_files(arguments, all, report, code);
  ScoreOptions options;
  options.min_iou = arguments.min_iou;
  add_corrections(arguments, options, all, report, code);
  if (const auto issue = missing_records(all, options)) {
    report.add(*issue);
    code = graver(code, ExitCode::set_aside);
  }
  const auto buildings = score_by_building(all, options);
  const Score result = total(buildings);
  constexpr std::size_t kShown = 20;
  const std::size_t shown = arguments.is_verbose ? result.misses.size() : kShown;
  std::string text = to_text(result, shown);
  if (shown < result.misses.size()) text += "  (-v lists all of them, --json too)\n";
  std::vector<std::string> members;
  if (!arguments.models.empty()) {
    const AreaScore areas = compare_models(arguments, all, report, code);
    text += to_text(areas);
    members.push_back(area_json(areas));
  }
  if (arguments.is_by_rule) {
    auto rules = score_by_rule(all.predictions, result);
    add_rules_without_decision(*pack, rules);
    text += to_text(rules, arguments.is_verbose ? result.misses.size() : kShown);
    members.push_back(rules_json(rules));
  }
  if (arguments.samples > 0) {
    const Intervals intervals = bootstrap(buildings, arguments.samples);
    text += to_text(intervals);
    members.push_back(intervals_json(intervals));
  }
  if (arguments.is_json) text = to_json(result, members) + "\n";
  if (!arguments.per_building.empty())
    write_file(arguments.per_building, cells_of(per_building_csv(buildings), arguments));
  if (!arguments.curve.empty())
    write_file(arguments.curve,
               cells_of(curve_csv(precision_recall_curve(all, options)), arguments));
  if (!arguments.joined.empty())
    write_file(arguments.joined, cells_of(joined_csv(match_features(all, options)), arguments));
  print_out(text, arguments.is_json);
  return code;
}

/// A warning E150: `file` has no record of buildings that the other run has.
Issue lacks_buildings(const std::string& file, const std::vector<std::string>& missing,
                      const std::string& other) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E150;
  issue.place.file = file;
  issue.sentence = fmt::format("has no record of {} that {} has; {} not compared: {}",
                               counted(missing.size(), "building"), other,
                               agreeing(missing.size(), "it is", "they are"), listed(missing));
  return issue;
}

/// Drops the buildings of which only one run has records.
void keep_common_buildings(const ScoreArguments& arguments, LabelsAndTruth& first,
                           LabelsAndTruth& second, Report& report, ExitCode& code) {
  const std::set<std::string> of_first = recorded_buildings(first);
  const std::set<std::string> of_second = recorded_buildings(second);
  const auto report_missing = [&](const auto& some, const auto& others, std::size_t lacking) {
    std::vector<std::string> missing;
    std::ranges::set_difference(some, others, std::back_inserter(missing));
    if (missing.empty()) return;
    report.add(lacks_buildings(arguments.inputs[lacking], missing, arguments.inputs[1 - lacking]));
    code = graver(code, ExitCode::set_aside);
  };
  report_missing(of_first, of_second, 1);
  report_missing(of_second, of_first, 0);
  const auto is_of_one = [&](const auto& item) {
    return of_first.contains(item.building) != of_second.contains(item.building);
  };
  for (LabelsAndTruth* run : {&first, &second}) {
    std::erase_if(run->predictions, is_of_one);
    std::erase_if(run->truth, is_of_one);
  }
  if (!of_first.empty() && !of_second.empty() && first.predictions.empty()) {
    Issue issue;
    issue.code = Code::E150;
    issue.place.file = arguments.inputs[1];
    issue.sentence =
        fmt::format("has no building of {}: there is nothing to compare", arguments.inputs[0]);
    throw InputError(std::move(issue));
  }
}

/// Two runs on the same buildings.
ExitCode score_paired(const ScoreArguments& arguments) {
  constexpr std::size_t kUsualSamples = 1000;
  Report report(arguments.is_verbose);
  ExitCode code = ExitCode::clean;
  LabelsAndTruth first, second;
  read_records(arguments.inputs[0], first, report, code);
  read_records(arguments.inputs[1], second, report, code);
  read_truth_files(arguments, first, report, code);
  ScoreOptions options;
  options.min_iou = arguments.min_iou;
  add_corrections(arguments, options, first, report, code);
  second.truth = first.truth;
  keep_common_buildings(arguments, first, second, report, code);
  if (const auto issue = missing_records(first, options)) {
    report.add(*issue);
    code = graver(code, ExitCode::set_aside);
  }
  const auto [before, after] = paired_outcomes(score_by_building(first, options),
                                               score_by_building(second, options), options);
  const std::size_t samples = arguments.samples > 0 ? arguments.samples : kUsualSamples;
  const PairedComparison comparison = PairedComparer(before, samples).compare(after);
  print_out(arguments.is_json ? to_json(comparison) + "\n" : to_text(comparison),
            arguments.is_json);
  return code;
}

/// The models are labelled as if they had no semantics, and their semantics are the truth.
ExitCode score_surfaces(const ScoreArguments& arguments) {
  Report report(arguments.is_verbose);
  const auto rules = load_rules(arguments, report);
  if (!rules) return ExitCode::rules;
  BatchRunner runner(arguments, &*rules, report);
  SurfaceScore score;
  RecordVisitor visitor([&](const Document& document, std::vector<PipelineResult>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].has_surfaces())
        compare_surfaces(document.buildings[i], lines[i], *rules, arguments.label_options(),
                         OpeningPolicy::as_host, score);
  });
  ExitCode code = runner.run(visitor);
  if (const auto issue = no_names(score, runner.state().buildings)) {
    report.add(*issue);
    code = graver(code, ExitCode::set_aside);
  }
  print_out(arguments.is_json ? to_json(score) + "\n" : to_text(score), arguments.is_json);
  return code;
}

void add_comparison_arguments(CLI::App& command, ScoreArguments& arguments) {
  command
      .add_option("--iou", arguments.min_iou,
                  "Least intersection over union for boxes to match (0 to 1)")
      ->check([](const std::string& text) {
        double share = 0;
        const bool is_number = CLI::detail::lexical_cast(text, share);
        return is_number && share > 0 && share <= 1 ? std::string()
                                                    : "'" + text + "' is not above 0 and at most 1";
      })
      ->capture_default_str();
  command.add_option("--models", arguments.models,
                     "The models that were labelled: compare also by the area of polygons");
  command.add_flag("--by-rule", arguments.is_by_rule,
                   "Also score each rule: what it decided, how much of that is right, its "
                   "mistakes, and which labels competed");
  command.add_option("--per-building", arguments.per_building,
                     "Write what was found in each building, as CSV");
  command.add_option("--curve", arguments.curve,
                     "Write precision and recall as a function of the rules' score, as CSV");
  auto* join = command.add_option("--join", arguments.joined,
                                  "Write every labelled feature and every true object with what it "
                                  "is compared with, as CSV");
  auto* paired = command.add_flag("--paired", arguments.is_paired,
                                  "Compare two runs on the same buildings: differences of F1 with "
                                  "95 % intervals, and McNemar's exact test");
  join->excludes(command.get_option("--surfaces"));
  for (const char* other :
       {"--surfaces", "--models", "--by-rule", "--per-building", "--curve", "--join"})
    paired->excludes(command.get_option(other));
  add_safe_cells_argument(command, arguments.has_safe_cells);
  command
      .add_option("--bootstrap", arguments.samples,
                  "Also print 95 % intervals of F1, from this many samples of the buildings")
      ->check(count_in(1, 1'000'000));
}

void check_names(const ScoreArguments& arguments) {
  NamedFiles files;
  files.add(arguments);
  files.add_input("--rules", arguments.rules);
  for (const std::string& model : arguments.models) files.add_input("--models", model);
  for (const std::string& truth : arguments.truth) files.add_input("--truth", truth);
  files.add_output("--per-building", arguments.per_building);
  files.add_output("--curve", arguments.curve);
  files.add_output("--join", arguments.joined);
  if (!arguments.corrections_file.empty())
    files.add_input("--corrections", arguments.corrections_file);
  files.check();
}

/// --paired compares two files and nothing else.
void check_paired(const ScoreArguments& arguments) {
  if (!arguments.is_paired) return;
  if (arguments.inputs.size() != 2)
    throw CLI::ValidationError("--paired", fmt::format("compares two files of records, the first "
                                                       "and the second run; {} given",
                                                       counted(arguments.inputs.size(), "file")));
}

ExitCode work(ScoreArguments& arguments) {
  check_paired(arguments);
  {
    Report report(arguments.is_verbose);
    // A run may be compared with itself.
    if (arguments.is_of_surfaces)
      settle_inputs(arguments, report);
    else if (!arguments.is_paired)
      read_once(arguments.inputs, report);
    arguments.truth = truth_files(arguments.truth);
    read_once(arguments.truth, report);
  }
  check_names(arguments);
  if (arguments.is_of_surfaces) return score_surfaces(arguments);
  if (arguments.truth.empty() && arguments.corrections_file.empty())
    throw CLI::RequiredError("--truth");
  return arguments.is_paired ? score_paired(arguments) : score_features(arguments);
}

}  // namespace

void add_score(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ScoreArguments>();
  CLI::App* command = app.add_subcommand(
      "score", "Compare labels with the truth: precision, recall and F1 of every class");
  arguments->ignores_semantics = true;
  command
      ->add_option("records", arguments->inputs,
                   "Records of features, as label --features writes them; with --surfaces, models")
      ->required();
  command->add_option("--truth", arguments->truth,
                      "*.truth.json and *.truth.jsonl files, or folders of them");
  command->add_flag("--surfaces", arguments->is_of_surfaces,
                    "Classify the surfaces of models as if they had no semantics, and compare with "
                    "those they have");
  command->add_option("--lod", arguments->lod, "With --surfaces: level of detail to read");
  command->add_option("--budget", arguments->budget,
                      "With --surfaces: most steps that each stage may take on one building");
  add_rules_arguments(*command, *arguments);
  add_corrections_argument(*command, arguments->corrections_file);
  add_comparison_arguments(*command, *arguments);
  command->add_flag("--json", arguments->is_json, "Print JSON, with all misses");
  command->add_flag("-v,--verbose", arguments->is_verbose,
                    "List all misses, not only the first 20");
  command->footer(
      "Example:\n  oriel label data/*.stripped.city.json --features parts.jsonl\n  oriel score "
      "parts.jsonl --truth data/ --bootstrap 1000 --models data/*.stripped.city.json\n  oriel "
      "score --surfaces data/*.labelled.city.json");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
