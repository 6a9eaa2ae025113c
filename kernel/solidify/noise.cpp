#include "kernel/solidify/noise.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
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

/// Along which axes all corners have the same coordinate.
struct ConstantAxes {
  bool x = true, y = true, z = true;
};

/// In one go and without a branch: which axis it is no one can guess.
ConstantAxes axes_across(const Building& building, const Polygon& polygon) {
  const Vec3* const corners = building.vertices.data();
  const Vec3 first = corners[polygon.rings[0][0]];
  ConstantAxes across;
  for (const auto& ring : polygon.rings)
    for (const int v : ring) {
      const Vec3& p = corners[v];
      across.x &= p.x == first.x;
      across.y &= p.y == first.y;
      across.z &= p.z == first.z;
    }
  return across;
}

/// Twice the area of the outer ring, seen along the third axis.
double area_across(const Building& building, const Polygon& polygon, double Vec3::*u,
                   double Vec3::*v) {
  const auto& outer = polygon.rings[0];
  const Vec3* const corners = building.vertices.data();
  const Vec3 origin = corners[outer[0]];
  double area = 0;
  double before_u = corners[outer[1]].*u - origin.*u, before_v = corners[outer[1]].*v - origin.*v;
  for (std::size_t i = 2; i < outer.size(); ++i) {
    const double here_u = corners[outer[i]].*u - origin.*u,
                 here_v = corners[outer[i]].*v - origin.*v;
    area += before_u * here_v - before_v * here_u;
    before_u = here_u;
    before_v = here_v;
  }
  return area;
}

/// Half of what the corners reach along the normal of the outer ring; NaN without area.
double out_of_plane_m(const Building& building, const Polygon& polygon) {
  // Most polygons stand across an axis and are flat then.
  const auto flat_m = [&](double Vec3::*u, double Vec3::*v) {
    const double area = area_across(building, polygon, u, v);
    return std::abs(area) > 0 ? 0 : std::numeric_limits<double>::quiet_NaN();
  };
  const ConstantAxes across = axes_across(building, polygon);
  if (across.x) return flat_m(&Vec3::y, &Vec3::z);
  if (across.y) return flat_m(&Vec3::z, &Vec3::x);
  if (across.z) return flat_m(&Vec3::x, &Vec3::y);
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
