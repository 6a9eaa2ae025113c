#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace oriel {

/// A point with whole coordinates in some unit: one of one unit is not taken for one of another.
/// Points order by x, then y, then z.
template <class Unit>
struct WholePoint {
  std::array<std::int64_t, 3> coordinates{};

  constexpr std::int64_t& operator[](std::size_t axis) { return coordinates[axis]; }
  constexpr const std::int64_t& operator[](std::size_t axis) const { return coordinates[axis]; }
  [[nodiscard]] constexpr auto begin() { return coordinates.begin(); }
  [[nodiscard]] constexpr auto end() { return coordinates.end(); }
  [[nodiscard]] constexpr auto begin() const { return coordinates.begin(); }
  [[nodiscard]] constexpr auto end() const { return coordinates.end(); }
  [[nodiscard]] static constexpr std::size_t size() { return 3; }
  friend constexpr auto operator<=>(const WholePoint&, const WholePoint&) = default;
};

/// A vertex as a file has it, in whole micrometres: of the input's coordinates, or of a building's
/// frame.
using MicrometrePoint = WholePoint<struct Micrometres>;

}  // namespace oriel
