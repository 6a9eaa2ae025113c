#include "cli/batch/arena.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/output/named_files.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/option_values.h"
#include "cli/terminal/print_out.h"
#include "oriel/rules.h"
#include "studio/server/browser.h"
#include "studio/server/page_files.h"
#include "studio/server/serve.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct StudioArguments : RunOptions {
  std::string rules = "residential";
  std::vector<std::string> truth;
  std::string corrections = "corrections.jsonl";
  int port = 0;
  bool has_no_browser = false;
  /// Where the page may put sample houses, where there are no others.
  std::string samples_folder;
};

namespace fs = std::filesystem;

/// Where the page may save: beside the inputs, beside the pack, and where the command was called.
std::vector<std::string> folders_of(const StudioArguments& arguments) {
  std::vector<std::string> files = arguments.inputs;
  if (!embedded_pack(arguments.rules)) files.push_back(arguments.rules);
  std::vector<std::string> folders{fs::current_path().string()};
  for (const std::string& file : files)
    folders.push_back(fs::weakly_canonical(fs::absolute(file)).parent_path().string());
  std::ranges::sort(folders);
  const auto again = std::ranges::unique(folders);
  folders.erase(again.begin(), again.end());
  return folders;
}

[[noreturn]] void refuse_input(Code code, const std::string& file, std::string sentence) {
  Issue issue;
  issue.code = code;
  issue.sentence = std::move(sentence);
  issue.place.file = file;
  throw InputError(std::move(issue));
}

studio::SessionOptions session_options(const StudioArguments& arguments) {
  studio::SessionOptions options;
  options.files = arguments.inputs;
  options.read = arguments.read_options();
  options.label = arguments.label_options();
  options.rules = arguments.rules;
  options.truth = arguments.truth;
  options.corrections = arguments.corrections;
  options.folders = folders_of(arguments);
  for (const char* name :
       {"house.stripped.city.json", "house.truth.json", "hip.stripped.city.json", "hip.truth.json",
        "l-house.stripped.city.json", "l-house.truth.json", "experiment.yaml"})
    options.samples.emplace_back(name, studio::page_file(name));
  if (!arguments.samples_folder.empty()) options.samples_folder = arguments.samples_folder;
  options.jobs = arguments.jobs;
  options.for_each = shares_in_arena(arguments.jobs);
  return options;
}

/// A file that cannot be read is said at once, before there is a page that says so.
void check_readable(const std::string& path) {
  errno = 0;
  if (std::ifstream(path).is_open()) return;
  refuse_input(Code::E101, path,
               fmt::format("cannot be read: {}", std::generic_category().message(errno)));
}

/// A pack that does not exist yet is a file with the name of one; else a pack that is built in was
/// meant.
bool may_be_pack(const std::string& rules) {
  std::error_code problem;
  const std::string ending = fs::path(rules).extension().string();
  return embedded_pack(rules) || fs::exists(rules, problem) || ending == ".yaml" ||
         ending == ".yml";
}

/// Without any file the page offers samples, in the folder that was given.
void offer_samples(StudioArguments& arguments) {
  std::error_code problem;
  const auto is_folder = [&](const auto& input) { return fs::is_directory(input, problem); };
  if (!std::ranges::all_of(arguments.inputs, is_folder)) return;
  arguments.samples_folder =
      (fs::path(arguments.inputs.front()) / "oriel-samples").lexically_normal();
  run_log().info("{} has no buildings; the page offers sample houses", arguments.inputs.front());
  arguments.inputs.clear();
}

void check_inputs(const StudioArguments& arguments) {
  for (const std::string& input : arguments.inputs) {
    if (input == "-")
      throw CLI::ValidationError("input", "a studio reads files, not stdin: save it to a file");
    refuse_folder(input);
    check_readable(input);
  }
  NamedFiles names;
  names.add(arguments);
  names.add_input("--rules", arguments.rules);
  for (const std::string& truth : arguments.truth) names.add_input("--truth", truth);
  names.add_output("--corrections", arguments.corrections);
  names.check();
}

/// Before the worker is forked, which would write what is still in a buffer once more.
void say_address(const StudioArguments& arguments, const std::string& address) {
  print_out(address + "\n");
  std::fflush(stdout);
  if (!arguments.has_no_browser) studio::open_browser(address);
  run_log().info("the studio is open; Ctrl-C ends it");
}

ExitCode work(StudioArguments& arguments) {
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  offer_samples(arguments);
  arguments.truth = truth_files(arguments.truth);
  check_inputs(arguments);
  if (!may_be_pack(arguments.rules) && !load_pack(arguments.rules, report)) return ExitCode::rules;
  studio::ServeOptions options;
  options.port = arguments.port;
  options.begun = [&](const std::string& address) { say_address(arguments, address); };
  try {
    const bool is_well = studio::serve(session_options(arguments), options);
    return is_well ? ExitCode::clean : ExitCode::internal;
  } catch (const std::system_error& fault) {
    if (fault.code() != std::errc::address_in_use && fault.code() != std::errc::permission_denied)
      throw;
    throw CLI::ValidationError(
        "--port", fmt::format("{} cannot be had: {}", arguments.port, fault.code().message()));
  }
}

}  // namespace

void add_studio(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<StudioArguments>();
  CLI::App* command = app.add_subcommand(
      "studio", "Write rules beside the buildings that they label, in a browser");
  arguments->inputs = {"."};
  arguments->jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  command->add_option("input", arguments->inputs,
                      "Files of buildings, or folders of them; default: the current folder");
  command->add_option("--lod", arguments->lod,
                      "Level of detail to read, as written in the input (default: the highest)");
  command->add_option("--from", arguments->from, "Format of the input (default: from its name)")
      ->check(input_formats());
  command
      ->add_option("--rules", arguments->rules,
                   "Rule pack to edit: a file, or the name of a built-in pack to begin with")
      ->capture_default_str();
  command->add_option("--truth", arguments->truth,
                      "*.truth.json and *.truth.jsonl files, or folders of them");
  command
      ->add_option("--corrections", arguments->corrections,
                   "File to which labels go that are corrected in the page")
      ->capture_default_str();
  command->add_option("--port", arguments->port, "Port on 127.0.0.1; 0: one that is free")
      ->check(count_in(0, 65535))
      ->capture_default_str();
  command->add_flag("--no-browser", arguments->has_no_browser,
                    "Print the address and open no browser");
  add_solid_arguments(*command, *arguments);
  add_jobs_argument(*command, arguments->jobs);
  command->add_flag("-v,--verbose", arguments->is_verbose, "Also show notes, and every request");
  command->footer(
      "The address that is printed has a token; who has it can use the studio.\n"
      "Example:\n  oriel studio houses/ --rules my_pack.yaml --truth houses/");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
