#include "kernel/validate/polygons/snapped.h"

#include "kernel/base/index.h"
#include "kernel/geometry/near_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oriel::detail {

namespace {

constexpr double kPerMetre = 1e6;

std::optional<MicrometrePoint> on_grid(Vec3 p) {
  MicrometrePoint point{};
  const std::array coordinates{p.x, p.y, p.z};
  for (std::size_t i = 0; i < 3; ++i) {
    const double scaled = coordinates[i] * kPerMetre;
    if (!(std::abs(scaled) < static_cast<double>(exact::kMaxCoordinate))) return std::nullopt;
    point[i] = std::llround(scaled);
  }
  return point;
}

/// For each point of `snapped` the first of those that are one with it; `number_of` has the point
/// of each vertex.
Numbers first_of_groups(const Building& building, const SnappedBuilding& snapped,
                        const std::vector<std::size_t>& number_of, double snap_m, SnapTies ties) {
  const double snap = std::max(snap_m * kPerMetre, 1.0);
  if (ties == SnapTies::two) return group_near_points(snapped.points, snap);
  if (ties == SnapTies::one) return group_near_points(snapped.points, snap + 1);
  std::vector<Vec3> places(snapped.points.size());
  for (std::size_t v = 0; v < number_of.size(); ++v)
    places[number_of[v]] = building.vertices[v] + building.frame.origin_m;
  return group_near_points(snapped.points, snap + 1, [&](int i, int j) {
    const Vec3 d = places[at(i)] - places[at(j)];
    return dot(d, d) < snap_m * snap_m;
  });
}

/// Puts a vertex that reading dropped back beside the one it repeats.
void repeat_in(std::vector<int>& ring, int vertex) {
  const auto found = std::ranges::find(ring, vertex);
  if (found != ring.end()) ring.insert(found, vertex);
}

}  // namespace

Vec3 SnappedBuilding::metres(int vertex) const {
  const MicrometrePoint& p = point(vertex);
  return {static_cast<double>(p[0]) / kPerMetre, static_cast<double>(p[1]) / kPerMetre,
          static_cast<double>(p[2]) / kPerMetre};
}

std::optional<SnappedBuilding> snapped(const Building& building, double snap_m, SnapTies ties) {
  std::vector<MicrometrePoint> grid;
  grid.reserve(building.vertices.size());
  for (const Vec3 vertex : building.vertices) {
    const auto point = on_grid(vertex);
    if (!point) return std::nullopt;
    grid.push_back(*point);
  }
  SnappedBuilding out;
  out.origin_m = building.frame.origin_m;
  out.points = grid;
  std::ranges::sort(out.points);
  const auto doubles = std::ranges::unique(out.points);
  out.points.erase(doubles.begin(), doubles.end());
  std::vector<std::size_t> number_of;
  number_of.reserve(grid.size());
  for (const MicrometrePoint& point : grid)
    number_of.push_back(
        static_cast<std::size_t>(std::ranges::lower_bound(out.points, point) - out.points.begin()));
  const Numbers first = first_of_groups(building, out, number_of, snap_m, ties);
  for (std::size_t i = 0; i < first.size() && out.are_all_apart; ++i)
    out.are_all_apart = first[i] == static_cast<int>(i);
  for (const Polygon& polygon : building.polygons)
    out.polygons.push_back({polygon.source, polygon.body, polygon.shell, polygon.rings});
  for (const RepeatedVertex& repeat : building.repeats)
    repeat_in(out.polygons[static_cast<std::size_t>(repeat.polygon)]
                  .rings[static_cast<std::size_t>(repeat.ring)],
              repeat.vertex);
  for (SnappedPolygon& polygon : out.polygons)
    for (auto& ring : polygon.rings)
      for (int& vertex : ring) vertex = first[number_of[static_cast<std::size_t>(vertex)]];
  return out;
}

}  // namespace oriel::detail
