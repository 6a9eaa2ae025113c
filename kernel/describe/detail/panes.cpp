#include "kernel/describe/detail/panes.h"

#include "kernel/geometry/exact.h"
#include "kernel/geometry/visible_level.h"
#include "kernel/model/detail/index.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oriel::detail {

Panes::Panes(const Building& building, double grid_m) {
  corners_.reserve(building.vertices.size());
  for (const Vec3 vertex : building.vertices) corners_.push_back(exact::on_grid(vertex, grid_m));
  Outline outline;
  for (const Polygon& polygon : building.polygons) {
    if (polygon.source < 0 || polygon.rings.empty()) continue;
    if (std::ssize(panes_) <= polygon.source) panes_.resize(at(polygon.source) + 1);
    Pane& pane = panes_[at(polygon.source)];
    for (const auto& ring : polygon.rings) {
      take_outline(ring, outline);
      for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        pane.area = pane.area + 0.5 * cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
      if (&ring != &polygon.rings[0]) continue;
      const double share = 1.0 / static_cast<double>(outline.size());
      for (const Vec3 p : outline) pane.middle = pane.middle + share * p;
    }
  }
}

std::optional<double> Panes::level_in(const Feature& feature, const Plane& plane) const {
  std::vector<ParallelArea> parallel;
  for (const int source : feature.source_polygons) {
    const Pane& pane = panes_[at(source)];
    const double across_m2 = std::abs(dot(pane.area, plane.normal));
    if (across_m2 > std::sqrt(0.5) * length(pane.area))  // by 45 degrees or less
      parallel.push_back({dot(pane.middle, plane.normal) - plane.offset_m, across_m2});
  }
  return visible_level(std::move(parallel), feature.new_area_m2);
}

/// The corners of a ring from the least one on.
void Panes::take_outline(const std::vector<int>& ring, Outline& outline) const {
  outline.clear();
  for (const int v : ring) outline.push_back(corners_[at(v)]);
  start_at_least(outline);
}

}  // namespace oriel::detail
