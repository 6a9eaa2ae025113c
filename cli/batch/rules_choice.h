#pragma once

#include <string>
#include <vector>

namespace oriel::cli {

/// Which rules a command goes by: --rules and --param.
struct RulesChoice {
  /// A file, or the name of a pack that is built in.
  std::string rules = "residential";
  /// Params of the pack at other values: "parapet=0.8 m".
  std::vector<std::string> params;
};

}  // namespace oriel::cli
