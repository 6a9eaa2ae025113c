#include "cli/commands.h"
#include "cli/labelling.h"
#include "interpret/explain.h"
#include "interpret/surfaces.h"

#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct Arguments : LineArguments {
  std::string feature;
  std::string rules = "residential";
  int surface = -1;
  bool is_json = false;
};

/// The features whose id is `wanted` or begins with it.
std::vector<FeatureId> matches(const FeatureTable& table, const std::string& wanted) {
  if (const FeatureId exact = table.find(wanted); exact.is_valid()) return {exact};
  std::vector<FeatureId> found;
  for (int i = 0; i < static_cast<int>(table.rows()); ++i)
    if (table.id(FeatureId{i}).starts_with(wanted)) found.push_back(FeatureId{i});
  return found;
}

/// The surface of that number in every building that has one.
ExitCode explain_surfaces(const Arguments& arguments) {
  Report report(arguments.is_verbose);
  const auto rules = load_rules(arguments.rules, report);
  if (!rules) return ExitCode::rules;
  Run run(arguments, &*rules, report);
  std::string text;
  Run::Visitor visitor;
  visitor.record = [&](const Document& document, std::vector<OnLine>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Building& building = document.buildings[i];
      const auto found = std::ranges::find(building.polygons, arguments.surface, &Polygon::source);
      if (!lines[i].has_surfaces() || found == building.polygons.end()) continue;
      const SurfaceTable table =
          with_parts(lines[i].surfaces, building, lines[i].segmentation.value_or(Segmentation{}),
                     lines[i].interpretation, *rules);
      text += fmt::format("{}: polygon {} is ", building.id, arguments.surface) +
              explain_surface(*rules, table,
                              static_cast<std::size_t>(found - building.polygons.begin()));
    }
  };
  const ExitCode code = run.go(visitor);
  if (text.empty() && code != ExitCode::input)
    throw CLI::ValidationError("--surface",
                               fmt::format("there is no polygon {}", arguments.surface));
  std::fputs(text.c_str(), stdout);
  return code;
}

ExitCode work(const Arguments& arguments) {
  if (arguments.surface >= 0) return explain_surfaces(arguments);
  if (arguments.feature.empty()) throw CLI::RequiredError("feature");
  Report report(arguments.is_verbose);
  const auto rules = load_rules(arguments.rules, report);
  if (!rules) return ExitCode::rules;
  Run run(arguments, &*rules, report);
  std::vector<Explanation> explanations;
  std::vector<std::string> ids;
  Run::Visitor visitor;
  visitor.begin = [&](std::size_t) {
    explanations.clear();
    ids.clear();
  };
  visitor.record = [&](const Document&, std::vector<OnLine>& lines) {
    for (const OnLine& line : lines) {
      if (!line.is_done()) continue;
      const auto& [table, graph] = line.description;
      for (std::size_t i = 0; i < table.rows(); ++i)
        ids.push_back(table.id(FeatureId{static_cast<int>(i)}));
      for (const FeatureId id : matches(table, arguments.feature)) {
        explanations.push_back(explain(*rules, table, graph, line.interpretation, id));
      }
    }
  };
  const ExitCode code = run.go(visitor);
  const bool has_said_why = code == ExitCode::input || (code == ExitCode::set_aside && ids.empty());
  if (explanations.size() != 1 && !has_said_why) {
    std::string which = explanations.empty() ? "there are" : "it may be";
    if (ids.empty()) which += " none";
    const std::size_t shown =
        std::min<std::size_t>(8, explanations.empty() ? ids.size() : explanations.size());
    for (std::size_t i = 0; i < shown; ++i)
      which += " " + (explanations.empty() ? ids[i] : explanations[i].feature);
    if (shown < (explanations.empty() ? ids.size() : explanations.size())) which += " ...";
    throw CLI::ValidationError(
        "feature",
        fmt::format("'{}' names {} features; {}", arguments.feature, explanations.size(), which));
  }
  for (const Explanation& explanation : explanations)
    std::fputs((arguments.is_json ? to_json(explanation) + "\n" : to_text(explanation)).c_str(),
               stdout);
  return code;
}

}  // namespace

void add_explain(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "explain", "Say why a feature has its label: every condition with its value and its bound");
  add_line_arguments(*command, *arguments, false);
  auto* feature = command->add_option("feature", arguments->feature,
                                      "Id of a feature, or the beginning of one");
  command
      ->add_option("--surface", arguments->surface,
                   "Instead: the number of a polygon, to say what surface it is and why")
      ->check(CLI::NonNegativeNumber)
      ->excludes(feature);
  add_rules_argument(*command, arguments->rules);
  command->add_flag("--json", arguments->is_json, "As JSON");
  command->footer(
      "Example:\n  oriel label house.city.json            # lists the ids\n  oriel explain "
      "house.city.json f3k9");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
