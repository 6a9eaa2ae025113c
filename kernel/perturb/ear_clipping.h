#pragma once

#include "kernel/base/random.h"

#include <array>
#include <cstdint>
#include <vector>

namespace oriel::detail {

/// A corner of a polygon as seen from the front, in whole units; |u|, |v| < 2^60.
struct FlatCorner {
  std::int64_t u = 0, v = 0;
};

/// Cuts a polygon with holes into triangles without new corners, in a random way: ears are clipped
/// in random order. `rings` index `corners`: the outer ring, counter-clockwise, then the holes,
/// clockwise. Triangles are counter-clockwise, and corners + 2 × holes − 2 of them. Fewer where a
/// hole sees no corner of the outer ring. Where rings cross there may be none, or one that is not
/// counter-clockwise.
///
/// Source: Eberly, Triangulation by Ear Clipping. Exact.
std::vector<std::array<int, 3>> clip_ears(const std::vector<FlatCorner>& corners,
                                          const std::vector<std::vector<int>>& rings,
                                          Random& random);

/// False for three corners in a line, too.
bool is_counter_clockwise(const std::vector<FlatCorner>& corners,
                          const std::array<int, 3>& triangle);

}  // namespace oriel::detail
