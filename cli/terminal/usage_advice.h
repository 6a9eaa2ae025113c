#pragma once

#include <string>

namespace CLI {
class App;
class Error;
}  // namespace CLI

namespace oriel::cli {

/// What is said of arguments that the parse left over: a command or an option that there is not,
/// with the one that was probably meant. Nothing if there are none.
std::string usage_advice(const CLI::App& app);

/// What is said of arguments that the parse refused: the option, what is wrong with it and what is
/// expected, with an example of the command where something is missing. Without a line end.
std::string usage_sentence(const CLI::App& app, const CLI::Error& error);

/// "Run 'oriel rules check --help' for more information.", of the command that was reached.
std::string pointer_to_help(const CLI::App& app);

}  // namespace oriel::cli
