#include "cli/batch/run_options.h"
#include "cli/commands/commands.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/print_out.h"
#include "kernel/base/text/counted.h"
#include "oriel/interpret.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct DiffArguments {
  std::string before;
  std::string after;
  std::size_t examples = 3;
  std::optional<std::size_t> most;
  bool is_json = false;
};

/// What a run said, of as many features as can be read; the exit code says if that is not all.
std::vector<NamedFeature> read_run(const std::string& path, Report& report, ExitCode& code) {
  std::vector<NamedFeature> features;
  const auto issues = visit_feature_records(path, [&](FeatureRecord record) {
    features.push_back({std::move(record.building),
                        std::move(record.id),
                        {std::move(record.label), std::move(record.rule)}});
  });
  report.add(issues);
  if (has_errors(issues))
    code = graver(code, features.empty() ? ExitCode::input : ExitCode::set_aside);
  return features;
}

ExitCode work(const DiffArguments& arguments) {
  Report report(true);
  ExitCode code = ExitCode::clean;
  auto before = read_run(arguments.before, report, code);
  auto after = read_run(arguments.after, report, code);
  if (code == ExitCode::input) return code;
  if (before.empty() && after.empty()) {
    report.add(nothing_to_work_on({arguments.before, arguments.after}, "no feature"));
    code = graver(code, ExitCode::set_aside);
  }
  const LabelDiff diff = diff_labels(std::move(before), std::move(after), arguments.examples);
  const std::string text = arguments.is_json ? to_json(diff) + "\n" : to_text(diff);
  print_out(text, arguments.is_json);
  if (!arguments.most || diff.differences() <= *arguments.most) return code;
  run_log().write(LogLevel::error,
                  fmt::format("{}; {} {} allowed", counted(diff.differences(), "difference"),
                              *arguments.most, agreeing(*arguments.most, "is", "are")));
  return graver(code, ExitCode::set_aside);
}

}  // namespace

void add_diff(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<DiffArguments>();
  CLI::App* command = app.add_subcommand(
      "diff", "Compare the labels of two runs: what changed, by which rules, with examples");
  command->add_option("before", arguments->before, "Records of features: .csv, .json or .jsonl")
      ->required();
  command->add_option("after", arguments->after, "Records of the other run")->required();
  command->add_option("--examples", arguments->examples, "How many features of each change to list")
      ->capture_default_str();
  command->add_option(
      "--fail-over", arguments->most,
      "Exit with 3 if more features than this have another label or are in only one of the runs");
  command->add_flag("--json", arguments->is_json, "Print one JSON object");
  command->footer(
      "Example:\n  oriel interpret parts.csv --rules mine.yaml -o after.csv\n"
      "  oriel diff parts.csv after.csv --fail-over 0");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
