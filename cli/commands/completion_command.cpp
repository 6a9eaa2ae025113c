#include "cli/commands/commands.h"
#include "cli/completion/scripts.h"
#include "cli/terminal/option_values.h"
#include "cli/terminal/print_out.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace oriel::cli {

void add_completion(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "completion", "Print the script that completes commands and options in bash, zsh or fish");
  // Who installs oriel has the scripts already: not among what it does with buildings.
  command->group("");
  auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "The shell")
      ->required()
      ->check(one_of({"bash", "zsh", "fish"}));
  command->footer("Example:\n  source <(oriel completion bash)");
  command->callback([&app, &action, shell] {
    action = [&app, shell] {
      const CompletedCommand tree = command_tree(app);
      print_out(*shell == "bash"  ? bash_script(tree)
                : *shell == "zsh" ? zsh_script(tree)
                                  : fish_script(tree),
                true);
      return ExitCode::clean;
    };
  });
}

}  // namespace oriel::cli
