#pragma once

#include "kernel/describe/describe.h"
#include "tests/support/segmented.h"

#include <algorithm>
#include <map>
#include <string>

namespace oriel::test {

/// A building all the way to what is known of its features.
struct Described {
  Segmented segmented;
  Description description;

  [[nodiscard]] const FeatureTable& table() const { return description.table; }
  [[nodiscard]] const FeatureGraph& graph() const { return description.graph; }
  /// The feature with this box; the test ends if there is none.
  [[nodiscard]] FeatureId at(Vec3 min, Vec3 max) const {
    const FeatureId id = feature_in(segmented.segmentation, min, max);
    REQUIRE(id.is_valid());
    return id;
  }
  /// A number; the test ends if it is missing.
  [[nodiscard]] double number(FeatureId id, const std::string& name) const {
    const auto value = table().number(id, find_attribute(name).value());
    CAPTURE(name);
    REQUIRE(value.has_value());
    return *value;
  }
  [[nodiscard]] bool has(FeatureId id, const std::string& name) const {
    return table().number(id, find_attribute(name).value()).has_value();
  }
};

inline Described described(Building building, const SegmentOptions& options = {}) {
  Described out{test::segmented(std::move(building), options), {}};
  out.description = describe(out.segmented.building, out.segmented.segmentation);
  return out;
}

/// Whether a relation holds from self to other.
inline bool holds(const Described& d, const std::string& name, FeatureId self, FeatureId other) {
  const auto others = d.graph().others(name, self);
  return std::ranges::find(others, other) != others.end();
}

/// Compares several numbers of a feature, each to a tenth of a millimetre or so.
inline void check_numbers(const Described& d, FeatureId id,
                          const std::map<std::string, double>& expected) {
  for (const auto& [name, value] : expected) {
    CAPTURE(name);
    const auto found = d.table().number(id, find_attribute(name).value());
    REQUIRE(found.has_value());
    CHECK(std::abs(*found - value) < 1e-4);
  }
}

}  // namespace oriel::test
