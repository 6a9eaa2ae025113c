#pragma once

#include "tests/support/changed.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <cmath>
#include <vector>

/// Openings drawn into the front wall (y = 0, seen from -y) of buildings made in code.
namespace oriel::test {

/// The polygon of the front wall with the largest outer ring.
inline Polygon& front_wall(Building& building) {
  const auto width = [&](const Polygon& polygon) {
    Box box;
    for (const int v : polygon.rings[0]) box.grow(building.vertices[static_cast<std::size_t>(v)]);
    return box.min.y == 0 && box.max.y == 0 ? box.max.x - box.min.x : 0;
  };
  return *std::ranges::max_element(building.polygons, {}, width);
}

inline int add_vertex(Building& building, Vec3 p) {
  const auto found = std::ranges::find(building.vertices, p);
  if (found != building.vertices.end()) return static_cast<int>(found - building.vertices.begin());
  building.vertices.push_back(p);
  return static_cast<int>(building.vertices.size()) - 1;
}

/// A rectangle in the front wall, counter-clockwise seen from outside.
inline std::vector<int> front_ring(Building& building, double x0, double z0, double x1, double z1) {
  return {add_vertex(building, {x0, 0, z0}), add_vertex(building, {x1, 0, z0}),
          add_vertex(building, {x1, 0, z1}), add_vertex(building, {x0, 0, z1})};
}

/// Cuts a rectangle out of a polygon as an inner ring and fills it with a polygon, which gets the
/// inner rings of the other that lie in it. Returns the new polygon's source.
inline int add_pane(Building& building, double x0, double z0, double x1, double z1,
                    int host_source = -1) {
  const std::vector<int> ring = front_ring(building, x0, z0, x1, z1);
  Polygon& wall = host_source < 0
                      ? front_wall(building)
                      : *std::ranges::find(building.polygons, host_source, &Polygon::source);
  Polygon pane = wall;
  pane.rings = {ring};
  pane.source = static_cast<int>(building.polygons.size());
  std::vector<std::vector<int>> stay{wall.rings[0], {ring.rbegin(), ring.rend()}};
  for (std::size_t r = 1; r < wall.rings.size(); ++r) {
    const Vec3 p = building.vertices[static_cast<std::size_t>(wall.rings[r][0])];
    const bool is_inside = p.x >= x0 && p.x <= x1 && p.z >= z0 && p.z <= z1;
    (is_inside ? pane.rings : stay).push_back(wall.rings[r]);
  }
  wall.rings = std::move(stay);
  building.polygons.push_back(std::move(pane));
  return building.polygons.back().source;
}

/// A block of 10 × 8 × 6 m, one polygon a side.
inline Building plain_block() {
  return in_whole_facets(BoxBody().add({0, 0, 0}, {10, 8, 6}).build());
}

/// A flush frame of 2 × 1.5 m with two sashes sunk 4 cm into it.
inline Building block_with_sashes() {
  Building building = in_whole_facets(BoxBody()
                                          .add({0, 0, 0}, {10, 8, 6})
                                          .remove({2.125, 0, 1.125}, {2.875, 0.04, 2.375})
                                          .remove({3.125, 0, 1.125}, {3.875, 0.04, 2.375})
                                          .build());
  add_pane(building, 2, 1, 4, 2.5);
  return building;
}

/// A block with a flush door of 1 × 2 m on the ground; its source is 6.
inline Building block_with_door() {
  return building_of(
      {{{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {5, 0, 2}, {5, 0, 0}, {10, 0, 0}, {10, 0, 6}, {0, 0, 6}},
       {{10, 0, 0}, {10, 8, 0}, {10, 8, 6}, {10, 0, 6}},
       {{10, 8, 0}, {0, 8, 0}, {0, 8, 6}, {10, 8, 6}},
       {{0, 8, 0}, {0, 0, 0}, {0, 0, 6}, {0, 8, 6}},
       {{0, 0, 6}, {10, 0, 6}, {10, 8, 6}, {0, 8, 6}},
       {{0, 8, 0}, {10, 8, 0}, {10, 0, 0}, {5, 0, 0}, {4, 0, 0}, {0, 0, 0}},
       {{4, 0, 0}, {5, 0, 0}, {5, 0, 2}, {4, 0, 2}}});
}

}  // namespace oriel::test
