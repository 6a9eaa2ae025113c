#include "cli/commands/rules_commands.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/report.h"
#include "interpret/testing/rule_tests.h"
#include "kernel/io/files/output_file.h"
#include "oriel/read.h"
#include "oriel/segment.h"

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct Arguments {
  std::vector<std::string> files;
  std::string junit;
  double min_coverage = 0;
  double min_conditions = 0;
};

/// The tests stand beside the pack: `town.test.yaml` beside `town.yaml`.
std::string tests_of(const std::string& file) {
  if (file.ends_with(".test.yaml")) return file;
  const std::string extension = ".yaml";
  const std::string name =
      file.ends_with(extension) ? file.substr(0, file.size() - extension.size()) : file;
  return name + ".test.yaml";
}

/// Tests say what features measure with the tolerances as they are.
void describe(const Document& document, Checked<std::vector<DescribedBuilding>>& found) {
  PipelineOptions options;
  options.fits_noise = false;
  for (const Building& building : document.buildings) {
    PipelineResult line = segment(building, options);
    found.issues.insert(found.issues.end(), line.issues.begin(), line.issues.end());
    if (line.is_done())
      found.value->push_back(
          {std::move(line.description.table), std::move(line.description.graph)});
  }
}

Checked<std::vector<DescribedBuilding>> read_buildings(const std::string& path) {
  Checked<std::vector<DescribedBuilding>> found;
  found.value.emplace();
  try {
    Reader reader(path, {});
    while (const auto record = reader.next()) {
      found.issues.insert(found.issues.end(), record->issues.begin(), record->issues.end());
      if (record->value)
        describe(*record->value, found);
      else if (reader.format() != Format::cityjson_seq)
        break;
    }
  } catch (const InputError& error) {
    found.issues.push_back(error.issue());
  }
  return found;
}

bool is_covered(const RuleTestReport& report, const Arguments& arguments) {
  return report.rule_coverage() * 100 >= arguments.min_coverage &&
         report.condition_coverage() * 100 >= arguments.min_conditions;
}

ExitCode work(const Arguments& arguments) {
  Report report(true);
  ExitCode code = ExitCode::clean;
  std::vector<RuleTestReport> reports;
  for (const std::string& file : arguments.files) {
    auto tested = run_rule_tests(tests_of(file), read_buildings);
    report.add(tested.issues);
    if (!tested.value) {
      code = ExitCode::rules;
      continue;
    }
    std::fputs(to_text(*tested.value).c_str(), stdout);
    if (!is_covered(*tested.value, arguments)) {
      code = ExitCode::rules;
      run_log().write(LogLevel::error, file + ": less is covered than was asked for");
    }
    if (tested.value->failed() > 0) code = ExitCode::rules;
    reports.push_back(std::move(*tested.value));
  }
  if (!arguments.junit.empty()) write_file(arguments.junit, to_junit(reports));
  return code;
}

}  // namespace

void add_rules_test(CLI::App& rules, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* test = rules.add_subcommand("test", "Run the tests of rule packs");
  test->add_option("file", arguments->files,
                   "Packs, with their tests in NAME.test.yaml next to NAME.yaml, or those tests")
      ->required();
  test->add_option("--junit", arguments->junit, "Write the results to this file, as JUnit XML");
  test->add_option("--min-coverage", arguments->min_coverage,
                   "Fail if less than this share of the rules ever holds, in percent")
      ->check(CLI::Range(0.0, 100.0));
  test->add_option("--min-conditions", arguments->min_conditions,
                   "... or less of their conditions both holds and fails, in percent")
      ->check(CLI::Range(0.0, 100.0));
  test->footer("Example:\n  oriel rules test my_rules.yaml --min-coverage 100");
  test->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
