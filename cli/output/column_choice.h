#pragma once

#include "oriel/interpret.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace oriel::cli {

/// Adds `--columns`: fields of records, or groups of them, with commas between. Another word is
/// wrong usage, and the nearest is named.
void add_columns_argument(CLI::App& command, std::vector<std::string>& columns);

/// What the words name; nothing named: all columns. `rules` are those of the pack.
RecordColumns chosen_columns(const std::vector<std::string>& words, const RuleBase& rules);

}  // namespace oriel::cli
