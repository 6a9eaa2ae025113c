#include "kernel/describe/features/parallel_polygons.h"

#include "kernel/base/index.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

ParallelPolygons::ParallelPolygons(const Building& building, double grid_m) {
  corners_.reserve(building.vertices.size());
  for (const Vec3& vertex : building.vertices) corners_.push_back(exact::on_grid(vertex, grid_m));
  polygons_.reserve(building.polygons.size());
  for (const Polygon& polygon : building.polygons) {
    if (polygon.source < 0 || polygon.rings.empty()) continue;
    if (std::ssize(polygons_) <= polygon.source) polygons_.resize(at(polygon.source) + 1);
    polygons_[at(polygon.source)].polygon = &polygon;
  }
}

std::optional<double> ParallelPolygons::level_in(const Feature& feature, const Plane& plane) const {
  boost::container::small_vector<ParallelArea, 16> parallel;  // few have more
  for (const int source : feature.source_polygons) {
    ParallelPolygon& polygon = polygons_[at(source)];
    if (!polygon.is_measured) measure(polygon);
    const double across_m2 = std::abs(dot(polygon.area, plane.normal));
    if (across_m2 > std::sqrt(0.5) * length(polygon.area))  // by 45 degrees or less
      parallel.push_back({dot(polygon.middle, plane.normal) - plane.offset_m, across_m2});
  }
  return visible_level({parallel.data(), parallel.size()}, feature.new_area_m2);
}

/// From the least corner on, so that it does not depend on where a ring begins.
void ParallelPolygons::measure(ParallelPolygon& polygon) const {
  polygon.is_measured = true;
  if (polygon.polygon == nullptr) return;
  const auto& rings = polygon.polygon->rings;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const auto& ring = rings[r];
    const std::size_t size = ring.size();
    const double share = 1.0 / static_cast<double>(size);
    std::size_t corner = least_of(ring);
    Vec3 origin, before;
    for (std::size_t i = 0; i < size; ++i) {
      const Vec3& p = corners_[at(ring[corner])];
      corner = corner + 1 < size ? corner + 1 : 0;
      if (r == 0) polygon.middle = polygon.middle + share * p;
      if (i == 0) origin = p;
      const Vec3 here = p - origin;
      if (i > 1) polygon.area = polygon.area + 0.5 * cross(before, here);
      before = here;
    }
  }
}

std::size_t ParallelPolygons::least_of(const std::vector<int>& ring) const {
  std::size_t least = 0;
  for (std::size_t i = 1; i < ring.size(); ++i)
    least = is_lesser(corners_[at(ring[i])], corners_[at(ring[least])]) ? i : least;
  return least;
}

}  // namespace oriel::detail
