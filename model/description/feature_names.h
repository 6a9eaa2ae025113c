#pragma once

#include "kernel/base/ids.h"
#include "model/description/feature_table.h"
#include "model/interpretation.h"
#include "model/segmentation.h"
#include "model/vec3.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// What the name of a feature is made of.
struct NameParts {
  /// Content-based; settles the order of features in the same place.
  std::string_view id;
  /// Empty: it is called "part".
  std::string_view label;
  /// The row of the feature that it stands on; invalid: the body.
  FeatureId host;
  std::optional<double> host_inclination_deg;
  std::optional<double> azimuth_deg;
  /// A hole or an imprint in a steep facet: it has the attribute `storey`.
  bool is_opening = false;
  /// In metres; x to the east, y to the north, z up, from any origin.
  Box box;
};

/// A name for each feature of a building that a person would use, by row: "window 3 of facade
/// south, storey 2", "chimney 1 of roof slope north", "part 1 of window 2 of facade east,
/// storey 1".
///
/// 1. It says the label, or "part", a number from 1, and the place. No two features of a building
///    have the same name, provided that ids differ and that labels hold no spaces.
/// 2. The place is the nearest feature with a label among its host, the host's host and so on, by
///    that one's name; names within names end after kMostPlaces, then an outer one counts.
/// 3. Without such a feature it is "facade SIDE" of a wall, "roof slope SIDE" or "the flat roof" of
///    what looks up, "the underside" of what looks down, and "the inside" without a host's facet.
///    SIDE is one of eight directions; all walls that look there are one facade, as in an elevation
///    drawing.
/// 4. A facade has storeys, counted from 1 at the bottom, of the whole building. They are found by
///    its openings of up to 3 m with a label that stand on a facade, without such by all: from the
///    lowest middle up an opening belongs to the storey whose openings reach over its middle. What
///    else is on a facade has the storey that its middle is nearest to. Without openings there are
///    none, and what reaches from one storey into another has none.
/// 5. Numbers go from left to right as seen from outside, then from the ground up, then from the
///    front to the back; in what looks up, down or inside from west to east, then from south to
///    north.
/// It depends on nothing but these values: not on the order of the features, polygons or threads,
/// nor on where the origin is. Positions that differ by less than 5 mm count as the same.
std::vector<std::string> feature_names(std::span<const NameParts> features);
inline constexpr int kMostPlaces = 3;

/// The same of a building that was described, with the labels of `interpretation` or, if it is
/// null, without.
std::vector<std::string> feature_names(const Segmentation& segmentation, const FeatureTable& table,
                                       const Interpretation* interpretation);

/// The rows of the names that `text` means: the one that it is, else those that begin with it as
/// whole words. Case, commas and the number of spaces do not count.
std::vector<std::size_t> find_names(std::span<const std::string> names, std::string_view text);

/// The names that `text` may be meant for, the nearest first, each once: those whose first words,
/// as many as it has, are the fewest edits away (edit_distance()).
std::vector<std::string> nearest_names(std::span<const std::string> names, std::string_view text,
                                       std::size_t most);

}  // namespace oriel
