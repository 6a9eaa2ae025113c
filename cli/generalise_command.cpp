#include "cli/commands.h"
#include "cli/labelling.h"
#include "generalise/generalise.h"
#include "interpret/plan.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct Arguments : LabelArguments {
  std::string scale;
};

/// N of "1:N", "1 : N" or "N".
double denominator_of(const std::string& text) {
  std::string number;
  std::ranges::remove_copy(text, std::back_inserter(number), ' ');
  if (number.starts_with("1:")) number.erase(0, 2);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size() || !(value >= 1) ||
      !std::isfinite(value))
    throw CLI::ValidationError(
        "--scale", fmt::format("'{}' is no scale: write 1:N with N >= 1, such as 1:2000", text));
  return value;
}

class Generaliser {
 public:
  Generaliser(const Arguments& arguments, const RuleBase& rules, Run& run, Report& report)
      : arguments_(arguments),
        scale_(denominator_of(arguments.scale)),
        rules_(rules),
        run_(run),
        report_(report),
        outputs_(arguments, rules) {}

  ExitCode go() {
    Run::Visitor visitor;
    visitor.begin = [&](std::size_t input) {
      if (input == 0) removed_.clear();
      outputs_.begin(input, !run_.is_last_run());
    };
    visitor.record = [&](const Document& document, std::vector<OnLine>& lines) {
      redraw_record(document, lines);
    };
    visitor.end = [&](std::size_t) {
      run_.timings().measure(Stage::write, [&] { outputs_.end(); });
    };
    const ExitCode code = run_.go(visitor);
    outputs_.commit();
    run_.tell_summary(fmt::format("generalised to 1:{}", scale_), removed_, " left out");
    return code;
  }

 private:
  void redraw_record(const Document& document, std::vector<OnLine>& lines) {
    std::vector<LabelledBuilding> labelled;
    WriteOptions options;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!lines[i].is_done()) continue;
      outputs_.add_features(document.buildings[i], lines[i]);
      auto redrawn = run_.timings().measure(
          Stage::generalise, [&] { return redraw_building(document.buildings[i], lines[i]); });
      if (!redrawn) continue;
      for (const auto& [label, count] : redrawn->removed) removed_[label] += count;
      labelled.push_back(std::move(redrawn->labelled));
      options.removed.insert(options.removed.end(), redrawn->removed_ids.begin(),
                             redrawn->removed_ids.end());
    }
    run_.timings().measure(Stage::write, [&] { outputs_.add(document, labelled, options); });
  }

  std::optional<Redrawn> redraw_building(const Building& building, const OnLine& line) {
    const auto& [table, graph] = line.description;
    const Plan plan = oriel::plan(rules_, table, graph, line.interpretation, scale_);
    report_.tell(plan.issues);
    auto generalised = generalise(*line.solid, *line.segmentation, table, line.interpretation, plan,
                                  arguments_.segment_options());
    for (const Issue& issue : generalised.issues) {
      if (issue.severity == Severity::error)
        run_.set_aside(issue);
      else
        report_.tell(issue);
    }
    if (!generalised.value) return std::nullopt;
    return redraw(building, outputs_.annotated(building, line), *line.segmentation, table,
                  line.interpretation, std::move(*generalised.value),
                  arguments_.segment_options().tolerances);
  }

  const Arguments& arguments_;
  double scale_;
  const RuleBase& rules_;
  Run& run_;
  Report& report_;
  LabelOutputs outputs_;
  std::map<std::string, int> removed_;  ///< features that are gone, by label
};

ExitCode work(const Arguments& arguments) {
  Report report(arguments.is_verbose);
  const auto rules = load_rules(arguments.rules, report);
  if (!rules) return ExitCode::rules;
  Run run(arguments, &*rules, report);
  Generaliser generaliser(arguments, *rules, run, report);
  return generaliser.go();
}

}  // namespace

void add_generalise(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "generalise",
      "Redraw buildings for a target scale: a closed solid with what the scale can show");
  add_label_arguments(*command, *arguments);
  command->get_option("--output")->required();
  command->add_option("--scale", arguments->scale, "Target scale, such as 1:2000")->required();
  command->footer(
      "Example:\n  oriel generalise house.city.json --scale 1:20000 -o house-1-20000.city.json");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
