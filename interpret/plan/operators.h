#pragma once

#include <string>
#include <vector>

namespace oriel {

/// An argument that an operator takes in a pack: `do: {enlarge: {to: 0.5 mm@map, anchor: sill}}`.
struct OperatorArgument {
  std::string name;
  /// "length", "ratio" or "word".
  std::string kind;
  std::string meaning;
  /// The words that it may be.
  std::vector<std::string> words{};
};

/// What a pack may ask for under `do:`.
struct OperatorKind {
  std::string name;
  std::string meaning;
  std::vector<OperatorArgument> arguments;
};

/// All operators by name.
const std::vector<OperatorKind>& operator_table();

}  // namespace oriel
