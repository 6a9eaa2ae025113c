#include "kernel/geometry/planar.h"
#include "kernel/model/vec3.h"
#include "oriel/explain.h"

#include <cmath>
#include <vector>

namespace oriel {

namespace {

/// Places are given to the centimetre or so, and recesses that matter are deeper.
constexpr double kReach_m = 0.05;

std::vector<detail::Outline> outlines_of(const Building& building, const Polygon& polygon) {
  std::vector<detail::Outline> outlines;
  for (const auto& ring : polygon.rings) {
    detail::Outline& outline = outlines.emplace_back();
    for (const int v : ring) outline.push_back(building.vertices[static_cast<std::size_t>(v)]);
  }
  return outlines;
}

}  // namespace

std::optional<PolygonAt> polygon_at(const Building& building, Vec3 point) {
  const Vec3 local = point - building.frame.origin_m;
  std::optional<PolygonAt> nearest;
  for (std::size_t i = 0; i < building.polygons.size(); ++i) {
    const auto outlines = outlines_of(building, building.polygons[i]);
    if (outlines.empty() || outlines[0].empty()) continue;
    const Vec3 normal = normalised(area_vector(outlines[0]));
    const double distance = std::abs(dot(local - outlines[0][0], normal));
    if (distance > kReach_m || (nearest && distance >= nearest->distance_m)) continue;
    if (detail::contains(outlines, normal, local)) nearest = PolygonAt{i, distance};
  }
  return nearest;
}

}  // namespace oriel
