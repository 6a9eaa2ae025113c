#pragma once

#include "kernel/base/issue.h"
#include "model/vec3.h"

#include <optional>
#include <string>

namespace oriel {

/// What somebody says that a feature is.
struct Correction {
  std::string building;
  /// Its id; empty: whatever is at the point.
  std::string feature;
  /// In the input's coordinates, in metres: on the feature, or in its box.
  std::optional<Vec3> point;
  /// Empty: it is nothing that the rules should name.
  std::string label;
  /// Who says so and why; may be empty.
  std::string by;
  std::string why;
  /// File and line.
  Place place;
};

}  // namespace oriel
