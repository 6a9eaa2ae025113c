#pragma once

#include "model/building.h"
#include "model/canonical_order.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

/// The same building told differently: moved, turned, mirrored, shuffled, with noise.
namespace oriel::test {

template <class Map>
Building mapped(Building building, Map map) {
  for (Vec3& p : building.vertices) p = map(p);
  return building;
}

/// Moved so that the frame starts where the reader would let it start: coordinates local, origin in
/// the input's coordinates.
inline Building framed(Building building) {
  building.frame = frame_of(building.vertices, building.frame.crs);
  return mapped(std::move(building), [o = building.frame.origin_m](Vec3 p) { return p - o; });
}

/// A rotation about a unit axis (Rodrigues).
inline Vec3 turned(Vec3 p, Vec3 axis, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return c * p + s * cross(axis, p) + ((1 - c) * dot(axis, p)) * axis;
}

/// Mirrored at x = 0, rings turned round so that they stay counter-clockwise from outside.
inline Building mirrored(Building building) {
  for (Polygon& polygon : building.polygons)
    for (auto& ring : polygon.rings) std::ranges::reverse(ring);
  return mapped(std::move(building), [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; });
}

/// Vertices, polygons and ring starts in another order; Polygon::source is the new reading order.
/// `origin` gets the old number of each polygon.
inline Building shuffled(const Building& building, std::uint64_t seed,
                         std::vector<int>* origin = nullptr) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  // std::shuffle differs between libraries; this is Fisher & Yates.
  const auto permutation = [&](std::size_t size) {
    std::vector<int> order(size);
    for (std::size_t i = 0; i < size; ++i) order[i] = static_cast<int>(i);
    for (std::size_t i = size; i > 1; --i) std::swap(order[i - 1], order[below(i)]);
    return order;
  };
  Building out = building;
  const std::vector<int> place = permutation(building.vertices.size());
  for (std::size_t v = 0; v < place.size(); ++v)
    out.vertices[static_cast<std::size_t>(place[v])] = building.vertices[v];
  out.polygons.clear();
  const std::vector<int> order = permutation(building.polygons.size());
  for (const int i : order) {
    Polygon polygon = building.polygons[static_cast<std::size_t>(i)];
    polygon.source = static_cast<int>(out.polygons.size());
    for (auto& ring : polygon.rings) {
      for (int& v : ring) v = place[static_cast<std::size_t>(v)];
      if (!ring.empty())
        std::ranges::rotate(ring, ring.begin() + static_cast<std::ptrdiff_t>(below(ring.size())));
    }
    out.polygons.push_back(std::move(polygon));
  }
  if (origin != nullptr) *origin = order;
  return out;
}

/// The building in its canonical order. `origin` gets the number of each polygon before, or where
/// it has numbers already those that it has for these.
inline Building in_order(const Building& building, std::vector<int>* origin = nullptr) {
  CanonicalOrder order(building);
  if (origin != nullptr) {
    const std::vector<int> before = *origin;
    *origin = order.to_reading;
    for (int& number : *origin)
      if (!before.empty()) number = before[static_cast<std::size_t>(number)];
  }
  return std::move(order.building);
}

/// Every polygon without inner rings cut into a fan of triangles (polygons are convex or not looked
/// at); sources are counted anew.
inline Building in_triangles(const Building& building) {
  Building out = building;
  out.polygons.clear();
  for (const Polygon& polygon : building.polygons)
    for (std::size_t i = 1; i + 1 < polygon.rings[0].size(); ++i) {
      Polygon triangle = polygon;
      triangle.rings = {{polygon.rings[0][0], polygon.rings[0][i], polygon.rings[0][i + 1]}};
      triangle.source = static_cast<int>(out.polygons.size());
      out.polygons.push_back(std::move(triangle));
    }
  return out;
}

/// Every coordinate moved by up to `size_m` in either direction.
inline Building with_noise(Building building, double size_m, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto step = [&] { return (static_cast<double>(random() >> 11) / 0x1p52 - 1) * size_m; };
  return mapped(std::move(building), [&](Vec3 p) {
    const double x = step(), y = step(), z = step();
    return p + Vec3{x, y, z};
  });
}

}  // namespace oriel::test
