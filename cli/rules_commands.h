#pragma once

#include "cli/commands.h"

namespace oriel::cli {

/// Each adds one command under `oriel rules`.
void add_rules_test(CLI::App& rules, Action& action);

}  // namespace oriel::cli
