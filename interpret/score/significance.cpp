#include "interpret/score/significance.h"

#include "model/tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace oriel {

namespace {

constexpr std::array kNames{"keep", "point", "line", "small", "sheet"};
constexpr std::array kPlaceNames{"lamina", "cap", "fin", "enclosed"};

/// The value whose name `text` is.
template <class Value, class Names>
std::optional<Value> value_of(const std::string& text, const Names& names) {
  const auto found = std::ranges::find(names, text);
  if (found == names.end()) return std::nullopt;
  return static_cast<Value>(found - names.begin());
}

}  // namespace

Thresholds map_thresholds(double map_mm, double scale) {
  const double a_m = map_mm / 1000 * scale;
  const double b_m = a_m / 2;
  return {a_m, b_m, a_m / 4, a_m * std::sqrt(a_m * b_m)};
}

Significance significance(double a_m, double b_m, double c_m, const Thresholds& thresholds) {
  if (c_m > thresholds.c_m) return Significance::keep;
  if (a_m < thresholds.a_m) return Significance::point;
  if (b_m < thresholds.b_m) return Significance::line;
  if (a_m * b_m < thresholds.area_m2) return Significance::small;
  return Significance::sheet;
}

SheetPlace sheet_place(const FeatureTable& table, FeatureId id, double c_m) {
  const auto depth_m = table.number(id, Attribute::depth),
             inclination_deg = table.number(id, Attribute::inclination);
  if (!depth_m || !inclination_deg) return SheetPlace::enclosed;
  const auto growth_m = [&](Attribute growth) { return table.number(id, growth).value_or(0); };
  double beside_m = growth_m(Attribute::growth_side);
  if (std::abs(std::cos(*inclination_deg * std::numbers::pi / 180)) <= kWallLean)
    beside_m =
        std::max({beside_m, growth_m(Attribute::growth_up), growth_m(Attribute::growth_down)});
  if (*depth_m <= c_m) return beside_m > c_m ? SheetPlace::cap : SheetPlace::lamina;
  const bool sticks_out = std::max(growth_m(Attribute::growth_out), beside_m) > c_m;
  return sticks_out ? SheetPlace::fin : SheetPlace::enclosed;
}

std::string to_string(Significance significance) {
  return kNames.at(static_cast<std::size_t>(significance));
}

std::string to_string(SheetPlace place) { return kPlaceNames.at(static_cast<std::size_t>(place)); }

std::optional<Significance> significance_of(const std::string& text) {
  return value_of<Significance>(text, kNames);
}

std::optional<SheetPlace> sheet_place_of(const std::string& text) {
  return value_of<SheetPlace>(text, kPlaceNames);
}

bool is_verdict_of_size(const std::string& text) {
  return significance_of(text).has_value() || sheet_place_of(text).has_value();
}

}  // namespace oriel
