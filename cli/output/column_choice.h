#pragma once

#include "kernel/base/issue.h"
#include "oriel/interpret.h"

#include <optional>
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

/// A warning E151 if a table with these columns lacks some that the pack reads.
std::optional<Issue> lacks_columns(const std::string& file, const RecordColumns& columns,
                                   const RuleBase& rules);

}  // namespace oriel::cli
