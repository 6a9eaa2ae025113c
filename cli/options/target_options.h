#pragma once

#include "cli/terminal/logging.h"
#include "oriel/generalise.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// What the options of a command ask for.
struct TargetArguments {
  bool has_scale = false;
  std::string scale;
  std::vector<std::string> lods;
  std::string profile;
  double edge_min_m = 0;  ///< 0: what the profile says
};

/// Throws CLI::ValidationError for a level that the profile does not have, which is wrong usage:
/// the profile itself is right.
void check_level(const std::string& option, const std::vector<Issue>& issues);

/// What --scale or else --to-lod asks for, with --profile; with neither of them the level of the
/// profile. Nothing if a profile cannot be used, which is reported. Throws CLI::ValidationError.
std::optional<Targets> targets_of(const TargetArguments& arguments, const RuleBase& rules,
                                  bool has_neighbours, Report& report);

}  // namespace oriel::cli
