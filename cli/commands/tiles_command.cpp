#include "cli/batch/batch_command.h"
#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/batch/inputs/neighbours.h"
#include "cli/commands/commands.h"
#include "cli/commands/options.h"
#include "cli/output/tiles_output.h"
#include "cli/terminal/option_values.h"
#include "kernel/base/text/counted.h"
#include "oriel/rules.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// Fewer triangles to a tile would be many files, more would be slow to load.
constexpr std::uint64_t kLeastTriangles = 100, kMostTriangles = 10'000'000;
constexpr int kMostLevels = 100;

struct TilesCall : TilesArguments {
  std::vector<std::string> scale_texts{"1:500", "1:2500", "1:10000", "1:25000"};
  int levels = 0;  ///< 0: the scales that are given
  std::string profile_name;
};

/// The scales that are given, or so many between the first and the last.
std::vector<double> levels_of(const TilesCall& call) {
  const std::vector<double> given = scales_of(call.scale_texts, "--scales");
  if (call.levels == 0) return given;
  if (given.size() < 2)
    refuse_usage("--levels", Code::E125, "needs --scales with the first and the last scale");
  return scales_between(given.front(), given.back(), call.levels);
}

ExitCode work(TilesCall& call) {
  call.only_names_surfaces = true;
  Report report(call.is_verbose);
  settle_inputs(call, report);
  call.tileset.scales = levels_of(call);
  check_tiles_folder(call);
  const auto rules = load_rules(call, report);
  if (!rules) return ExitCode::rules;
  if (!call.profile_name.empty()) {
    auto profile = load_profile_file(call.profile_name);
    report.add(profile.issues);
    if (!profile.value) return ExitCode::rules;
    const auto unfit = check_profile(*profile.value, *rules, ProfileUse::tiles);
    report.add(unfit);
    if (has_errors(unfit)) return ExitCode::rules;
    call.profile = std::move(profile.value);
  }
  find_neighbours(call, report, call.folder);
  return write_tiles(call, *rules, report);
}

void add_tileset_arguments(CLI::App& command, TilesCall& call) {
  command.add_option("-o,--output", call.folder, "Folder of the tileset, which is new or empty")
      ->required();
  command.add_option("--scales", call.scale_texts, "Scales, such as 1:500,1:2500, one level each")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->default_str("1:500,1:2500,1:10000,1:25000");
  command
      .add_option("--levels", call.levels,
                  "So many levels from the first of --scales to the last, in equal ratios")
      ->check(count_in(2, kMostLevels));
  command.add_option("--profile", call.profile_name,
                     "What to do with features that the pack has no entry for: NAME[:LEVEL] or a "
                     "file (default: they stay)");
  command.add_option("--crs", call.tileset.crs,
                     "Coordinate reference system of the input, such as EPSG:7415; local: a frame "
                     "of its own (default: what the input names)");
  command
      .add_option_function<std::string>(
          "--colours",
          [&call](const std::string& by) {
            call.tileset.glb.colours = by == "label"      ? GlbColours::by_label
                                       : by == "surface"  ? GlbColours::by_surface
                                       : by == "material" ? GlbColours::by_material
                                                          : GlbColours::none;
          },
          "Colours of the faces: by label, by type of surface, by the input's material, or none")
      ->check(one_of({"label", "surface", "material", "none"}))
      ->default_str("label");
  command.add_flag("--viewer", call.has_viewer,
                   "Write index.html, too: a page that shows the tiles, from any file server");
  command.add_flag("--outlines", call.tileset.glb.has_outlines, "Draw edges as lines, too");
  command
      .add_option_function<std::string>(
          "--compress",
          [&call](const std::string& by) {
            call.tileset.glb.compression =
                by == "meshopt" ? GlbCompression::meshopt : GlbCompression::none;
          },
          "How vertices and triangles are compressed; nothing is lost")
      ->check(one_of({"none", "meshopt"}))
      ->default_str("none");
  command.add_flag("--gzip", call.tileset.has_gzip,
                   "Every file is a gzip archive under its own name, for servers that send "
                   "Content-Encoding: gzip");
  command
      .add_option("--most-triangles", call.tileset.most_triangles,
                  "Most triangles of a tile with more than one building")
      ->check(count_in(kLeastTriangles, kMostTriangles))
      ->capture_default_str();
}

}  // namespace

void add_tiles(CLI::App& app, Action& action) {
  auto call = std::make_shared<TilesCall>();
  CLI::App* command = app.add_subcommand(
      "tiles", "Write 3D Tiles of buildings generalised to several scales, for viewers");
  add_line_arguments(*command, *call, true);
  add_rules_arguments(*command, *call);
  add_tileset_arguments(*command, *call);
  add_neighbours_argument(*command, call->neighbours_of);
  add_resume_argument(*command, *call);
  command->footer(
      "Example:\n  oriel tiles city.city.jsonl -o tiles --scales 1:500,1:2500,1:10000 -j 0");
  command->callback([call, &action] { action = [call] { return work(*call); }; });
}

}  // namespace oriel::cli
