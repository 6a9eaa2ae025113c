#include "cli/options/options.h"

#include "cli/batch/batch_command.h"
#include "cli/output/column_choice.h"
#include "cli/output/label_outputs.h"
#include "cli/terminal/option_values.h"
#include "io/records/feature_records.h"
#include "kernel/base/text/counted.h"
#include "oriel/corrections.h"
#include "oriel/score.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

void add_selection_arguments(CLI::App& command, Selection& selection) {
  command.add_option("--id", selection.ids, "Only the building with this id; may be repeated")
      ->allow_extra_args(false);
  command
      .add_option("--bbox", selection.bbox,
                  "Only buildings whose bounding box has its centre in this rectangle")
      ->delimiter(',')
      ->expected(4)
      ->type_name("XMIN,YMIN,XMAX,YMAX");
  command.add_option("--cotype", selection.cotype,
                     "Only features of this type: Building, Road, Bridge ...");
  command
      .add_option("--random", selection.one_in,
                  "Only about one in N buildings, chosen from their ids and --seed, the same ones "
                  "in every run")
      ->check(count_in(1, 1'000'000'000));
  command
      .add_option("--seed", selection.seed,
                  "Seed of --random: another seed selects other buildings")
      ->capture_default_str();
  command.add_flag(
      "--exclude", selection.is_exclusion,
      "All buildings except those that --id, --bbox, --cotype and --random select together");
}

}  // namespace

void refuse_usage(const std::string& option, Code code, const std::string& sentence) {
  throw CLI::ValidationError(option, fmt::format("{} {}", to_string(code), sentence));
}

void check_output_format(const RunOptions& arguments, const BatchCommand& command,
                         const std::string& path, Format written) {
  NamedFiles files;
  files.add(arguments);
  command.name_files(files);
  files.check();
  const auto named = format_of(path);
  if (!named || *named == written) return;
  const bool is_stream = written == Format::cityjson_seq;
  throw CLI::ValidationError(
      "-o", fmt::format("{} is written, and '{}' is a name of {}: end it in {} (oriel label writes "
                        "other formats)",
                        to_string(written), path, to_string(*named),
                        is_stream ? ".city.jsonl" : ".city.json"));
}

double denominator_of(const std::string& text, const std::string& option) {
  std::string number;
  std::ranges::remove_copy(text, std::back_inserter(number), ' ');
  if (number.starts_with("1:")) number.erase(0, 2);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size() || !(value >= 1) ||
      !std::isfinite(value))
    refuse_usage(option, Code::E125,
                 fmt::format("'{}' is not a scale: write 1:N with N >= 1, such as 1:2000", text));
  return value;
}

std::vector<double> scales_of(const std::vector<std::string>& texts, const std::string& option) {
  std::vector<double> scales;
  for (const std::string& text : texts) scales.push_back(denominator_of(text, option));
  std::ranges::sort(scales);
  const auto twin = std::ranges::adjacent_find(scales);
  if (twin != scales.end())
    refuse_usage(option, Code::E125,
                 fmt::format("the scale 1:{} is given twice; name each scale once", *twin));
  return scales;
}

CLI::Validator input_formats() {
  return one_of({"cityjson", "cityjsonseq", "citygml", "obj", "off", "ply", "stl"});
}

void add_input_arguments(CLI::App& command, RunOptions& a, bool has_many) {
  const char* what =
      "CityJSON, CityJSONSeq, CityGML, OBJ, OFF, PLY or STL; - for stdin (CityJSONSeq unless "
      "--from "
      "is given)";
  if (has_many) {
    command.add_option("input", a.inputs, what)->required();
  } else {
    // Not the vector itself: it would swallow the positional arguments that follow.
    a.inputs.resize(1);
    command.add_option("input", a.inputs[0], what)->required();
  }
  command.add_option("--lod", a.lod,
                     "Level of detail to read, as written in the input (default: the highest)");
  command
      .add_option("--from", a.from,
                  "Format of the input (default: from its name; for stdin: cityjsonseq)")
      ->check(input_formats());
  if (has_many) add_selection_arguments(command, a.selection);
}

void add_solid_arguments(CLI::App& command, RunOptions& a) {
  command
      .add_option("--coplanar-deg", a.tolerances.coplanar_deg,
                  "Polygons share a plane if their tilt differs by no more than this, in degrees")
      ->check(number_in(0.0, 30.0))
      ->capture_default_str();
  command
      .add_option("--plane-offset", a.tolerances.plane_offset_m,
                  "... and their offset by no more than this, in m; if not given, segmenting "
                  "raises it for noisy buildings")
      ->check(number_in(0.0, 1.0))
      ->each([&a](const std::string&) { a.is_plane_offset_given = true; })
      ->capture_default_str();
  command.add_option("--weld", a.tolerances.weld_m, "Merge vertices closer than this, in m")
      ->check(number_in(1e-6, 1.0))
      ->capture_default_str();
  command
      .add_option("--close", a.close,
                  "Holes to close in a building that is not a closed shell: none; planar: plane "
                  "holes of up to --close-area; ground: these, and a missing ground and missing "
                  "walls of any size; any: every plane hole")
      ->check(one_of({"none", "planar", "ground", "any"}))
      ->capture_default_str();
  command
      .add_option("--close-area", a.cap_area_m2,
                  "Largest plane hole to close with --close planar or ground, in m2")
      ->check(at_least_zero())
      ->capture_default_str();
  command
      .add_option("--crossings", a.crossings,
                  "Polygons that cross each other in a building that is not a closed shell: leave "
                  "them, or cut them where they meet")
      ->check(one_of({"leave", "cut"}))
      ->capture_default_str();
}

void add_jobs_argument(CLI::App& command, int& jobs) {
  command
      .add_option("-j,--jobs", jobs,
                  "Buildings to process in parallel; 0: one per core. The output is the same")
      ->check(count_in(0, 1024))
      ->transform([](const std::string& text) {
        return text == "0" ? std::to_string(std::max(1U, std::thread::hardware_concurrency()))
                           : text;
      })
      ->capture_default_str();
}

void add_run_arguments(CLI::App& command, RunOptions& a) {
  command.add_option("--timings", a.timings_file,
                     "Write the milliseconds of each stage to this file, as JSON");
  command.add_option("--repeat", a.repeat, "Run this many times; --timings writes the medians")
      ->check(count_in(1, 1000))
      ->capture_default_str();
  add_jobs_argument(command, a.jobs);
  command
      .add_option("--progress", a.progress,
                  "Show on stderr: bar (and a table at the end), json (lines) or none (default: "
                  "bar on a terminal)")
      ->check(one_of({"bar", "json", "none"}));
  command.add_option("--status", a.status_stem,
                     "Write STEM.status.json (counts, hashes) and STEM.quarantine.jsonl (every "
                     "record with something rejected, and why)");
  command
      .add_option("--allow-bad", a.allowed_bad,
                  "Exit with 0 if at most this many buildings (N), or per cent of them (P%), are "
                  "rejected")
      ->check([](const std::string& text) {
        const bool is_share = text.ends_with('%');
        const std::string digits = text.substr(0, text.size() - (is_share ? 1 : 0));
        const bool is_number = !digits.empty() && digits.size() <= 9 &&
                               digits.find_first_not_of("0123456789.") == std::string::npos &&
                               std::ranges::count(digits, '.') <= (is_share ? 1 : 0) &&
                               digits != ".";
        return is_number ? std::string()
                         : "'" + text + "' is neither a number nor a share such as 1%";
      })
      ->capture_default_str();
  command.add_flag("-v,--verbose", a.is_verbose, "Also show notes, and list every finding");
}

void add_resume_argument(CLI::App& command, RunOptions& a) {
  command
      .add_flag("--resume", a.is_resumable,
                "Resume the same command after it was killed, after its last whole record; needs "
                "--status")
      ->needs(command.get_option("--status"))
      ->excludes(command.get_option("--repeat"));
}

void add_reuse_argument(CLI::App& command, RunOptions& a) {
  command
      .add_option("--reuse", a.reuse,
                  "STEM.status.json of an earlier run with --reuse: records whose source has not "
                  "changed are copied from its outputs; needs --status")
      ->needs(command.get_option("--status"))
      ->excludes(command.get_option("--repeat"));
}

void add_force_argument(CLI::App& command, RunOptions& a) {
  a.offers_force = true;
  auto* option =
      command.add_flag("--force", a.is_forced,
                       "Let -o be an input: it is replaced once the whole output is written");
  for (const char* other : {"--resume", "--reuse"})
    if (auto* there = command.get_option_no_throw(other)) option->excludes(there);
}

void add_isolate_argument(CLI::App& command, RunOptions& a) {
  command.add_flag(
      "--isolate", a.is_isolated,
      "Work in forked processes: a crash (a signal) costs only one building, which is rejected");
  command
      .add_option("--most-seconds", a.most_seconds,
                  "Reject a building that takes longer than this; results may then differ from run "
                  "to run; needs --isolate")
      ->check(number_in(0.001, 1e6))
      ->needs(command.get_option("--isolate"));
}

void add_line_arguments(CLI::App& command, RunOptions& a, bool has_many) {
  add_input_arguments(command, a, has_many);
  command
      .add_option("--order", a.order,
                  "Order of cuts: natural (along existing edges first) or paper (as in the paper)")
      ->check(one_of({"natural", "paper"}))
      ->capture_default_str();
  add_solid_arguments(command, a);
  command
      .add_option("--value-rel", a.tolerances.value_rel,
                  "Values of features that differ by no more than this fraction count as equal")
      ->check(number_in(0.0, 0.5))
      ->capture_default_str();
  command.add_option("--budget", a.budget, "Most steps that each stage may take on one building")
      ->check(above_zero())
      ->capture_default_str();
  add_run_arguments(command, a);
}

void add_rules_arguments(CLI::App& command, RulesChoice& choice) {
  command.add_option("--rules", choice.rules, "Rule pack: a file, or the name of a built-in pack")
      ->capture_default_str();
  command
      .add_option("--param", choice.params,
                  "A param of the pack at another value, with its unit and within its range: "
                  "parapet=0.8m; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
}

void add_features_argument(CLI::App& command, std::string& file) {
  add_records_output(command, "--features", file,
                     "Write one record per feature: .csv, .json or .jsonl");
}

void add_records_output(CLI::App& command, const std::string& option, std::string& file,
                        const std::string& what) {
  command.add_option(option, file, what)->check([](const std::string& name) {
    return record_format_of(name) ? std::string()
                                  : "'" + name + "' does not end in .csv, .json or .jsonl";
  });
}

void add_safe_cells_argument(CLI::App& command, bool& is_safe) {
  command.add_flag("--safe-cells", is_safe,
                   "In CSV, put a ' before cells that a spreadsheet would run as a formula: those "
                   "that begin with = + - @ and are not numbers");
}

void add_corrections_argument(CLI::App& command, std::string& file) {
  command.add_option("--corrections", file,
                     "What features are, whatever the rules say: lines of JSON with building, "
                     "feature or point, class, by, why");
}

void add_neighbours_argument(CLI::App& command, std::vector<std::string>& named) {
  command.add_flag("--neighbours", named,
                   "Look which buildings of all inputs touch, for rules and results about party "
                   "walls, yards and streets. --neighbours=FILE also looks at the buildings of a "
                   "file or folder, which are not written; may be repeated");
}

std::shared_ptr<const Corrections> load_corrections(const std::string& file, const RuleBase& rules,
                                                    Report& report, ExitCode& code) {
  if (file.empty()) return nullptr;
  auto read = read_corrections(file);
  report.add(read.issues);
  const auto unknown = drop_unknown_classes(*read.value, rules.labels());
  report.add(unknown);
  if (!read.issues.empty() || !unknown.empty()) code = graver(code, ExitCode::set_aside);
  return std::make_shared<Corrections>(*read.value);
}

void add_step_progress_argument(CLI::App& command, std::string& style) {
  command
      .add_option("--progress", style,
                  "Show on stderr: bar, json (lines) or none (default: bar on a terminal)")
      ->check(one_of({"bar", "json", "none"}));
}

ExitCode exit_code_of(const std::vector<Issue>& issues) {
  ExitCode code = ExitCode::clean;
  for (const Issue& issue : issues) {
    const bool is_of_rules = to_string(issue.code).starts_with("R");
    if (issue.severity == Severity::error)
      code = graver(code, is_of_rules ? ExitCode::rules : ExitCode::input);
    else if (issue.severity == Severity::warning && !is_of_rules && issue.code != Code::E121)
      code = graver(code, ExitCode::set_aside);
  }
  return code;
}

void add_label_arguments(CLI::App& command, LabellingArguments& a) {
  add_line_arguments(command, a, true);
  add_rules_arguments(command, a);
  command.add_option("-o,--output", a.out,
                     "File, - for stdout, or a folder (ending in /) for several inputs");
  command.add_option("--to", a.to, "Format to write (default: from the name of the output)")
      ->check(one_of({"cityjson", "cityjsonseq", "citygml2", "citygml3", "gpkg", "obj", "off",
                      "ply", "stl", "glb"}));
  command.add_flag("--closed-installations", a.closes_installations,
                   "In CityGML: write installations as closed solids, apart from their building");
  add_features_argument(command, a.features);
  add_columns_argument(command, a.columns);
  add_safe_cells_argument(command, a.has_safe_cells);
  add_neighbours_argument(command, a.neighbours_of);
  add_resume_argument(command, a);
  add_reuse_argument(command, a);
  add_force_argument(command, a);
  add_isolate_argument(command, a);
  command
      .add_option("--codelist", a.codelist,
                  "Code list for the functions of installations; the pack must have codes for it")
      ->capture_default_str();
}

std::optional<Issue> no_names(const SurfaceScore& score, int buildings) {
  if (buildings == 0 || !score.area_m2.empty() || score.openings_m2 > 0) return std::nullopt;
  return nothing_compared(
      fmt::format("no polygon of {} has a name (semantics) in the input: nothing is compared",
                  counted(buildings, "building")));
}

std::optional<RuleBase> load_pack(const std::string& pack, Report& report) {
  auto loaded = load_pack_file(pack);
  report.add(loaded.issues);
  return loaded.value;
}

std::optional<RuleBase> with_params(const RuleBase& pack, const std::vector<std::string>& params,
                                    Report& report) {
  if (params.empty()) return pack;
  auto set = oriel::with_params(pack, params);
  for (Issue& issue : set.issues) issue.place.file.insert(0, "--param ");
  report.add(set.issues);
  return set.value;
}

std::optional<RuleBase> load_rules(const RulesChoice& choice, Report& report) {
  const auto pack = load_pack(choice.rules, report);
  return pack ? with_params(*pack, choice.params, report) : std::nullopt;
}

}  // namespace oriel::cli
