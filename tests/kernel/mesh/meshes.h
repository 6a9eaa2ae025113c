#pragma once

#include "kernel/mesh/mesh.h"
#include "kernel/solidify/solidify.h"
#include "tests/support/shapes.h"

#include <utility>

#include <doctest/doctest.h>

namespace oriel::test {

inline Solid solid_of(const Building& building) {
  auto solid = solidify(building);
  REQUIRE(solid.value);
  return std::move(*solid.value);
}

/// Faces given by their corners, with the normals of their first three.
inline MeshSource source_of(std::vector<Vec3> points, const std::vector<std::vector<int>>& faces) {
  MeshSource source;
  source.points = std::move(points);
  for (const auto& face : faces) {
    const auto p = [&](std::size_t i) { return source.points[static_cast<std::size_t>(face[i])]; };
    source.polygons.push_back({{face}, normalised(cross(p(1) - p(0), p(2) - p(0)))});
  }
  return source;
}

}  // namespace oriel::test
