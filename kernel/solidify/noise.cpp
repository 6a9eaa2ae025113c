#include "kernel/solidify/noise.h"

#include "kernel/model/detail/index.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace oriel {

namespace {

/// Fewer polygons say nothing of the whole building.
constexpr std::size_t kFewPolygons = 6;
/// The share of polygons that are no further off.
constexpr double kShare = 0.9;
/// For noise of ±n, of which 0.6 n is seen, an offset of 1.6 n keeps planes together: 8 mm for
/// 5 mm (docs/solidify.md, "Noise").
constexpr double kOffsetPerNoise = 2.75;
constexpr double kLargestOffset_m = 0.01;

/// Half of what the corners reach along the normal of the outer ring; NaN without area.
double out_of_plane_m(const Building& building, const Polygon& polygon) {
  const auto corner = [&](int v) { return building.vertices[at(v)]; };
  const auto& outer = polygon.rings[0];
  const Vec3 origin = corner(outer[0]);
  Vec3 area;
  for (std::size_t i = 1; i + 1 < outer.size(); ++i)
    area = area + cross(corner(outer[i]) - origin, corner(outer[i + 1]) - origin);
  if (!(length(area) > 0)) return std::numeric_limits<double>::quiet_NaN();
  const Vec3 normal = normalised(area);
  double low = 0, high = 0;
  for (const auto& ring : polygon.rings)
    for (const int v : ring) {
      const double along = dot(normal, corner(v) - origin);
      low = std::min(low, along);
      high = std::max(high, along);
    }
  return (high - low) / 2;
}

}  // namespace

double noise_of(const Building& building) {
  std::vector<double> offs_m;
  for (const Polygon& polygon : building.polygons) {
    if (polygon.rings.empty() || polygon.rings[0].size() < 4) continue;
    const double off_m = out_of_plane_m(building, polygon);
    if (off_m >= 0) offs_m.push_back(off_m);
  }
  if (offs_m.size() < kFewPolygons) return 0;
  const auto place = static_cast<std::size_t>(kShare * static_cast<double>(offs_m.size()));
  const auto nth = offs_m.begin() + static_cast<std::ptrdiff_t>(place);
  std::ranges::nth_element(offs_m, nth);
  return *nth;
}

Tolerances fitted_to_noise(Tolerances tolerances, double noise_m) {
  const double fitting_m = std::min(kOffsetPerNoise * noise_m, kLargestOffset_m);
  tolerances.plane_offset_m = std::max(tolerances.plane_offset_m, fitting_m);
  return tolerances;
}

}  // namespace oriel
