#include "cli/commands/commands.h"
#include "model/version.h"
#include "studio/lsp/language_server.h"

#include <cstdint>
#include <unistd.h>

#include <CLI/CLI.hpp>

namespace oriel::cli {

void add_rules_lsp(CLI::App& rules, Action& action) {
  CLI::App* command = rules.add_subcommand(
      "lsp", "Serve editors: the Language Server Protocol on stdin and stdout, for rule packs");
  // What many clients add to the command of a server that they start.
  command->add_flag_function(
      "--stdio", [](std::int64_t) {}, "Speak on stdin and stdout, as is done in any case");
  command->footer("Example:\n  oriel rules lsp   (an editor starts it: docs/editors.md)");
  command->callback([&action] {
    action = [] {
      const int code = studio::serve_language(
          STDIN_FILENO, STDOUT_FILENO, {kVersion, ORIEL_DOCS_URL, studio::folder_of_copies()});
      return static_cast<ExitCode>(code);
    };
  });
}

}  // namespace oriel::cli
