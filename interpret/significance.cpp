#include "interpret/significance.h"

#include <array>
#include <cmath>

namespace oriel {

namespace {

constexpr std::array kNames{"keep", "point", "line", "small", "sheet"};

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

std::string to_string(Significance significance) {
  return kNames.at(static_cast<std::size_t>(significance));
}

std::optional<Significance> significance_of(const std::string& text) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (text == kNames.at(i)) return static_cast<Significance>(i);
  return std::nullopt;
}

}  // namespace oriel
