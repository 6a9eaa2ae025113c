#include "io/json/rings.h"

#include "kernel/base/text/counted.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

bool has_three_points(const std::vector<int>& ring, const std::vector<Vec3>& points) {
  const auto point = [&](std::size_t i) { return points[static_cast<std::size_t>(ring[i])]; };
  std::size_t second = 1;
  while (second < ring.size() && point(second) == point(0)) ++second;
  for (std::size_t i = second + 1; i < ring.size(); ++i)
    if (point(i) != point(0) && point(i) != point(second)) return true;
  return false;
}

}  // namespace

std::vector<int> without_repeats(std::vector<int> ring, int polygon, int number,
                                 std::vector<RepeatedVertex>& repeats) {
  if (std::ranges::adjacent_find(ring) == ring.end() &&
      (ring.size() < 2 || ring.front() != ring.back()))
    return ring;
  std::size_t kept = 0;
  for (const int vertex : ring) {
    if (kept > 0 && ring[kept - 1] == vertex)
      repeats.push_back({polygon, number, vertex});
    else
      ring[kept++] = vertex;
  }
  ring.resize(kept);
  for (; ring.size() > 1 && ring.front() == ring.back(); ring.pop_back())
    repeats.push_back({polygon, number, ring.back()});
  return ring;
}

std::optional<Fault> find_degenerate(const std::vector<Polygon>& polygons,
                                     const std::vector<Vec3>& points) {
  int count = 0;
  int first = -1;
  for (const Polygon& polygon : polygons) {
    const auto good = std::ranges::count_if(
        polygon.rings, [&](const auto& ring) { return has_three_points(ring, points); });
    const auto bad = std::max<std::ptrdiff_t>(std::ssize(polygon.rings), 1) - good;
    if (bad > 0 && count == 0) first = polygon.source;
    count += static_cast<int>(bad);
  }
  if (count == 0) return std::nullopt;
  return Fault{Code::E311, fmt::format("{} fewer than 3 distinct points, the first in "
                                       "polygon {} (val3dity 101 TOO_FEW_POINTS)",
                                       counted(count, "ring has", "rings have"), first)};
}

std::optional<Fault> find_beyond_limits(const std::vector<Vec3>& points) {
  const auto is_beyond = [](double x) { return !(std::abs(x) <= kMaxCoordinate_m); };
  Box box;
  for (const Vec3 p : points) {
    if (is_beyond(p.x) || is_beyond(p.y) || is_beyond(p.z)) {
      const double x = is_beyond(p.x) ? p.x : is_beyond(p.y) ? p.y : p.z;
      return Fault{Code::E506,
                   fmt::format("a vertex has the coordinate {} m; the limit is ±1e9 m", x)};
    }
    box.grow(p);
  }
  const Vec3 size = box.max - box.min;
  const double extent = std::max({size.x, size.y, size.z});
  if (extent <= kMaxExtent_m) return std::nullopt;
  return Fault{Code::E501, fmt::format("the building is {:.0f} m across; the limit is {:.0f} m",
                                       extent, kMaxExtent_m)};
}

}  // namespace oriel::detail
