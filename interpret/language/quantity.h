#pragma once

#include "model/description/feature_table.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// What kind of number a number is: metres to a power, degrees to a power. Both 0: a ratio or a
/// count.
struct Dimension {
  int metre = 0;
  int degree = 0;
  friend constexpr bool operator==(Dimension, Dimension) = default;
  [[nodiscard]] constexpr bool is_plain() const { return metre == 0 && degree == 0; }
};

constexpr Dimension product(Dimension p, Dimension q) {
  return {p.metre + q.metre, p.degree + q.degree};
}
constexpr Dimension quotient(Dimension p, Dimension q) {
  return {p.metre - q.metre, p.degree - q.degree};
}

/// A unit that may follow a number in a pack: number × factor is in metres, degrees or 1.
struct UnitWord {
  std::string_view name;
  Dimension dimension;
  double factor = 1;
};

/// The unit called `name`, or nothing. `mm@map` is none of them: its size depends on the scale.
std::optional<UnitWord> unit_word(std::string_view name);
const std::vector<std::string>& unit_names();

/// The text of a number without a unit, such as `0.8`.
bool is_without_unit(std::string_view text);

Dimension dimension_of(Unit unit);

/// "m", "m2", "m3", "deg", "" for plain numbers, else such as "m4".
std::string unit_of(Dimension dimension);

/// "a length", "an area", "a plain number", …
std::string describe(Dimension dimension);

/// "0.61 m": the least of 2 to 4 decimals that shows `value` apart from `other` where they differ
/// by as much as that shows; more of a number that is small itself ("0.005 m"); whole numbers of no
/// dimension without decimals.
std::string write(double value, Dimension dimension);
std::string write(double value, Dimension dimension, double other);
/// Both are written alike, though they may differ by rounding.
bool looks_equal(double value, double other);
/// "0.01 m"; "less than 0.0001 m" of what four decimals do not show.
std::string write_distance(double distance, Dimension dimension);
/// "10 %", "33.3 %"; with more digits where it differs from `other` and three would not show it.
std::string write_percent(double share, double other);

}  // namespace oriel::rules
