#pragma once

#include "model/building.h"

#include <array>
#include <cstddef>
#include <vector>

namespace oriel::test {

/// Whether the triangles without area along the row are there, as Delaunay makes them, or left out,
/// as ear clipping does.
enum class Slivers { kept, left_out };

/// A block of 12 × 8 × 3 m with two pockets of 2 × 1 × 0.15 m in a row in its front. The front is
/// in triangles of which those above and below the row have one side for all of it.
inline Building block_with_row(Slivers slivers) {
  Building building;
  building.id = "row";
  const auto vertex = [&](Vec3 p) {
    building.vertices.push_back(p);
    return static_cast<int>(building.vertices.size()) - 1;
  };
  const auto face = [&](std::vector<int> ring) {
    Polygon polygon;
    polygon.source = static_cast<int>(building.polygons.size());
    polygon.rings = {std::move(ring)};
    building.polygons.push_back(std::move(polygon));
  };
  const auto rectangle_at = [&](double y, double x0, double x1, double z0, double z1) {
    return std::array<int, 4>{vertex({x0, y, z0}), vertex({x1, y, z0}), vertex({x1, y, z1}),
                              vertex({x0, y, z1})};
  };
  const auto a = rectangle_at(0, 0, 12, 0, 3), b = rectangle_at(8, 0, 12, 0, 3),
             left = rectangle_at(0, 2, 4, 1, 2), right = rectangle_at(0, 7, 9, 1, 2);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    face({a[j], a[i], b[i], b[j]});
  }
  face({b[1], b[0], b[3], b[2]});
  for (const auto& rim : {left, right}) {
    std::array<int, 4> back{};
    for (std::size_t i = 0; i < 4; ++i)
      back[i] = vertex(building.vertices[static_cast<std::size_t>(rim[i])] + Vec3{0, 0.15, 0});
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t j = (i + 1) % 4;
      face({rim[i], rim[j], back[j], back[i]});
    }
    face({back[0], back[1], back[2], back[3]});
  }
  face({a[0], a[1], right[1]});
  face({a[0], right[1], left[0]});
  face({a[1], a[2], right[2]});
  face({a[1], right[2], right[1]});
  face({a[2], a[3], left[3]});
  face({a[2], left[3], right[2]});
  face({a[3], a[0], left[0]});
  face({a[3], left[0], left[3]});
  face({left[1], right[0], right[3]});
  face({left[1], right[3], left[2]});
  if (slivers == Slivers::left_out) return building;
  face({left[0], right[1], right[0]});
  face({left[0], right[0], left[1]});
  face({right[2], left[3], left[2]});
  face({right[2], left[2], right[3]});
  return building;
}

}  // namespace oriel::test
