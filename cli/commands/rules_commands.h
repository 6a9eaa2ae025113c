#pragma once

#include "cli/commands/commands.h"

namespace oriel::cli {

/// Each adds its commands under `oriel rules`.
void add_rules_test(CLI::App& rules, Action& action);
/// schema, fmt and show
void add_rules_text(CLI::App& rules, Action& action);

}  // namespace oriel::cli
