#pragma once

#include "cli/terminal/report.h"
#include "interpret/pack/rule_base.h"
#include "oriel/generalise.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// N of "1:N", "1 : N" or "N", at least 1; else `option` is refused with E125 (refuse_usage).
double denominator_of(const std::string& text, const std::string& option);

/// What the options of a command ask for.
struct TargetArguments {
  bool has_scale = false;
  std::string scale;
  std::vector<std::string> lods;
  std::string profile;
  double edge_min_m = 0;  ///< 0: what the profile says
};

/// What --scale or else --to-lod asks for, with --profile; with neither of them the level of the
/// profile. Nothing if a profile cannot be used, which is told. Throws CLI::ValidationError for a
/// scale or level that is none.
std::optional<Targets> targets_of(const TargetArguments& arguments, const RuleBase& rules,
                                  Report& report);

}  // namespace oriel::cli
