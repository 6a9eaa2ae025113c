#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/batch/inputs/neighbours.h"
#include "cli/commands/commands.h"
#include "cli/options/feature_choice.h"
#include "cli/options/options.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/option_values.h"
#include "cli/terminal/print_out.h"
#include "cli/terminal/table.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "oriel/explain.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

struct ExplainArguments : RunOptions, RulesChoice {
  std::string feature;
  /// Of it only; empty: of the winner and what came near it.
  std::string rule;
  int surface = -1;
  std::vector<double> at;
  bool is_json = false;
  bool is_full = false;
  std::string corrections_file;
};

/// What is printed of a feature, as the options say.
class ExplanationPrinter {
 public:
  ExplanationPrinter(const ExplainArguments& arguments, const RuleBase& rules)
      : arguments_(arguments) {
    if (arguments.rule.empty()) return;
    rules_ = find_rules(rules, arguments.rule);
    if (rules_.empty())
      throw CLI::ValidationError(
          "--rule", fmt::format("the pack has no rule and no label '{}'{}", arguments.rule,
                                similar_rule(rules, arguments.rule)));
  }

  [[nodiscard]] std::string text(const Explanation& explanation) const {
    if (arguments_.is_json) return to_json(explanation) + "\n";
    if (arguments_.is_full) return to_text(explanation);
    return rules_.empty() ? summary_text(explanation) : rules_text(explanation, rules_);
  }

 private:
  const ExplainArguments& arguments_;
  std::vector<std::size_t> rules_;
};

/// There is nothing to explain: wrong usage, unless something graver has happened that explains
/// it.
ExitCode end_with_nothing(ExitCode code, const std::string& option, const std::string& why) {
  if (code == ExitCode::clean) throw CLI::ValidationError(option, why);
  if (code != ExitCode::input) run_log().write(LogLevel::error, option + ": " + why);
  return code;
}

/// What says of a feature how it is to be printed says nothing of a surface.
void check_fit_for_surface(const ExplainArguments& arguments) {
  const char* why = "a surface lies there: it is explained as text, with all that decided";
  if (arguments.is_json) throw CLI::ValidationError("--json", why);
  if (!arguments.rule.empty()) throw CLI::ValidationError("--rule", why);
}

/// What lies at a place: the feature there, or the surface where there is none.
ExitCode explain_place(const ExplainArguments& arguments, const RuleBase& rules) {
  Report report(arguments.is_verbose);
  const ExplanationPrinter printer(arguments, rules);
  BatchRunner runner(arguments, &rules, report);
  const Vec3 point{arguments.at[0], arguments.at[1], arguments.at[2]};
  std::optional<double> nearest_m;
  std::string text;
  bool is_surface = false;
  const auto look_up = [&](const Document& document, std::vector<PipelineResult>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Building& building = document.buildings[i];
      const auto found = polygon_at(building, point);
      if (!found || !lines[i].has_surfaces() || (nearest_m && *nearest_m <= found->distance_m))
        continue;
      nearest_m = found->distance_m;
      const FeatureId feature = feature_of(building, lines[i], found->polygon);
      is_surface = !feature.is_valid();
      text = is_surface ? explain_surface(building, lines[i], rules, found->polygon)
                        : printer.text(explain(lines[i], rules, feature));
    }
  };
  RecordVisitor visitor(look_up, [&] {
    nearest_m.reset();
    text.clear();
  });
  const ExitCode code = runner.run(visitor);
  if (text.empty()) return end_with_nothing(code, "--at", "no polygon lies there");
  if (is_surface) check_fit_for_surface(arguments);
  print_out(text, arguments.is_json);
  return code;
}

/// The surface of that number in every building that has one.
ExitCode explain_surfaces(const ExplainArguments& arguments, const RuleBase& rules) {
  Report report(arguments.is_verbose);
  BatchRunner runner(arguments, &rules, report);
  std::string text;
  const auto look_up = [&](const Document& document, std::vector<PipelineResult>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Building& building = document.buildings[i];
      const auto found = std::ranges::find(building.polygons, arguments.surface, &Polygon::source);
      if (!lines[i].has_surfaces() || found == building.polygons.end()) continue;
      text += explain_surface(building, lines[i], rules,
                              static_cast<std::size_t>(found - building.polygons.begin()));
    }
  };
  RecordVisitor visitor(look_up, [&] { text.clear(); });
  const ExitCode code = runner.run(visitor);
  if (text.empty())
    return end_with_nothing(code, "--surface",
                            fmt::format("there is no polygon {}", arguments.surface));
  print_out(text);
  return code;
}

/// Every number as long as the longest, so that 2 precedes 10.
std::string with_long_numbers(std::string_view text) {
  constexpr std::size_t kDigits = 10;
  std::string with, number;
  const auto end_number = [&] {
    if (!number.empty()) with.append(kDigits - std::min(kDigits, number.size()), '0');
    with += std::exchange(number, {});
  };
  for (const char c : text) {
    if (c >= '0' && c <= '9') {
      number += c;
      continue;
    }
    end_number();
    with += c;
  }
  end_number();
  return with;
}

/// Names in the order of a walk around the building: the place, the label, the number.
std::pair<std::string, std::string> by_place(const std::string& name) {
  const std::size_t end = std::min(name.find(" of "), name.size());
  return {with_long_numbers(name.substr(end)), with_long_numbers(name.substr(0, end))};
}

/// "house: 24 of 53 features have a label: 1 balcony, 1 canopy", a line for each that has one, and
/// how many have none; with --full also a line for each of these.
std::string table_of(const Building& building, const PipelineResult& line, bool has_all) {
  std::map<std::string, int> counts = count_labels(line.interpretation);
  const int unknown = std::exchange(counts[""], 0);
  counts.erase("");
  std::string labels;
  for (const auto& [label, count] : counts)
    labels += fmt::format("{}{} {}", labels.empty() ? ": " : ", ", count, label);
  const std::size_t rows = line.description.table.rows();
  const std::size_t labelled = rows - static_cast<std::size_t>(unknown);
  std::string text = fmt::format("{}: {} {} a label{}\n", printable(building.id),
                                 counted_of(labelled, rows, "feature"),
                                 agreeing_of(labelled, rows, "has", "have"), printable(labels));
  std::vector<std::vector<std::string>> cells = {{"name", "label", "score", "rule", "feature"}};
  const std::vector<std::string> names = names_of_features(line);
  std::vector<Verdict> verdicts = line.interpretation.verdicts;
  std::ranges::sort(verdicts, {},
                    [&](const Verdict& v) { return by_place(names[v.feature.index()]); });
  for (const Verdict& verdict : verdicts) {
    if (verdict.label.empty() && !has_all) continue;
    const bool has_label = !verdict.label.empty();
    cells.push_back({names[verdict.feature.index()], has_label ? verdict.label.text() : "unknown",
                     has_label ? fmt::format("{:.2f}", verdict.score) : "", verdict.rule.text(),
                     line.description.table.id(verdict.feature)});
  }
  if (cells.size() > 1) text += table(std::move(cells));
  if (unknown > 0 && !has_all)
    text += fmt::format("{} without a label: --full lists {}.\n", unknown,
                        agreeing(unknown, "it", "them"));
  return text;
}

/// Every building that was asked for, with a line for each feature.
ExitCode explain_buildings(const ExplainArguments& arguments, const RuleBase& rules) {
  if (!arguments.rule.empty()) throw CLI::ValidationError("--rule", "needs a feature");
  Report report(arguments.is_verbose);
  BatchRunner runner(arguments, &rules, report);
  std::string text;
  const auto list = [&](const Document& document, std::vector<PipelineResult>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!lines[i].is_done()) continue;
      const Building& building = document.buildings[i];
      text += arguments.is_json ? to_json(building.id, explain_features(lines[i], rules)) + "\n"
                                : table_of(building, lines[i], arguments.is_full);
    }
  };
  RecordVisitor visitor(list, [&] { text.clear(); });
  const ExitCode code = runner.run(visitor);
  print_out(text, arguments.is_json);
  return code;
}

ExitCode work(ExplainArguments& arguments) {
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  const auto rules = load_rules(arguments, report);
  if (!rules) return ExitCode::rules;
  ExitCode before = ExitCode::clean;
  arguments.corrections = load_corrections(arguments.corrections_file, *rules, report, before);
  find_neighbours(arguments, report);
  if (arguments.surface >= 0) return graver(before, explain_surfaces(arguments, *rules));
  if (!arguments.at.empty()) return graver(before, explain_place(arguments, *rules));
  if (arguments.feature.empty()) return graver(before, explain_buildings(arguments, *rules));
  const ExplanationPrinter printer(arguments, *rules);
  BatchRunner runner(arguments, &*rules, report);
  std::optional<Explanation> first;
  FeatureChoice choice(arguments.feature, "feature");
  const auto clear = [&] {
    first.reset();
    choice.clear();
  };
  const auto look_up = [&](const Document&, std::vector<PipelineResult>& lines) {
    for (const PipelineResult& line : lines) {
      if (!line.is_done()) continue;
      const auto found = choice.look(line);
      if (found && !first) first = explain(line, *rules, *found);
    }
  };
  RecordVisitor visitor(look_up, clear);
  const ExitCode code = runner.run(visitor);
  choice.check(code);
  if (first) print_out(printer.text(*first), arguments.is_json);
  return graver(before, code);
}

}  // namespace

void add_explain(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ExplainArguments>();
  CLI::App* command = app.add_subcommand(
      "explain",
      "Explain why a feature has its label: the conditions, their values and their bounds");
  add_line_arguments(*command, *arguments, false);
  auto* feature = command->add_option("feature", arguments->feature,
                                      "Id or name of a feature, or the beginning of one (default: "
                                      "list the features of the building)");
  feature->check(names_a_feature);
  auto* surface = command
                      ->add_option("--surface", arguments->surface,
                                   "Instead of a feature, explain which surface the polygon with "
                                   "this number is, and why")
                      ->check(at_least_zero())
                      ->excludes(feature);
  command
      ->add_option(
          "--at", arguments->at,
          "Instead of a feature, explain what lies at this place, in the input's coordinates")
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z")
      ->excludes(feature)
      ->excludes(surface);
  add_rules_arguments(*command, *arguments);
  add_corrections_argument(*command, arguments->corrections_file);
  add_neighbours_argument(*command, arguments->neighbours_of);
  command
      ->add_option("--id", arguments->selection.ids,
                   "Only the building with this id; the others are read and skipped")
      ->allow_extra_args(false)
      ->type_name("BUILDING");
  auto* full = command
                   ->add_flag("--full", arguments->is_full,
                              "Show all rules with all their conditions; for a building, also "
                              "the features without a label")
                   ->excludes(surface);
  command
      ->add_option("--rule", arguments->rule,
                   "Show all conditions of the rule with this id, or of all rules for this label")
      ->excludes(full)
      ->excludes(surface);
  command->add_flag("--json", arguments->is_json, "Print everything as JSON")->excludes(surface);
  command->footer(
      "Example:\n  oriel explain house.city.json           # lists the features\n  oriel explain "
      "house.city.json f3k9      # says why that one has its label\n  oriel explain "
      "house.city.json 'window 3 of facade south, storey 1'");
  arguments->joins_installations = true;
  command->callback([arguments, &action] {
    // What is said of features needs no attributes of surfaces.
    arguments->only_names_surfaces = arguments->surface < 0 && arguments->at.empty();
    action = [arguments] { return work(*arguments); };
  });
}

}  // namespace oriel::cli
