#pragma once

#include "examples/generator/generate.h"

#include <cstddef>
#include <vector>

/// What tests of every style measure of generated bodies.
namespace oriel::generator {

/// Per object, the box of its polygons.
inline std::vector<Extent> boxes_of(const Body& body) {
  std::vector<Extent> boxes(body.objects.size());
  for (const Polygon& polygon : body.polygons)
    for (const int vertex : polygon.rings[0])
      boxes[static_cast<std::size_t>(polygon.owner.object)].grow(
          body.vertices[static_cast<std::size_t>(vertex)]);
  return boxes;
}

struct OpeningCounts {
  int all = 0, flush = 0;
};

/// The openings of the first houses of these options.
inline OpeningCounts count_openings(const Options& options, int houses) {
  OpeningCounts counts;
  for (int i = 0; i < houses; ++i)
    for (const Object& object : generate(options, i).objects) {
      if (!object.recess) continue;
      ++counts.all;
      if (*object.recess == 0) ++counts.flush;
    }
  return counts;
}

}  // namespace oriel::generator
