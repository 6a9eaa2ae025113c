#include "cli/commands.h"
#include "cli/labelling.h"

#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct Arguments : LabelArguments {};

/// The labelled features of a building for a reader at a terminal.
std::string listing(const Building& building, const OnLine& line) {
  const FeatureTable& of = line.description.table;
  std::vector<std::vector<std::string>> rows{
      {"feature", "label", "score", "margin", "rule", "a m", "b m", "height m"}};
  const auto number = [&](FeatureId id, const char* name) {
    const auto value = of.number(id, name);
    return value ? fmt::format("{:.2f}", *value) : std::string("-");
  };
  for (const Verdict& verdict : line.interpretation.verdicts) {
    if (verdict.label.empty()) continue;
    rows.push_back({of.id(verdict.feature), verdict.label, fmt::format("{:.2f}", verdict.score),
                    fmt::format("{:.2f}", verdict.margin), verdict.rule,
                    number(verdict.feature, "a"), number(verdict.feature, "b"),
                    number(verdict.feature, "height")});
  }
  return fmt::format("{}: {} of {} features have a label\n{}\n", building.id, rows.size() - 1,
                     line.interpretation.verdicts.size(), table(rows));
}

ExitCode work(const Arguments& arguments) {
  Report report(arguments.is_verbose);
  const auto rules = load_rules(arguments.rules, report);
  if (!rules) return ExitCode::rules;
  Run run(arguments, &*rules, report);
  LabelOutputs outputs(arguments, *rules);
  Run::Visitor visitor;
  visitor.begin = [&](std::size_t input) { outputs.begin(input, !run.is_last_run()); };
  visitor.record = [&](const Document& document, std::vector<OnLine>& lines) {
    run.timings().measure(Stage::write, [&] {
      std::vector<LabelledBuilding> labelled;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        if (outputs.has_buildings() && lines[i].has_surfaces())
          labelled.push_back(outputs.annotated(document.buildings[i], lines[i]));
        if (!lines[i].is_done()) continue;
        outputs.add_features(document.buildings[i], lines[i]);
        if (!outputs.has_any() && run.is_last_run())
          outputs.print(listing(document.buildings[i], lines[i]));
      }
      outputs.add(document, labelled, {});
    });
  };
  visitor.end = [&](std::size_t) { run.timings().measure(Stage::write, [&] { outputs.end(); }); };
  const ExitCode code = run.go(visitor);
  outputs.commit();
  run.tell_summary("labelled", run.labels());
  return code;
}

}  // namespace

void add_label(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "label", "Name the parts of buildings by rules and write the buildings with their labels");
  add_label_arguments(*command, *arguments);
  command->footer(
      "Without -o and --features the labels are listed. Polygons are written as they came, never "
      "moved.\n"
      "Example:\n  oriel label house.city.json -o labelled.city.json\n"
      "  oriel label city/*.city.json -o labelled/ --features parts.csv --rules my_rules.yaml");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
