#pragma once

#include <algorithm>
#include <optional>

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

}  // namespace oriel
