#include "kernel/solidify/noise.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <tuple>
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
/// Two triangles that lie further off a common plane, or at a larger angle to each other, are no
/// halves of one polygon.
constexpr double kMostOfHalves_m = 0.01;
constexpr double kCosineOfHalves = std::numbers::sqrt2 / 2;
/// Four corners reach less far than many: noise of ±n shows 0.48 n in nine of ten rectangles (the
/// alternating sum of four even errors, by 4) and 0.6 to 0.65 n in the polygons of a house.
constexpr double kOfMoreCorners = 4.0 / 3;

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

bool is_triangle(const Polygon& polygon) {
  return polygon.rings.size() == 1 && polygon.rings[0].size() == 3;
}

bool is_before(Vec3 p, Vec3 q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); }

/// A triangle by its longest side, whose ends are sorted: vertices may be listed more than once.
struct Half {
  Vec3 low, high, opposite;
  /// The normal times twice the area.
  Vec3 area;

  [[nodiscard]] bool has_side_of(const Half& other) const {
    return low == other.low && high == other.high;
  }
};

Half half_of(const Building& building, const Polygon& triangle) {
  std::array<Vec3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = building.vertices[at(triangle.rings[0][i])];
  const auto side_m = [&](std::size_t i) { return length(corners[(i + 1) % 3] - corners[i]); };
  std::size_t longest = 0;
  for (const std::size_t i : {1U, 2U})
    if (side_m(i) > side_m(longest)) longest = i;
  const Vec3 p = corners[longest], q = corners[(longest + 1) % 3],
             opposite = corners[(longest + 2) % 3];
  return {is_before(p, q) ? p : q, is_before(p, q) ? q : p, opposite, cross(q - p, opposite - p)};
}

/// Half of what the corners of both reach along the normal of what they make together; NaN where
/// they are no halves of one polygon.
double out_of_plane_m(const Half& first, const Half& second) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  const Vec3 normal = normalised(first.area + second.area);
  if (!(dot(normalised(first.area), normalised(second.area)) > kCosineOfHalves)) return kNothing;
  const double along[] = {0, dot(normal, first.high - first.low),
                          dot(normal, first.opposite - first.low),
                          dot(normal, second.opposite - first.low)};
  const auto [low, high] = std::ranges::minmax(along);
  const double off_m = (high - low) / 2;
  return off_m <= kMostOfHalves_m ? off_m : kNothing;
}

/// Of the pairs of triangles that share the longest side of both, as the halves of a rectangle do.
void add_halves(const Building& building, std::vector<double>& offs_m) {
  std::vector<Half> halves;
  for (const Polygon& polygon : building.polygons)
    if (is_triangle(polygon)) halves.push_back(half_of(building, polygon));
  std::ranges::sort(halves, [](const Half& a, const Half& b) {
    if (a.low != b.low) return is_before(a.low, b.low);
    if (a.high != b.high) return is_before(a.high, b.high);
    return is_before(a.opposite, b.opposite);
  });
  for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
    if (!halves[i].has_side_of(halves[i + 1])) continue;
    const double off_m = out_of_plane_m(halves[i], halves[i + 1]);
    if (off_m >= 0) offs_m.push_back(kOfMoreCorners * off_m);
  }
}

}  // namespace

double noise_of(const Building& building) {
  std::vector<double> offs_m;
  std::size_t triangles = 0;
  for (const Polygon& polygon : building.polygons) {
    triangles += is_triangle(polygon) ? 1 : 0;
    if (polygon.rings.empty() || polygon.rings[0].size() < 4) continue;
    const double off_m = out_of_plane_m(building, polygon);
    if (off_m >= 0) offs_m.push_back(off_m);
  }
  if (2 * triangles > building.polygons.size()) add_halves(building, offs_m);
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
