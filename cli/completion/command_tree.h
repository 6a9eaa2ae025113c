#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace oriel::cli {

/// An option as a shell completes it.
struct CompletedOption {
  std::vector<std::string> names;  ///< as they are typed: "-o", "--output"
  std::string sentence;
  bool takes_value = false;
  bool is_number = false;            ///< the value is one
  bool is_repeated = false;          ///< it may be given several times
  std::vector<std::string> choices;  ///< all that the value may be; empty: anything
};

/// A command, its options and the commands below it, as a shell completes them.
struct CompletedCommand {
  std::string words;  ///< "rules check"; of the program itself empty
  std::string name;   ///< the last of them
  std::string sentence;
  std::vector<CompletedOption> options;
  std::vector<CompletedCommand> commands;
};

/// What `--help` of the app and of its commands shows, in the same order: nothing hidden.
CompletedCommand command_tree(const CLI::App& app);

/// The tree in one row, a command before those below it.
std::vector<const CompletedCommand*> all_commands(const CompletedCommand& tree);

}  // namespace oriel::cli
