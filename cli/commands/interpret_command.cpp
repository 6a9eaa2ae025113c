#include "cli/commands/commands.h"
#include "cli/commands/labelling.h"
#include "cli/commands/options.h"
#include "cli/output/stored_features.h"
#include "cli/terminal/file_watch.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/report.h"

#include <chrono>
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
  std::vector<std::string> records;
  std::string rules = "residential";
  std::string out;
  std::size_t examples = 3;
  int jobs = 1;
  bool is_watching = false;
  bool is_verbose = false;
};

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

/// Interprets again whenever the pack, or one that it extends, is saved; ends by a signal only. A
/// pack with errors changes nothing: what comes next is compared with the last labels.
[[noreturn]] void watch(const Arguments& arguments, const StoredFeatures& features,
                        Report& report) {
  FileWatch files;
  files.follow({arguments.rules});
  std::vector<Interpretation> last;
  bool is_first = true;
  while (true) {
    const auto start = std::chrono::steady_clock::now();
    if (const auto rules = load_rules(arguments.rules, report)) {
      files.follow(rules->files());
      auto run = features.interpret(*rules, arguments.jobs);
      print(is_first ? StoredFeatures::listing(run)
                     : to_text(features.compare(last, run, arguments.examples)));
      last = std::move(run);
      is_first = false;
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    run_log().info("{} buildings in {:.2f} s; waiting for {} to be saved", features.buildings(),
                   took.count(), arguments.rules);
    files.wait();
  }
}

ExitCode work(const Arguments& arguments) {
  if (arguments.is_watching && !arguments.out.empty())
    throw CLI::ValidationError("--watch", "writes no file: leave out -o");
  Report report(arguments.is_verbose);
  if (arguments.is_watching) {
    const StoredFeatures features(arguments.records, report);
    if (features.code() == ExitCode::input) return ExitCode::input;
    watch(arguments, features, report);
  }
  const auto rules = load_rules(arguments.rules, report);
  if (!rules) return ExitCode::rules;
  StoredFeatures features(arguments.records, report);
  const auto run = features.interpret(*rules, arguments.jobs);
  if (arguments.out.empty())
    print(StoredFeatures::listing(run));
  else if (features.buildings() > 0 || features.code() != ExitCode::input)
    features.write(arguments.out, run);
  return features.code();
}

}  // namespace

void add_interpret(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "interpret", "Name stored features by rules, without their buildings: to try rules out");
  command
      ->add_option("records", arguments->records,
                   "Records of features as segment or label --features writes them")
      ->required();
  add_rules_argument(*command, arguments->rules);
  add_records_output(*command, "-o,--output", arguments->out,
                     "Write the records with their new labels: .csv, .json or .jsonl");
  command->add_flag("--watch", arguments->is_watching,
                    "Do it again whenever the pack is saved, and say what changed");
  command->add_option("--examples", arguments->examples, "With --watch: so many of each change")
      ->capture_default_str();
  add_jobs_argument(*command, arguments->jobs);
  command->add_flag("-v,--verbose", arguments->is_verbose, "Show notes, too");
  command->footer(
      "Without -o it lists how many features each label and rule has.\n"
      "Example:\n  oriel segment city/*.city.json --features parts.csv\n"
      "  oriel interpret parts.csv --rules my_rules.yaml --watch");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
