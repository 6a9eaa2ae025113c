#pragma once

#include "kernel/base/issue.h"
#include "kernel/model/vec3.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// What somebody says that a feature is (a line of `corrections.jsonl`).
struct Correction {
  std::string building;
  /// Its id; empty: whatever is at the point.
  std::string feature;
  /// In the input's coordinates, in metres: on the feature, or in its box.
  std::optional<Vec3> point;
  /// The member "class"; empty ("unknown" in the file): it is nothing that the rules should name.
  std::string label;
  /// Who says so and why; may be empty.
  std::string by;
  std::string why;
  /// File and line.
  Place place;
};

/// Reads a file of corrections, a JSON object a line; empty lines are passed over. A line that is
/// no correction is left out and named: E152, or E103 to E105, E503, E504 if it is not JSON. Throws
/// InputError E101 if the file cannot be read.
Checked<std::vector<Correction>> read_corrections(const std::string& path);

}  // namespace oriel
