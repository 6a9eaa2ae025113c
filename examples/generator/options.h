#pragma once

#include "examples/generator/addition.h"
#include "examples/generator/house/house.h"

#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::generator {

/// What a house may have. The first ones are classes of the truth, then finer kinds of them, then
/// decor (class "other"), then parts of the bare house.
enum class Feature {
  window,
  door,
  chimney,
  vent,
  dormer,
  balcony,
  loggia,
  bay,
  canopy,
  stairs,
  garage,
  roof_window,
  gable_window,
  cellar_window,
  french_window,
  shop,
  strip,
  panes,
  sill,
  shutter,
  pilaster,
  cornice,
  plinth,
  parapet,
  overhang,
  wing,
};
inline constexpr std::size_t kFeatures = 26;

std::string_view name_of(Feature feature);
/// The feature of that name; nothing if there is none.
std::optional<Feature> feature_named(std::string_view name);

class FeatureSet {
 public:
  void add(Feature feature) { bits_.set(static_cast<std::size_t>(feature)); }
  [[nodiscard]] bool has(Feature feature) const {
    return bits_.test(static_cast<std::size_t>(feature));
  }

 private:
  std::bitset<kFeatures> bits_;
};

/// Where on its roof a chimney stands: on one plane, across the ridge, or over the end of the ridge
/// where hips meet.
enum class ChimneyPlace { slope, ridge, apex };

/// Whose houses: single ones as the options describe them; rows, pairs and blocks of English brick
/// houses, which draw all their sizes and features themselves; or those of a city, single houses,
/// terraces and blocks whose neighbours share walls (city/city_house.h), which do so, too.
enum class Style { continental, english, city };
std::string_view name_of(Style style);

template <class T>
struct Range {
  T low{}, high{};
};

/// What is asked of the generator. The same options give the same bytes; house i depends on the
/// seed and i, not on the count.
struct Options {
  std::uint64_t seed = 1;
  /// English houses and those of a city follow flush, jitter and what is applied to the finished
  /// body, and ignore the other options below.
  Style style = Style::continental;
  /// Nothing: each house draws its own.
  std::optional<RoofKind> roof;
  /// 1 … 8.
  Range<int> storeys{1, 4};
  /// Rounded to 2 cm. The longer one becomes the width, along the ridge.
  Range<Um> width{8'000'000, 18'000'000}, depth{7'000'000, 12'000'000};
  /// Features every house shall have where there is room; nothing: each house draws its own.
  std::optional<FeatureSet> features;
  /// Where chimneys stand; roofs without such a place get none. Nothing: each is drawn.
  std::optional<ChimneyPlace> chimney;
  /// Share of windows and doors that are flush with their wall, 0 … 1.
  double flush = 0;
  /// How far windows may be moved, and each of their sides again.
  Um jitter = 0;
  /// What every house gets besides, at its place or where there is room.
  std::vector<Addition> additions;
  /// About so many windows; 0 = as they come. Sets width, depth and, unless `has_storeys`, storeys;
  /// unless `features` says otherwise there are but windows, a door and a chimney.
  int windows = 0;
  bool has_storeys = false;

  /// Applied to the finished body.
  double rotate_deg = 0;
  /// Every coordinate is moved by at most this.
  Um noise = 0;
  bool triangulate = false;
  /// Position of the first house, metres; further ones stand in rows beside it, those of a city
  /// where its plan has them.
  Point origin;
};

}  // namespace oriel::generator
