#pragma once

#include "kernel/base/issue.h"
#include "kernel/model/labelled_building.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace oriel::cli {

/// What a record adds to: the file of buildings (-o), --features, the listing on stdout, --explain,
/// --metrics.
enum class Part { buildings, features, listing, deeds, figures };
inline constexpr std::size_t kParts = 5;

/// What a record adds to the outputs of a command.
struct Product {
  /// The bytes for each Part; empty: nothing.
  std::array<std::string, kParts> bytes;
  /// In place of bytes for buildings, of outputs that are written when all records are there (OBJ,
  /// OFF, STL).
  std::vector<LabelledBuilding> labelled{};
  /// To be told behind those of the buildings; an error says that a building was set aside.
  std::vector<Issue> issues{};
  /// Counts of the command, to be added to its own.
  std::map<std::string, int> counts{};

  std::string& operator[](Part part) { return bytes[static_cast<std::size_t>(part)]; }
  const std::string& operator[](Part part) const { return bytes[static_cast<std::size_t>(part)]; }
};

/// What came of one building on the line, for the books.
struct BuildingOutcome {
  bool is_passed_over = false;
  /// It came as far as the command asks for.
  bool is_done = false;
  bool is_open = false;
  std::map<std::string, int> labels{};  ///< features, by label ("" = unknown)
  std::vector<Issue> issues{};
};

/// What came of a record that could be read.
struct RecordOutcome {
  std::vector<BuildingOutcome> buildings{};  ///< in their order
  Product product{};
};

}  // namespace oriel::cli
