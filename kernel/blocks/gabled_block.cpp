#include "kernel/blocks/gabled_block.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

namespace oriel {

namespace {

constexpr double kAlongRidge = 0.1736;  // the sine of 10 degrees
constexpr double kParallel = 0.0087;    // of half a degree

double sine_between(Vec3 p, Vec3 q) {
  const double both = length(p) * length(q);
  return both > 0 ? std::abs(cross(p, q).z) / both : 1;
}

Vec3 middle_on_grid(Vec3 p, Vec3 q, double z, double grid_m) {
  const auto rounded = [&](double value) { return std::round(value / grid_m) * grid_m; };
  return {rounded((p.x + q.x) / 2), rounded((p.y + q.y) / 2), z};
}

}  // namespace

std::optional<Outline> under_ridge(const Outline& outline, Vec3 ridge) {
  if (outline.size() != 4) return std::nullopt;
  const auto edge = [&](std::size_t i) { return outline[(i + 1) % 4] - outline[i % 4]; };
  for (std::size_t i = 0; i < 4; ++i)
    if (cross(edge(i), edge(i + 1)).z <= 0) return std::nullopt;  // not convex
  for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
    const double eaves_m = std::min(length(edge(first)), length(edge(first + 2)));
    const double ends_m = std::max(length(edge(first + 1)), length(edge(first + 3)));
    if (sine_between(edge(first), edge(first + 2)) > kParallel || eaves_m < ends_m ||
        sine_between(edge(first), ridge) > kAlongRidge)
      continue;
    Outline turned = outline;
    std::ranges::rotate(turned, turned.begin() + static_cast<std::ptrdiff_t>(first));
    return turned;
  }
  return std::nullopt;
}

Building faces_of(const GabledBlock& block, double grid_m) {
  Building building;
  const auto add = [&](Vec3 p, double z) { building.vertices.push_back({p.x, p.y, z}); };
  for (const Vec3 p : block.outline) add(p, block.ground_m);
  for (const Vec3 p : block.outline) add(p, block.eaves_m);
  const Outline& o = block.outline;
  building.vertices.push_back(middle_on_grid(o[3], o[0], block.ridge_m, grid_m));
  building.vertices.push_back(middle_on_grid(o[1], o[2], block.ridge_m, grid_m));
  for (const std::vector<int>& ring : std::initializer_list<std::vector<int>>{{3, 2, 1, 0},
                                                                              {0, 1, 5, 4},
                                                                              {1, 2, 6, 9, 5},
                                                                              {2, 3, 7, 6},
                                                                              {3, 0, 4, 8, 7},
                                                                              {4, 5, 9, 8},
                                                                              {6, 7, 8, 9}}) {
    Polygon polygon;
    polygon.rings = {ring};
    polygon.source = static_cast<int>(building.polygons.size());
    building.polygons.push_back(std::move(polygon));
  }
  return building;
}

}  // namespace oriel
