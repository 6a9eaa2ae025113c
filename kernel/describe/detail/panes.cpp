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
  for (const Polygon& polygon : building.polygons) {
    if (polygon.source < 0 || polygon.rings.empty()) continue;
    if (std::ssize(panes_) <= polygon.source) panes_.resize(at(polygon.source) + 1);
    panes_[at(polygon.source)].polygon = &polygon;
  }
}

std::optional<double> Panes::level_in(const Feature& feature, const Plane& plane) const {
  std::vector<ParallelArea> parallel;
  for (const int source : feature.source_polygons) {
    Pane& pane = panes_[at(source)];
    if (!pane.is_measured) measure(pane);
    const double across_m2 = std::abs(dot(pane.area, plane.normal));
    if (across_m2 > std::sqrt(0.5) * length(pane.area))  // by 45 degrees or less
      parallel.push_back({dot(pane.middle, plane.normal) - plane.offset_m, across_m2});
  }
  return visible_level(std::move(parallel), feature.new_area_m2);
}

void Panes::measure(Pane& pane) const {
  pane.is_measured = true;
  if (pane.polygon == nullptr) return;
  for (const auto& ring : pane.polygon->rings) {
    take_outline(ring);
    const bool is_outer = &ring == &pane.polygon->rings[0];
    const double share = 1.0 / static_cast<double>(outline_.size());
    Vec3 before;
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      const Vec3 here = outline_[i] - outline_[0];
      if (i > 1) pane.area = pane.area + 0.5 * cross(before, here);
      before = here;
      if (is_outer) pane.middle = pane.middle + share * outline_[i];
    }
  }
}

/// The corners of a ring from the least one on.
void Panes::take_outline(const std::vector<int>& ring) const {
  const auto corner = [&](int v) { return corners_[at(v)]; };
  const auto least = std::ranges::min_element(ring, is_lesser, corner);
  outline_.clear();
  for (auto v = least; v != ring.end(); ++v) outline_.push_back(corner(*v));
  for (auto v = ring.begin(); v != least; ++v) outline_.push_back(corner(*v));
}

}  // namespace oriel::detail
