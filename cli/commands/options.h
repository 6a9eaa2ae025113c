#pragma once

#include "cli/batch/selection.h"
#include "interpret/pack/rule_base.h"
#include "kernel/io/reader.h"
#include "kernel/model/repair.h"
#include "kernel/segment/segment.h"

#include <string>
#include <vector>

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace oriel::cli {

/// What all commands that run buildings down the line have in common.
struct LineArguments {
  std::vector<std::string> inputs;
  std::string lod;
  std::string from;
  std::string order = "natural";
  Tolerances tolerances;
  /// --plane-offset was given: it holds as it is, also for noisy buildings.
  bool is_plane_offset_given = false;
  std::string close = "planar";
  double cap_area_m2 = RepairOptions{}.cap_area_m2;
  std::string crossings = "leave";
  std::int64_t budget = SegmentOptions{}.budget;
  /// What the input calls its polygons is not looked at.
  bool ignores_semantics = false;
  bool is_verbose = false;
  std::string timings_file;
  int repeat = 1;
  /// Records on the line at the same time; results do not depend on it.
  int jobs = 1;
  /// Buildings are worked on in forked processes.
  bool is_isolated = false;
  /// By the clock, for one building in such a process; 0: as long as it takes.
  double most_seconds = 0;
  Selection selection;
  /// Where STEM.status.json and STEM.quarantine.jsonl go; empty: nowhere.
  std::string status_stem;
  /// bar, json, none; empty: a bar on a terminal.
  std::string progress;
  /// STEM.status.json of an earlier run, from which results are taken; empty: of none.
  std::string reuse;
  /// The run may be killed and goes on when the command is given again.
  bool is_resumable = false;
  /// So much may be set aside and all is well: a number of buildings, or a share of them.
  std::string allowed_bad = "0";
  /// What is asked for is what was read: buildings do not go down the line.
  bool ends_at_reading = false;
  /// What is asked for is the solid: buildings are not segmented.
  bool ends_at_solid = false;
  /// What is asked of surfaces is what they are, and of features their labels: attributes are told
  /// as far as rules read them.
  bool only_names_surfaces = false;
  bool only_labels_features = false;

  [[nodiscard]] ReadOptions read_options() const;
  /// The same for one of the inputs: stdin is a CityJSONSeq unless --from says more.
  [[nodiscard]] ReadOptions read_options(const std::string& input) const;
  /// The one input is a stream on stdin; what comes of it goes to stdout if nothing else is said.
  [[nodiscard]] bool is_piped_stream() const;
  /// The tolerances for a building: `tolerances`, fitted to its noise.
  [[nodiscard]] Tolerances tolerances_for(const Building& building) const;
  /// `fitted`: those of the building at hand.
  [[nodiscard]] SegmentOptions segment_options(const Tolerances& fitted) const;
  [[nodiscard]] RepairOptions repair_options() const;
  /// All that a result depends on beside input and rules, as one text: what oriel_config_sha256 is
  /// made of.
  [[nodiscard]] std::string configuration() const;
  /// True if no more of `buildings` was set aside than --allow-bad says.
  [[nodiscard]] bool allows(int set_aside, int buildings) const;
};

/// Throws CLI::ValidationError: wrong usage of `option` that has a code of its own
/// (docs/errors.md), told as "--scale: E125 sentence"; exit code 2.
[[noreturn]] void refuse_usage(const std::string& option, Code code, const std::string& sentence);

/// What `--from` may be.
CLI::Validator input_formats();

/// Adds what says which buildings are read: inputs, `--lod`, `--from` and, if the command takes
/// more than one input (`has_many`), the selection.
void add_input_arguments(CLI::App& command, LineArguments& arguments, bool has_many);

/// Adds the arguments that say how polygons become a solid.
void add_solid_arguments(CLI::App& command, LineArguments& arguments);

/// Adds `--jobs N`.
void add_jobs_argument(CLI::App& command, int& jobs);

/// Adds the arguments that say how the command goes about its work.
void add_run_arguments(CLI::App& command, LineArguments& arguments);

/// Adds `--resume`, for commands that can go on where a run was killed. Behind add_run_arguments.
void add_resume_argument(CLI::App& command, LineArguments& arguments);

/// Adds `--reuse`, for commands whose records are made one by one. Behind add_run_arguments.
void add_reuse_argument(CLI::App& command, LineArguments& arguments);

/// Adds `--isolate` and `--most-seconds`.
void add_isolate_argument(CLI::App& command, LineArguments& arguments);

/// Adds all of them to a command. `has_many`: it takes more than one input.
void add_line_arguments(CLI::App& command, LineArguments& arguments, bool has_many);

/// Adds `--rules PACK`.
void add_rules_argument(CLI::App& command, std::string& pack);

/// Adds `--features FILE`; a name without the ending of a format is wrong usage.
void add_features_argument(CLI::App& command, std::string& file);

/// Adds an option for a file of records, checked in the same way.
void add_records_output(CLI::App& command, const std::string& option, std::string& file,
                        const std::string& what);

}  // namespace oriel::cli
