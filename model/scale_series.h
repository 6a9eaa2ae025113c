#pragma once

#include "model/labelled_building.h"
#include "model/vec3.h"
#include "model/whole_point.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel {

/// A point in metres.
inline Vec3 metres_of(const MicrometrePoint& point) {
  constexpr double kMicrometre_m = 1e-6;
  return kMicrometre_m * Vec3{static_cast<double>(point[0]), static_cast<double>(point[1]),
                              static_cast<double>(point[2])};
}
/// A closed ring that starts at its smallest point.
using MicrometreRing = std::vector<MicrometrePoint>;

/// A facet of a level and what it is.
struct LevelFacet {
  /// Inner rings, sorted.
  std::vector<MicrometreRing> holes;
  /// The semantic surface: its type and label. Facets with the same FeatureLabel::id are one.
  std::string type;
  SharedLabel label;
  /// The installations that have it, sorted.
  std::vector<std::string> installations;
  /// The input polygons it is made of; neither compared nor written.
  std::vector<int> polygons;

  friend bool operator==(const LevelFacet& a, const LevelFacet& b) {
    return a.holes == b.holes && a.type == b.type && a.label == b.label &&
           a.installations == b.installations;
  }
};

/// Attributes of a building that belong to its state: the counts `oriel_removed_…`, and of
/// buildings that became one `oriel_members` (of the block) or `oriel_member_of` and
/// `oriel_member_lod` (of the others, which have no facets).
inline bool is_of_state(std::string_view attribute) {
  return attribute.starts_with("oriel_removed_") || attribute.starts_with("oriel_member");
}

/// A value as CityJSON writes it: a whole double is an integer.
inline MemberValue as_written(const MemberValue& value) {
  constexpr double kLargestExact = 9007199254740992;  // 2^53
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr || std::abs(*number) >= kLargestExact || *number != std::floor(*number))
    return value;
  return static_cast<std::int64_t>(*number);
}

/// A building at one level of a series, as its file has it.
struct LevelState {
  std::string building;
  /// By outer ring, of which no two are the same. None: the building is part of another one's
  /// block.
  std::map<MicrometreRing, LevelFacet> facets;
  /// The labels of installations, by id.
  std::map<std::string, SharedLabel> installations;
  /// Those that is_of_state().
  std::map<std::string, MemberValue> attributes;

  friend bool operator==(const LevelState&, const LevelState&) = default;
};

/// A step from one state to another. It fits a state that has all that it takes away.
struct Change {
  /// The holes that a facet loses and gains; its outer ring stays.
  struct Holes {
    std::vector<MicrometreRing> removed, added;
  };
  std::vector<std::pair<MicrometreRing, LevelFacet>> removed, added;
  std::map<MicrometreRing, Holes> holes;
  /// What there is afterwards; nothing: it is gone.
  std::map<std::string, std::optional<SharedLabel>> installations;
  std::map<std::string, std::optional<MemberValue>> attributes;
};

/// One elementary operation of a series.
struct SeriesOperation {
  std::string building;
  /// The level of detail whose geometry it changes; empty: the highest.
  std::string lod;
  std::string oriel_id;  ///< of the feature
  std::string label;     ///< empty: unknown
  std::string operation;
  std::string rule;
  /// It has happened at all 1:N with N of at least this.
  double scale = 0;
  /// Of all that changes, in the input's coordinates.
  Box aabb_m;
  /// Features that changed or went with it.
  std::vector<std::string> with;
  /// Those of them that were to move or grow with it and went instead, each with the reason.
  std::map<std::string, std::string> could_not_follow{};
  Change forward, inverse;
};

/// A building from fine to coarse: the state at a scale is the finest one with all operations
/// applied whose scale is no larger.
struct ScaleSeries {
  LevelState finest;
  /// In the order in which they happen: ascending scale, what is nested before what carries it.
  std::vector<SeriesOperation> operations;
};

}  // namespace oriel
