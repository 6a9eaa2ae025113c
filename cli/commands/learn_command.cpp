#include "cli/batch/arena.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/output/named_files.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/option_values.h"
#include "cli/terminal/print_out.h"
#include "cli/terminal/step_progress.h"
#include "io/files/output_file.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "kernel/base/text/suggest.h"
#include "oriel/corrections.h"
#include "oriel/learn.h"
#include "oriel/rules.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;

/// Words of --objective besides the classes of the pack.
constexpr const char* kMacroF1 = "macro_f1";
constexpr const char* kCost = "cost";

struct LearnArguments {
  std::vector<std::string> records;
  std::vector<std::string> truth;
  std::vector<std::string> models;
  std::string corrections;
  std::string rules = "residential";
  std::string out;
  std::string objective = kMacroF1;
  std::string costs;
  std::vector<std::string> params;
  std::size_t folds = 5;
  bool leaves_one_out = false;
  double penalty = LearnOptions{}.penalty;
  int restarts = LearnOptions{}.restarts;
  std::uint64_t seed = 1;
  std::size_t questions = 0;
  bool proposes = false;
  int jobs = 1;
  std::string progress;
  bool is_json = false;
  bool is_verbose = false;
};

/// What the word means; a word that means nothing is wrong usage. Nothing if the file of costs is
/// wrong, which is reported.
std::optional<Objective> objective_of(const LearnArguments& arguments, const RuleBase& rules,
                                      Report& report) {
  const std::string& word = arguments.objective;
  if (word == kMacroF1) return Objective::macro_f1();
  if (word != kCost) {
    const std::vector<std::string> labels = rules.labels();
    if (std::ranges::find(labels, word) != labels.end()) return Objective::f1_of(word);
    std::vector<std::string> known = labels;
    known.insert(known.end(), {kMacroF1, kCost});
    const std::string meant = nearest(word, known);
    throw CLI::ValidationError(
        "--objective",
        fmt::format("'{}' is none of {}, {} and the classes of the pack ({}){}", printable(word),
                    kMacroF1, kCost, printable(fmt::format("{}", fmt::join(labels, ", "))),
                    meant.empty() ? "" : "; did you mean '" + printable(meant) + "'?"));
  }
  auto costs = read_costs_file(arguments.costs);
  report.add(costs.issues);
  if (!costs.value) return std::nullopt;
  return Objective::least_cost(std::move(*costs.value));
}

/// A pack extends one that is built in, or one in its own folder.
void check_folder(const LearnArguments& arguments) {
  if (arguments.out.empty() || embedded_pack(arguments.rules)) return;
  std::error_code problem;
  const auto folder_of = [&](const std::string& path) {
    const fs::path parent = fs::path(path).parent_path();
    return fs::weakly_canonical(parent.empty() ? fs::path(".") : parent, problem);
  };
  if (folder_of(arguments.out) != folder_of(arguments.rules))
    refuse_usage("-o", Code::R246,
                 fmt::format("a pack extends one in its own folder: write into that of {}",
                             printable(arguments.rules)));
}

/// The name of the learnt pack: of its file, as far as a pack can be called so.
std::string name_of_pack(const std::string& path) {
  std::string name;
  for (const char c : fs::path(path).stem().string()) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    name += is_letter ? c : '_';
  }
  return name.empty() || name.front() < 'a' ? "learnt" : name;
}

std::string extended_name(const std::string& rules) {
  return embedded_pack(rules) ? rules : fs::path(rules).filename().string();
}

/// Changes of rules that pay with the pack as it is, as a person can put them into a pack.
std::string proposals_text(const LearnArguments& arguments, const RuleBase& rules,
                           const std::vector<Sample>& samples, const std::vector<SamplePart>& parts,
                           const Objective& objective) {
  ProposeOptions options;
  options.objective = objective;
  options.penalty = arguments.penalty;
  const auto proposals =
      propose(rules, samples, parts, options, shares_in_arena(arguments.jobs)).value();
  if (proposals.empty()) return "no change of a rule pays on held-out folds\n";
  const auto merged = merge_pack_file(arguments.rules);
  return "changes of rules that pay, for a person to judge:\n" +
         to_yaml(proposals, merged.value.value_or(""));
}

/// What is printed of what was learnt, with the further lists that were asked for.
std::string text_of(const LearnArguments& arguments, const RuleBase& rules,
                    const std::vector<Sample>& samples,
                    const std::vector<std::vector<std::size_t>>& parts, const Objective& objective,
                    const Learnt& learnt) {
  std::string text = arguments.is_json ? to_json(learnt, rules) + "\n" : to_text(learnt, rules);
  if (arguments.questions > 0)
    text += "answers that would help most:\n" +
            to_text(open_questions(rules, samples, learnt, arguments.questions));
  if (arguments.proposes) text += proposals_text(arguments, rules, samples, parts, objective);
  return text;
}

LearnOptions learn_options(const LearnArguments& arguments, const Objective& objective) {
  LearnOptions options;
  options.objective = objective;
  options.penalty = arguments.penalty;
  options.restarts = arguments.restarts;
  options.seed = arguments.seed;
  options.params = arguments.params;
  return options;
}

ExitCode learn(const LearnArguments& arguments, Report& report) {
  const auto rules = load_rules({arguments.rules, {}}, report);
  if (!rules) return ExitCode::rules;
  const auto objective = objective_of(arguments, *rules, report);
  if (!objective) return ExitCode::rules;
  report.add(report_old_records(arguments.records, arguments.models));
  ExitCode code = ExitCode::clean;
  const auto corrections = load_corrections(arguments.corrections, *rules, report, code);
  const auto samples = read_samples(arguments.records, arguments.truth, *rules, corrections.get());
  report.add(samples.issues);
  code = graver(code, exit_code_of(samples.issues));
  if (!samples.value) return code;
  // Opened first: a place that cannot be written is no surprise after a long search.
  std::optional<OutputFile> pack;
  if (!arguments.out.empty()) pack.emplace(arguments.out);
  const auto parts = folds_of(samples.value->size(), arguments.leaves_one_out ? 0 : arguments.folds,
                              arguments.seed);
  std::optional<StepProgress> progress(progress_style_of(arguments.progress));
  LearnOptions options = learn_options(arguments, *objective);
  options.step = [&](std::size_t done, std::size_t all) { progress->show("learning", done, all); };
  const auto learnt =
      learn_params(*rules, *samples.value, parts, options, shares_in_arena(arguments.jobs));
  progress.reset();
  report.add(learnt.issues);
  code = graver(code, exit_code_of(learnt.issues));
  if (!learnt.value) return code;
  if (pack) {
    pack->append(learnt_pack(*learnt.value, *rules, name_of_pack(arguments.out),
                             extended_name(arguments.rules)));
    pack->commit();
  }
  print_out(text_of(arguments, *rules, *samples.value, parts, *objective, *learnt.value),
            arguments.is_json);
  return code;
}

ExitCode work(LearnArguments& arguments) {
  if (arguments.truth.empty() && arguments.corrections.empty()) throw CLI::RequiredError("--truth");
  if (arguments.objective == kCost && arguments.costs.empty())
    throw CLI::ValidationError("--objective", "cost needs --costs FILE");
  if (arguments.objective != kCost && !arguments.costs.empty())
    throw CLI::ValidationError("--costs", "works only with --objective cost");
  if (arguments.proposes && arguments.objective == kCost)
    throw CLI::ValidationError("--propose", "looks at F1, not at costs");
  if (arguments.is_json && (arguments.proposes || arguments.questions > 0))
    throw CLI::ValidationError("--json", "does not work with --ask and --propose");
  Report report(arguments.is_verbose);
  read_once(arguments.records, report);
  arguments.truth = truth_files(arguments.truth);
  read_once(arguments.truth, report);
  read_once(arguments.models, report);
  NamedFiles names;
  for (const std::string& records : arguments.records) names.add_input("records", records);
  for (const std::string& truth : arguments.truth) names.add_input("--truth", truth);
  for (const std::string& model : arguments.models) names.add_input("--models", model);
  names.add_input("--rules", arguments.rules);
  if (!arguments.costs.empty()) names.add_input("--costs", arguments.costs);
  if (!arguments.corrections.empty()) names.add_input("--corrections", arguments.corrections);
  names.add_output("-o", arguments.out);
  names.check();
  check_folder(arguments);
  return learn(arguments, report);
}

void add_search_arguments(CLI::App& command, LearnArguments& arguments) {
  command
      .add_option("--objective", arguments.objective,
                  "What is made best: macro_f1, a class for its F1, or cost for the least cost of "
                  "errors")
      ->capture_default_str();
  command.add_option("--costs", arguments.costs,
                     "What errors cost: lines of truth,predicted,cost; - for nothing");
  command.add_option("--params", arguments.params, "The params that may be changed; default: all")
      ->delimiter(',');
  CLI::Option* folds = command
                           .add_option("--folds", arguments.folds,
                                       "Parts of the buildings that are held out in turn")
                           ->check(count_in(2, 1000))
                           ->capture_default_str();
  command.add_flag("--leave-one-out", arguments.leaves_one_out, "Hold out each building by itself")
      ->excludes(folds);
  command.add_option("--penalty", arguments.penalty, "What each changed param must gain")
      ->check(number_in(0, 1))
      ->capture_default_str();
  command
      .add_option("--restarts", arguments.restarts, "How often the search begins again elsewhere")
      ->check(count_in(0, 100))
      ->capture_default_str();
  command.add_option("--seed", arguments.seed, "Of folds, restarts and intervals")
      ->capture_default_str();
}

}  // namespace

void add_learn(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<LearnArguments>();
  CLI::App* command = app.add_subcommand(
      "learn", "Find values of a pack's params with which it labels samples best");
  command
      ->add_option("records", arguments->records,
                   "Records of features, as segment or label --features writes them")
      ->required();
  command->add_option("--truth", arguments->truth,
                      "*.truth.json and *.truth.jsonl files, or folders of them");
  command->add_option("--models", arguments->models,
                      "The models that the records were made from: a warning if one is newer");
  add_corrections_argument(*command, arguments->corrections);
  command
      ->add_option("--rules", arguments->rules,
                   "Rule pack to start from: a file, or the name of a built-in pack")
      ->capture_default_str();
  command->add_option("-o,--output", arguments->out,
                      "Write a pack that extends the other and changes what was learnt");
  add_search_arguments(*command, *arguments);
  command
      ->add_option("--ask", arguments->questions,
                   "List so many features whose right label would help most")
      ->check(count_in(1, 1'000'000));
  command->add_flag("--propose", arguments->proposes,
                    "List changes of rules that would pay, as YAML for a person to judge");
  command->add_flag("--json", arguments->is_json, "Print JSON");
  add_jobs_argument(*command, arguments->jobs);
  add_step_progress_argument(*command, arguments->progress);
  command->add_flag("-v,--verbose", arguments->is_verbose, "Also show notes");
  command->footer(
      "Nothing is changed that does not pay on held-out buildings.\nExample:\n  oriel segment "
      "data/*.stripped.city.json --features parts.jsonl\n  oriel learn parts.jsonl --truth data/ "
      "--rules residential -o learnt.yaml");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
