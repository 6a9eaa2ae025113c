#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/solidify/soup/soup.h"

#include <cmath>
#include <optional>
#include <vector>

namespace oriel::detail {

/// An integer normal.
using IntegerNormal = std::array<std::int64_t, 3>;

Vec3 unit(const IntegerNormal& normal);

/// What clustering needs to know of a polygon.
struct PolygonShape {
  std::optional<IntegerNormal> normal;  ///< of its own, missing for a polygon without area
  Vec3 unit;                            ///< the unit vector of `normal`
  double area = 0;                      ///< grid units squared
};

/// A polygon's area by its longest reach from its first corner, grid units.
double height_of(const Soup& soup, int polygon, double area);

/// How far the normal of a polygon that high may be off if its vertices may be off by `offset`
/// (grid units).
double uncertainty_rad(double height, double offset);

/// Of every polygon of a soup that has any.
std::vector<PolygonShape> shapes_of(const Soup& soup);

/// The rings of a polygon as points, grid units.
std::vector<Outline> outlines_of(const Soup& soup, int polygon);

/// Where a polygon's vertices lie along a normal: normal · vertex.
struct OffsetSpan {
  std::int64_t low = 0, high = 0, mean = 0;
};

OffsetSpan span_along(const Soup& soup, int polygon, const IntegerNormal& normal);

/// normal · point: below 2^62, as normals have 28 bits and coordinates 32.
inline std::int64_t along(const IntegerNormal& normal, const exact::GridPoint& point) {
  return normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2];
}

/// normal · vertex if it is the same for all vertices.
inline std::optional<std::int64_t> offset_if_flat(const Soup& soup, int polygon,
                                                  const IntegerNormal& normal) {
  const auto corners = soup.corners_of(polygon);
  const exact::GridPoint* const points = soup.points.data();
  // Most are across an axis: one coordinate tells.
  if ((normal[0] != 0) + (normal[1] != 0) + (normal[2] != 0) == 1) {
    const std::size_t axis = normal[0] != 0 ? 0 : normal[1] != 0 ? 1 : 2;
    const std::int64_t level = points[corners.front()][axis];
    for (const int v : corners)
      if (points[v][axis] != level) return std::nullopt;
    return normal[axis] * level;
  }
  const std::int64_t offset = along(normal, points[corners.front()]);
  for (const int v : corners)
    if (along(normal, points[v]) != offset) return std::nullopt;
  return offset;
}

/// The upper median of normal · vertex over all corners: of a wall with a recess thinner than the
/// tolerance that of the wall, as at most half of the corners lie deeper.
std::int64_t median_along(const Soup& soup, int polygon, const IntegerNormal& normal);

/// True if asin(sine) > limit; the arcsine is taken only where its bounds do not decide.
inline bool is_arcsine_above(double sine, double limit) {
  if (1.6 * sine <= limit) return false;   // asin(s) ≤ s · π / 2
  if (sine > 1.0001 * limit) return true;  // asin(s) ≥ s
  return std::asin(sine < 1 ? sine : 1.0) > limit;
}

}  // namespace oriel::detail
