#pragma once

#include "cli/terminal/exit_code.h"

#include <functional>

namespace CLI {
class App;
}  // namespace CLI

namespace oriel::cli {

/// What a command does once its arguments are read; set by the parse callback of the command that
/// was named.
using Action = std::function<ExitCode()>;

/// Each adds one command with its arguments and help to the app. When the command is named,
/// `action` becomes its work.
void add_cat(CLI::App& app, Action& action);
void add_collect(CLI::App& app, Action& action);
void add_segment(CLI::App& app, Action& action);
void add_label(CLI::App& app, Action& action);
void add_generalise(CLI::App& app, Action& action);
void add_repair(CLI::App& app, Action& action);
void add_explain(CLI::App& app, Action& action);
void add_interpret(CLI::App& app, Action& action);
void add_learn(CLI::App& app, Action& action);
void add_diff(CLI::App& app, Action& action);
void add_score(CLI::App& app, Action& action);
void add_validate(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);
void add_studio(CLI::App& app, Action& action);
void add_tiles(CLI::App& app, Action& action);
void add_split(CLI::App& app, Action& action);
void add_merge(CLI::App& app, Action& action);
void add_rules(CLI::App& app, Action& action);
void add_experiment(CLI::App& app, Action& action);
void add_completion(CLI::App& app, Action& action);
/// `rules lsp`: what editors ask while a pack is written.
void add_rules_lsp(CLI::App& rules, Action& action);

}  // namespace oriel::cli
