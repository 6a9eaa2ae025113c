#pragma once

#include "cli/commands/commands.h"

namespace oriel::cli {

/// What can be looked up about packs: `rules doc`; `rules attributes`, `relations` and `operators`;
/// `rules explain`. Each adds its commands to `rules`.
void add_rules_doc(CLI::App& rules, Action& action);
void add_rules_words(CLI::App& rules, Action& action);
void add_rules_explain(CLI::App& rules, Action& action);

}  // namespace oriel::cli
