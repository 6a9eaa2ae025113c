#include "kernel/geometry/outlines.h"

#include "kernel/geometry/exact.h"

namespace oriel::detail {

std::vector<Outline> outlines_of(const Building& building, const Polygon& polygon, double grid_m) {
  std::vector<Outline> outlines;
  outlines.reserve(polygon.rings.size());
  for (const auto& ring : polygon.rings) {
    Outline& outline = outlines.emplace_back();
    outline.reserve(ring.size());
    for (const int v : ring)
      outline.push_back(exact::on_grid(building.vertices[static_cast<std::size_t>(v)], grid_m));
  }
  return outlines;
}

}  // namespace oriel::detail
