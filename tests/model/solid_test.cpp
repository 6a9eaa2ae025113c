#include "model/solid.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// A tetrahedron with its right angle at the origin and legs of 1 m.
Solid tetrahedron() {
  Solid solid;
  solid.grid_m = 1.0;
  for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    solid.vertices.push_back({p, false});
  const double s = 1 / std::sqrt(3.0);
  solid.planes = {{{-1, 0, 0}, 0, {-1, 0, 0}, 0},
                  {{0, -1, 0}, 0, {0, -1, 0}, 0},
                  {{0, 0, -1}, 0, {0, 0, -1}, 0},
                  {{1, 1, 1}, 1, {s, s, s}, s}};
  solid.facets = {{PlaneId{0}, {{0, 3, 2}}, {}},
                  {PlaneId{1}, {{0, 1, 3}}, {}},
                  {PlaneId{2}, {{0, 2, 1}}, {}},
                  {PlaneId{3}, {{1, 2, 3}}, {}}};
  solid.shells = {{{FacetId{0}, FacetId{1}, FacetId{2}, FacetId{3}}, 0, false}};
  return solid;
}

TEST_SUITE("model") {
  TEST_CASE("the volume of a tetrahedron comes from its planes") {
    CHECK(volume_m3(tetrahedron()) == doctest::Approx(1.0 / 6).epsilon(1e-14));
    CHECK(surface_m2(tetrahedron()) == doctest::Approx(1.5 + std::sqrt(3.0) / 2).epsilon(1e-14));
  }

  TEST_CASE("a solid that lacks a facet is not closed") {
    Solid solid = tetrahedron();
    CHECK(is_closed(solid));
    solid.facets.pop_back();
    CHECK_FALSE(is_closed(solid));
  }

  TEST_CASE("a solid with a facet turned round is not closed, and neither is one of no facets") {
    Solid solid = tetrahedron();
    std::ranges::reverse(solid.facets[3].loops[0]);
    CHECK_FALSE(is_closed(solid));
    CHECK_FALSE(is_closed(Solid{}));
  }

  TEST_CASE("where two bodies touch in an edge, both of its pairs count as closed") {
    Solid solid = tetrahedron();
    // A second one over the same edge 0 – 3, on the other side.
    solid.vertices.push_back({{-1, 0, 0}, false});
    solid.vertices.push_back({{0, -1, 0}, false});
    solid.planes.push_back({{1, 0, 0}, 0, {1, 0, 0}, 0});
    solid.planes.push_back({{0, 1, 0}, 0, {0, 1, 0}, 0});
    const double s = 1 / std::sqrt(3.0);
    solid.planes.push_back({{-1, -1, 1}, 1, {-s, -s, s}, s});
    solid.facets.push_back({PlaneId{4}, {{0, 3, 5}}, {}});
    solid.facets.push_back({PlaneId{5}, {{0, 4, 3}}, {}});
    solid.facets.push_back({PlaneId{2}, {{0, 5, 4}}, {}});
    CHECK_FALSE(is_closed(solid));
    solid.facets.push_back({PlaneId{6}, {{3, 4, 5}}, {}});
    CHECK(is_closed(solid));
  }
}

}  // namespace
}  // namespace oriel
