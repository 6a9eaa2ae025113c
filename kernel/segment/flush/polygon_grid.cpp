#include "kernel/segment/flush/polygon_grid.h"

#include "kernel/geometry/exact.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace oriel::detail {

namespace {

/// As wide as a window: what lies in one is in few cells, and few cells hold more.
constexpr double kCell_m = 1;

}  // namespace

std::size_t PolygonGrid::Hash::operator()(const GridPlace& p) const {
  std::uint64_t hash = 0;
  for (const long c : {p.x, p.y, p.z})
    hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
  return static_cast<std::size_t>(hash ^ hash >> 32);
}

PolygonGrid::GridPlace PolygonGrid::place_of(Vec3 point) {
  const auto cell = [](double c) { return static_cast<long>(std::floor(c / kCell_m)); };
  return {cell(point.x), cell(point.y), cell(point.z)};
}

PolygonGrid::PolygonGrid(const Building& building, double grid_m) {
  std::vector<Vec3> corners;  // a vertex is a corner of several polygons
  corners.reserve(building.vertices.size());
  for (const Vec3 vertex : building.vertices) corners.push_back(exact::on_grid(vertex, grid_m));
  polygons_.reserve(building.polygons.size());
  for (const Polygon& polygon : building.polygons) {
    if (polygon.source < 0 || polygon.rings.empty()) continue;
    PlacedPolygon& placed = polygons_.emplace_back();
    placed.source = polygon.source;
    placed.rings.reserve(polygon.rings.size());
    for (const auto& ring : polygon.rings) {
      Outline& outline = placed.rings.emplace_back();
      outline.reserve(ring.size());
      for (const int v : ring) outline.push_back(corners[static_cast<std::size_t>(v)]);
      start_at_least(outline);
      for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        placed.area =
            placed.area + 0.5 * cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
    }
    for (const Vec3 p : placed.outline()) placed.box.grow(p);
  }
  if (!std::ranges::is_sorted(polygons_, {}, &PlacedPolygon::source))
    std::ranges::sort(polygons_, {}, &PlacedPolygon::source);
  for (int i = 0; i < std::ssize(polygons_); ++i) {
    const PlacedPolygon& polygon = polygons_[static_cast<std::size_t>(i)];
    // What has no corner has no middle.
    if (!polygon.box.is_empty()) cells_[place_of(polygon.middle())].push_back(i);
  }
}

const PlacedPolygon& PolygonGrid::of(int source) const {
  return *std::ranges::lower_bound(polygons_, source, {}, &PlacedPolygon::source);
}

std::vector<int> PolygonGrid::within(const Box& box) const {
  std::vector<int> found;
  const auto is_in = [&](Vec3 p) {
    return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y &&
           p.z >= box.min.z && p.z <= box.max.z;
  };
  const auto take = [&](const PolygonsOfCell& cell) {
    for (const int i : cell)
      if (is_in(polygons_[static_cast<std::size_t>(i)].middle())) found.push_back(i);
  };
  const GridPlace low = place_of(box.min), high = place_of(box.max);
  const double cells = static_cast<double>(high.x - low.x + 1) *
                       static_cast<double>(high.y - low.y + 1) *
                       static_cast<double>(high.z - low.z + 1);
  if (cells >
      static_cast<double>(cells_.size())) {  // a large ring: there are fewer cells than places
    for (const auto& [place, cell] : cells_) take(cell);
  } else {
    for (long x = low.x; x <= high.x; ++x)
      for (long y = low.y; y <= high.y; ++y)
        for (long z = low.z; z <= high.z; ++z)
          if (const auto cell = cells_.find({x, y, z}); cell != cells_.end()) take(cell->second);
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace oriel::detail
