#pragma once

#include "cli/batch/rules_choice.h"
#include "cli/batch/run_options.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/logging.h"
#include "io/files/format.h"
#include "oriel/rules.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace oriel {
struct SurfaceScore;
}

namespace oriel::cli {

class BatchCommand;
struct LabellingArguments;

/// Throws CLI::ValidationError: wrong usage of `option` that has a code of its own
/// (docs/errors.md), reported as "--scale: E125 sentence"; exit code 2.
[[noreturn]] void refuse_usage(const std::string& option, Code code, const std::string& sentence);

/// Throws CLI::ValidationError if -o, `path`, names a file of another format than the command
/// writes, which would be called what it is not; or, before that, if a file is named twice (E602).
void check_output_format(const RunOptions& arguments, const BatchCommand& command,
                         const std::string& path, Format written);

/// N of "1:N", "1 : N" or "N", at least 1; else `option` is refused with E125.
double denominator_of(const std::string& text, const std::string& option);

/// The denominators of an option that takes several, ascending; one that is given twice is refused
/// with E125.
std::vector<double> scales_of(const std::vector<std::string>& texts, const std::string& option);

/// What `--from` may be.
CLI::Validator input_formats();

/// Adds what says which buildings are read: inputs, `--lod`, `--from` and, if the command takes
/// more than one input (`has_many`), the selection.
void add_input_arguments(CLI::App& command, RunOptions& arguments, bool has_many);

/// Adds the arguments that say how polygons become a solid.
void add_solid_arguments(CLI::App& command, RunOptions& arguments);

/// Adds `--jobs N`.
void add_jobs_argument(CLI::App& command, int& jobs);

/// Adds the arguments that say how the command goes about its work.
void add_run_arguments(CLI::App& command, RunOptions& arguments);

/// Adds `--resume`, for commands that can go on where a run was killed. After add_run_arguments.
void add_resume_argument(CLI::App& command, RunOptions& arguments);

/// Adds `--reuse`, for commands whose records are made one by one. After add_run_arguments.
void add_reuse_argument(CLI::App& command, RunOptions& arguments);

/// Adds `--force`: -o may replace an input. After add_resume_argument and add_reuse_argument, which
/// it excludes: they need the input as it was.
void add_force_argument(CLI::App& command, RunOptions& arguments);

/// Adds `--isolate` and `--most-seconds`.
void add_isolate_argument(CLI::App& command, RunOptions& arguments);

/// Adds all of them to a command. `has_many`: it takes more than one input.
void add_line_arguments(CLI::App& command, RunOptions& arguments, bool has_many);

/// Adds `--rules PACK` and `--param NAME=VALUE`.
void add_rules_arguments(CLI::App& command, RulesChoice& choice);

/// Adds `--features FILE`; a name without the ending of a format is wrong usage.
void add_features_argument(CLI::App& command, std::string& file);

/// Adds an option for a file of records, checked in the same way.
void add_records_output(CLI::App& command, const std::string& option, std::string& file,
                        const std::string& what);

/// Adds `--safe-cells`, for commands that write CSV.
void add_safe_cells_argument(CLI::App& command, bool& is_safe);

/// Adds `--neighbours[=FILE]`.
void add_neighbours_argument(CLI::App& command, std::vector<std::string>& named);

/// Adds `--corrections FILE`.
void add_corrections_argument(CLI::App& command, std::string& file);

/// Corrections for labels of the pack; null for no file. What is wrong with them is reported, and
/// `code` is then at least set_aside.
std::shared_ptr<const Corrections> load_corrections(const std::string& file, const RuleBase& rules,
                                                    Report& report, ExitCode& code);

/// Adds `--progress` for a run of several steps (StepProgress).
void add_step_progress_argument(CLI::App& command, std::string& style);

/// What ends a run on samples that found these: what is wrong with rules or with an experiment is
/// ExitCode::rules, with files ExitCode::input, with a part of what they hold ExitCode::set_aside.
/// Warnings about a choice of samples, and about counts in tables (E121), change nothing.
ExitCode exit_code_of(const std::vector<Issue>& issues);

/// Adds all that the commands share that label buildings and write them.
void add_label_arguments(CLI::App& command, LabellingArguments& arguments);

/// A warning E131 if no polygon of the `buildings` that were read has a name to compare with.
std::optional<Issue> no_names(const SurfaceScore& score, int buildings);

/// The pack with its params set, with all findings reported; nothing if it cannot be used.
std::optional<RuleBase> load_rules(const RulesChoice& choice, Report& report);
/// The same in two steps.
std::optional<RuleBase> load_pack(const std::string& pack, Report& report);
std::optional<RuleBase> with_params(const RuleBase& pack, const std::vector<std::string>& params,
                                    Report& report);

}  // namespace oriel::cli
