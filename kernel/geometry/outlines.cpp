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

std::vector<Outline> outlines_of(std::span<const Vertex> vertices, const std::vector<Loop>& loops) {
  std::vector<Outline> outlines;
  outlines.reserve(loops.size());
  for (const Loop& loop : loops) {
    Outline& outline = outlines.emplace_back();
    outline.reserve(loop.size());
    for (const int v : loop) outline.push_back(vertices[static_cast<std::size_t>(v)].point);
  }
  return outlines;
}

}  // namespace oriel::detail
