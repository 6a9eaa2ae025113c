#pragma once

#include "examples/generator/options.h"

#include <iosfwd>
#include <optional>
#include <string>

namespace oriel::generator {

/// What the command line asks for.
struct Arguments {
  Options options;
  int count = 1;
  /// A folder, a .city.jsonl file, or "-".
  std::string output;
  /// The id of the house; of several, before their number.
  std::string name = "house";
  /// Of a stream: labelled features instead of stripped ones, and where its truths go (empty:
  /// nowhere).
  bool is_labelled = false;
  std::string truth;
};

/// Fills `arguments` from the command line. Where the program shall end instead (help, wrong
/// arguments), prints why and returns the exit code.
std::optional<int> read_arguments(int argc, const char* const* argv, Arguments& arguments,
                                  std::ostream& out, std::ostream& err);

}  // namespace oriel::generator
