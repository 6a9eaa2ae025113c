#pragma once

#include "kernel/base/ids.h"
#include "kernel/base/issue.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// By how much generalising may change a building; what is missing may change by any amount. Packs
/// and profiles say so (`invariants:`).
struct Limits {
  /// In percent of what it was.
  std::optional<double> footprint_pct{}, volume_pct{};
  /// How much of the footprint, in percent, may hang in the air that did not. If given, the box of
  /// the building must not grow either, by more than a centimetre.
  std::optional<double> overhang_pct{};
  /// In percent of what it was, of the area of walls that stand against other buildings.
  std::optional<double> party_walls_pct{};
  /// In metres: of the highest point, chimneys included; of the main ridge; of the main eaves.
  std::optional<double> top_m{}, ridge_m{}, eaves_m{};

  friend bool operator==(const Limits&, const Limits&) = default;
};

/// What keeps to both.
inline Limits stricter(const Limits& one, const Limits& other) {
  const auto least = [](std::optional<double> a, std::optional<double> b) {
    if (!a || !b) return a ? a : b;
    return std::optional(std::min(*a, *b));
  };
  return {least(one.footprint_pct, other.footprint_pct),
          least(one.volume_pct, other.volume_pct),
          least(one.overhang_pct, other.overhang_pct),
          least(one.party_walls_pct, other.party_walls_pct),
          least(one.top_m, other.top_m),
          least(one.ridge_m, other.ridge_m),
          least(one.eaves_m, other.eaves_m)};
}

/// On the map, the least size that can be seen, and the least distance: the profile `map`'s d and
/// c. What operators go by where the pack does not say `to` or `gap`.
inline constexpr double kToOnMap_m = 0.0005;
inline constexpr double kGapOnMap_m = 0.000125;

/// What becomes of what belongs to a feature that is drawn elsewhere or larger: it goes away; it
/// keeps its distances from the feature's edges; besides, it becomes as much longer as the edge
/// that it lies along.
enum class Belonging { goes, moves, grows };

/// What belongs to features, both ascending.
using BelongingOf = std::map<FeatureId, std::vector<FeatureId>>;

/// One decision: what is to be done to one feature at a target scale, and because of what.
struct Step {
  FeatureId feature;
  /// The operator's name ("omit").
  std::string operation;
  /// Id of the pack's entry that asked for it, or of a profile's verdict ("lod:2.0/point").
  std::string rule;
  /// The operator's arguments: lengths in metres and ratios.
  std::map<std::string, double> numbers{};
  std::map<std::string, std::string> words{};
  /// Id of the group of the pack that the entry is for; empty: it is for single features.
  std::string group{};
  /// The openings of the building, ascending, which steps of a plan share: those that no step is
  /// for make room for what an operator enlarges. Null: nothing does.
  std::shared_ptr<const std::vector<FeatureId>> openings{};
  /// What goes along if the feature leaves its place, without a step of its own but `omit`.
  /// Ascending.
  std::vector<FeatureId> with{};
  /// What becomes of what goes along when an operator draws the feature again.
  Belonging belonging = Belonging::goes;
  /// Those of `with` that are drawn again beside it, unless `belonging` is `goes`: they have no
  /// step of their own. Ascending.
  std::vector<FeatureId> follows{};
  /// What belongs to the openings that the step may push aside, which steps of an entry share;
  /// null: nothing follows them.
  std::shared_ptr<const BelongingOf> follows_pushed{};
};

/// The decisions for one building at one scale, in feature order; at most one step a feature.
struct Plan {
  /// The target scale 1 : scale; 0 where a level of detail is the target.
  double scale = 0;
  std::vector<Step> steps;
  std::vector<Issue> issues;
};

}  // namespace oriel
