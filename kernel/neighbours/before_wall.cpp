#include "kernel/neighbours/before_wall.h"

#include <algorithm>

namespace oriel::detail {

bool is_on_ground(std::span<const std::vector<Outline>> pieces, Vec3 point) {
  return std::ranges::any_of(pieces, [&](const auto& piece) {
    return contains(piece, Vec3{0, 0, 1}, point);
  });
}

std::optional<double> first_crossing_m(std::span<const std::vector<Outline>> pieces, Vec3 from,
                                       Vec3 along, double reach_m) {
  std::optional<double> first;
  for (const auto& piece : pieces)
    for (const Outline& outline : piece)
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3 a = outline[i] - from, b = outline[(i + 1) % outline.size()] - from;
        const double of_a = along.x * a.y - along.y * a.x, of_b = along.x * b.y - along.y * b.x;
        if ((of_a > 0) == (of_b > 0)) continue;
        const double share = of_a / (of_a - of_b);
        const double at_m = dot(along, a) + share * (dot(along, b) - dot(along, a));
        if (at_m > 0 && at_m <= reach_m && (!first || at_m < *first)) first = at_m;
      }
  return first;
}

}  // namespace oriel::detail
