#include "cli/batch/arena.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/batch/inputs/neighbours.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/output/named_files.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/print_out.h"
#include "cli/terminal/step_progress.h"
#include "cli/version/version_text.h"
#include "experiments/experiment.h"
#include "io/files/output_file.h"
#include "kernel/base/sha256.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;

struct ExperimentArguments {
  std::string file;
  std::string folder;
  std::string cache;
  std::string progress;
  std::vector<std::string> neighbours_of;
  int jobs = 1;
  bool is_resumed = false;
  bool is_forced = false;
  bool is_verbose = false;

  [[nodiscard]] std::string cache_folder() const {
    return cache.empty() ? (fs::path(folder) / "cache").string() : cache;
  }
};

/// "FILE: experiment NAME, 2 sets; sweep, compare".
std::string summary_of(const std::string& file, const ExperimentPlan& plan) {
  std::string parts;
  const auto add_if = [&](bool is_there, const char* name) {
    if (is_there) parts += (parts.empty() ? "" : ", ") + std::string(name);
  };
  add_if(plan.sweep.has_value(), "sweep");
  add_if(plan.ablate.has_value(), "ablate");
  add_if(!plan.compare.empty(), "compare");
  add_if(plan.stability.has_value(), "stability");
  add_if(plan.learning_curve.has_value(), "learning_curve");
  add_if(plan.learn.has_value(), "learn");
  return fmt::format("{}: experiment {}, {}; {}\n", printable(file), printable(plan.name),
                     counted(plan.sets.size(), "set"), parts);
}

ExitCode check(const ExperimentArguments& arguments) {
  Report report(true);
  const auto plan = load_experiment_file(arguments.file);
  report.add(plan.issues);
  if (!plan.value) return ExitCode::rules;
  const auto issues = check_experiment(*plan.value);
  report.add(issues);
  if (!has_errors(issues)) print_out(summary_of(arguments.file, *plan.value));
  return exit_code_of(issues);
}

/// What an earlier run says that it left in the folder; nothing if there was none.
std::optional<nlohmann::json> earlier_manifest(const std::string& folder) {
  std::ifstream file(fs::path(folder) / "manifest.json");
  if (!file) return std::nullopt;
  return nlohmann::json::parse(file, nullptr, false);
}

/// The member of an object, if it is a text; else an empty one.
std::string text_member(const nlohmann::json& json, const char* name) {
  const auto found = json.is_object() ? json.find(name) : json.end();
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Results of another experiment are not replaced unasked: E604.
void refuse_other_results(const ExperimentArguments& arguments, const ExperimentPlan& plan) {
  const auto manifest = earlier_manifest(arguments.folder);
  if (!manifest || arguments.is_forced) return;
  const std::string other = text_member(*manifest, "name");
  if (other == plan.name) return;
  refuse_usage("-o", Code::E604,
               fmt::format("{} has the results of another experiment{}; --force replaces them",
                           printable(arguments.folder),
                           other.empty() ? "" : ", '" + printable(other) + "'"));
}

/// Figures of an earlier run that this one does not have, as that run's manifest names them. What
/// somebody has changed since stays.
std::vector<fs::path> left_figures(const std::string& folder,
                                   const std::vector<ReportFile>& files) {
  std::vector<fs::path> left;
  const auto manifest = earlier_manifest(folder);
  if (!manifest || !manifest->is_object()) return left;
  const auto listed = manifest->find("files");
  if (listed == manifest->end() || !listed->is_array()) return left;
  for (const auto& entry : *listed) {
    const fs::path path = text_member(entry, "path");
    const bool is_figure = path.parent_path() == "figures" && path.extension() == ".svg";
    const auto is_this = [&](const ReportFile& file) { return fs::path(file.path) == path; };
    if (!is_figure || std::ranges::any_of(files, is_this)) continue;
    std::ifstream file(fs::path(folder) / path, std::ios::binary);
    Sha256 hash;
    hash.add(std::string(std::istreambuf_iterator<char>(file), {}));
    if (file && hash.digest() == text_member(entry, "sha256"))
      left.push_back(fs::path(folder) / path);
  }
  return left;
}

/// All of the files, or none of those that were not there before.
void write_files(const std::string& folder, const std::vector<ReportFile>& files) {
  std::vector<std::unique_ptr<OutputFile>> outputs;
  std::vector<fs::path> new_files;
  const std::vector<fs::path> left = left_figures(folder, files);
  for (const ReportFile& file : files) {
    const fs::path path = fs::path(folder) / file.path;
    std::error_code problem;  // opening the file says why it cannot be
    fs::create_directories(path.parent_path(), problem);
    if (!fs::exists(path, problem)) new_files.push_back(path);
    outputs.push_back(std::make_unique<OutputFile>(path.string()));
    outputs.back()->append(file.text);
  }
  try {
    for (const auto& output : outputs) output->commit();
  } catch (const OutputError&) {
    std::error_code ignored;
    for (const fs::path& path : new_files) fs::remove(path, ignored);
    throw;
  }
  std::error_code ignored;
  for (const fs::path& path : left) fs::remove(path, ignored);
}

ExitCode run(const ExperimentArguments& arguments) {
  Report report(arguments.is_verbose);
  const auto plan = load_experiment_file(arguments.file);
  report.add(plan.issues);
  if (!plan.value) return ExitCode::rules;
  NamedFiles names;
  for (const std::string& file : files_of_experiment(*plan.value))
    names.add_input("experiment", file);
  ExperimentOptions options;
  options.looks_at_neighbours = !arguments.neighbours_of.empty();
  options.neighbours_of = files_of_neighbours(arguments.neighbours_of, "");
  for (const std::string& file : options.neighbours_of) {
    refuse_folder(file);
    names.add_input("--neighbours", file);
  }
  for (const char* output :
       {"results.csv", "report.md", "report.html", "tables.tex", "manifest.json"})
    names.add_output("-o", (fs::path(arguments.folder) / output).string());
  names.check();
  refuse_other_results(arguments, *plan.value);
  options.program = program_name();
  options.cache = arguments.cache_folder();
  options.resumes = arguments.is_resumed;
  options.for_each = shares_in_arena(arguments.jobs);
  std::optional<StepProgress> progress(progress_style_of(arguments.progress));
  options.observer = [&](const ExperimentStep& step) {
    progress->show(step.what, step.done, step.all);
  };
  const auto results = run_experiment(*plan.value, options);
  progress.reset();
  report.add(results.issues);
  report.finish();
  const ExitCode code = exit_code_of(results.issues);
  if (!results.value) return code;
  const auto files = report_files(*results.value);
  write_files(arguments.folder, files);
  const std::size_t rows = results.value->rows.size();
  run_log().info("{} written to {}{}", counted(files.size(), "file"), printable(arguments.folder),
                 rows == 0 ? "" : fmt::format("; results.csv has {}", counted(rows, "row")));
  return code;
}

void add_experiment_file(CLI::App& command, ExperimentArguments& arguments) {
  command.add_option("file", arguments.file, "The experiment: a YAML file")->required();
}

void add_experiment_run(CLI::App& experiment, Action& action) {
  auto arguments = std::make_shared<ExperimentArguments>();
  CLI::App* command = experiment.add_subcommand(
      "run", "Measure what an experiment asks for, and write tables, plots and a report");
  add_experiment_file(*command, *arguments);
  command
      ->add_option("-o,--output", arguments->folder,
                   "Folder for the results; it is made if it is not there")
      ->required();
  add_jobs_argument(*command, arguments->jobs);
  command->add_flag("--resume", arguments->is_resumed,
                    "Take the measurements that an earlier run has finished, if all that they "
                    "depend on is the same");
  command->add_option("--cache", arguments->cache,
                      "Folder for features and finished measurements (default: cache in the folder "
                      "of the results)");
  command->add_flag("--force", arguments->is_forced,
                    "Replace the results of another experiment in the folder");
  add_neighbours_argument(*command, arguments->neighbours_of);
  add_step_progress_argument(*command, arguments->progress);
  command->add_flag("-v,--verbose", arguments->is_verbose, "Also show notes");
  command->footer("Example:\n  oriel experiment run sweep.yaml -o results/ -j 0");
  command->callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

void add_experiment_check(CLI::App& experiment, Action& action) {
  auto arguments = std::make_shared<ExperimentArguments>();
  CLI::App* command = experiment.add_subcommand(
      "check", "Check an experiment and its data sets, and report everything that is wrong");
  add_experiment_file(*command, *arguments);
  command->footer("Example:\n  oriel experiment check sweep.yaml");
  command->callback([arguments, &action] { action = [arguments] { return check(*arguments); }; });
}

void add_experiment_schema(CLI::App& experiment, Action& action) {
  CLI::App* command = experiment.add_subcommand(
      "schema", "Print the JSON Schema of experiments, for completion in editors");
  command->footer("Example:\n  oriel experiment schema > oriel-experiment-1.schema.json");
  command->callback([&action] {
    action = [] {
      print_out(plan_grammar().schema(), true);
      return ExitCode::clean;
    };
  });
}

}  // namespace

void add_experiment(CLI::App& app, Action& action) {
  CLI::App* experiment = app.add_subcommand(
      "experiment", "Measure rules on data sets: sweeps, ablations, comparisons, stability");
  experiment->require_subcommand(1);
  add_experiment_run(*experiment, action);
  add_experiment_check(*experiment, action);
  add_experiment_schema(*experiment, action);
}

}  // namespace oriel::cli
