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
  /// The format of buildings: "cityjson", "citygml" (2.0) or "citygml3".
  std::string format = "cityjson";
  /// A folder, a .city.jsonl or .gml file, or "-".
  std::string output;
  /// The id of the house; of several, before their number.
  std::string name = "house";
  /// Of a file of all houses: labelled ones instead of stripped ones, and where its truths go
  /// (empty: nowhere).
  bool is_labelled = false;
  std::string truth;

  /// True if all houses go into one CityGML file.
  [[nodiscard]] bool is_gml_file() const { return output.ends_with(".gml"); }
};

/// Fills `arguments` from the command line. Where the program shall end instead (help, wrong
/// arguments), prints why and returns the exit code.
std::optional<int> read_arguments(int argc, const char* const* argv, Arguments& arguments,
                                  std::ostream& out, std::ostream& err);

}  // namespace oriel::generator
