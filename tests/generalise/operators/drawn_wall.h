#pragma once

#include "generalise/generalise.h"
#include "kernel/base/index.h"
#include "tests/generalise/line.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace oriel::test {

/// What a plan makes of a building; it must be closed.
inline Generalised carried(const Line& line, const Plan& plan) {
  auto out = generalise(line.context(), plan);
  REQUIRE(out.value);
  CHECK(is_closed(out.value->solid));
  return std::move(*out.value);
}

/// The outlines of what is sunk in or drawn in the front wall (y = 0) and does not reach its edges,
/// from left to right and upwards.
inline std::vector<Box> openings_in_front(const Solid& solid) {
  std::vector<Box> boxes;
  for (const Facet& facet : solid.facets) {
    const Plane& plane = solid.planes[facet.plane.index()];
    if (plane.normal.y > -0.99 || std::abs(plane.offset_m) > 1e-9) continue;
    for (std::size_t loop = 1; loop < facet.loops.size(); ++loop) {
      Box box;
      for (const int v : facet.loops[loop]) box.grow(solid.vertices[at(v)].point);
      boxes.push_back(box);
    }
  }
  std::ranges::sort(boxes, {}, [](const Box& box) { return std::pair(box.min.x, box.min.z); });
  return boxes;
}

}  // namespace oriel::test
