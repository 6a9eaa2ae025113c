#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace oriel::cli {

/// What is said of arguments that the parse left over: a command or an option that there is not,
/// with the one that was probably meant. Nothing if there are none.
std::string usage_advice(const CLI::App& app);

}  // namespace oriel::cli
