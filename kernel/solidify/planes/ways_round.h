#pragma once

#include "kernel/solidify/soup/soup.h"

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace oriel::detail {

/// A polygon is so thin that it came to its plane although it is at more than 45 degrees to it:
/// `cosine` is that between the two normals.
inline bool is_standing(double cosine) { return std::abs(cosine) < std::numbers::sqrt2 / 2; }

/// Which way round polygons lie on their planes.
struct WaysRound {
  /// By polygon: the plane's normal is to be turned for it.
  std::vector<char> is_turned;
  /// So many stand across their planes.
  int standing = 0;
};

/// What stands across its plane goes with the neighbours on the same plane that it shares most of
/// its outline with. `cosines`: by polygon, between its normal and its plane's; `planes`: by
/// polygon, the number of its plane, of which the way round is asked.
WaysRound ways_round(const Soup& soup, std::span<const double> cosines,
                     std::span<const int> planes);

}  // namespace oriel::detail
