#include "cli/commands/commands.h"

/// The command under the thread sanitizer lacks those that do not share work among threads, or
/// whose work tests/tsan.sh does not run: compiling them once more would take CI half a minute.
namespace oriel::cli {

void add_cat(CLI::App&, Action&) {}
void add_collect(CLI::App&, Action&) {}
void add_explain(CLI::App&, Action&) {}
void add_learn(CLI::App&, Action&) {}
void add_diff(CLI::App&, Action&) {}
void add_score(CLI::App&, Action&) {}
void add_validate(CLI::App&, Action&) {}
void add_view(CLI::App&, Action&) {}
void add_tiles(CLI::App&, Action&) {}
void add_split(CLI::App&, Action&) {}
void add_merge(CLI::App&, Action&) {}
void add_rules(CLI::App&, Action&) {}
void add_experiment(CLI::App&, Action&) {}
void add_completion(CLI::App&, Action&) {}

}  // namespace oriel::cli
