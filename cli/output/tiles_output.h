#pragma once

#include "cli/batch/rules_choice.h"
#include "cli/batch/run_options.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/logging.h"
#include "oriel/rules.h"
#include "oriel/tiles.h"

#include <optional>
#include <string>

namespace oriel::cli {

/// What `oriel tiles` is to write.
struct TilesArguments : RunOptions, RulesChoice {
  std::string folder;
  TilesetOptions tileset;
  std::optional<Profile> profile;
  /// index.html, which shows the tiles, is written, too.
  bool has_viewer = false;
};

/// Throws CLI::ValidationError E164 if there are other files in the folder. Those that a run left
/// which was killed are none, nor is what a run with --resume goes on with.
void check_tiles_folder(const TilesArguments& arguments);

/// `oriel tiles`: the buildings of all inputs, one behind the other, go to FOLDER/buildings.part;
/// when all are there the tiles are made of it, and it is removed.
ExitCode write_tiles(const TilesArguments& arguments, const RuleBase& rules, Report& report);

}  // namespace oriel::cli
