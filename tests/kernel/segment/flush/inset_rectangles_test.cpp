#include "kernel/segment/flush/inset_rectangles.h"

#include "tests/support/shapes.h"

#include <array>
#include <set>
#include <vector>

#include <doctest/doctest.h>

namespace oriel::detail {
namespace {

/// Corners in a wall, as x and z in decimetres.
using WallPoint = std::array<double, 2>;
using WallPolygon = std::vector<WallPoint>;

/// The inset rectangles of a wall (y = 0, seen from -y) of these polygons, as sets of their
/// numbers.
std::multiset<std::vector<int>> rectangles_of(const std::vector<WallPolygon>& polygons,
                                              Vec3 up = {0, 0, 1}) {
  std::vector<std::vector<Vec3>> faces;
  for (const WallPolygon& polygon : polygons) {
    faces.emplace_back();
    for (const auto& [x, z] : polygon) faces.back().push_back(0.1 * (x * Vec3{1, 0, 0} + z * up));
  }
  const Building wall = test::building_of(faces);
  Solid solid;
  solid.grid_m = 1.0 / 1048576;
  solid.planes.resize(1);
  solid.planes[0].normal = cross({1, 0, 0}, up);
  solid.facets = {{PlaneId{0}, {}, {}}};
  for (const Polygon& polygon : wall.polygons) solid.facets[0].polygons.push_back(polygon.source);
  Work work;
  const Subdivisions found = subdivisions_of(wall, solid, {}, work);
  std::multiset<std::vector<int>> sources;
  for (const Subdivision& subdivision : found.subdivisions)
    for (const InsetRectangle& inset :
         find_inset_rectangles(found, subdivision, solid.planes[0].normal, {}, work)) {
      CHECK(std::ranges::find(inset.polygons, inset.host) == inset.polygons.end());
      std::vector<int> of_input;
      for (const InputPolygonId p : inset.polygons) of_input.push_back(found.polygons[p].source);
      std::ranges::sort(of_input);
      sources.insert(of_input);
    }
  return sources;
}

using Found = std::multiset<std::vector<int>>;

/// A wall of 6 × 4 m around a pane of 2 × 1.5 m; the pane's triangles are 0 and 1.
std::vector<WallPolygon> wall_with_pane() {
  const WallPoint a{20, 10}, b{40, 10}, c{40, 25}, d{20, 25}, o{0, 0}, p{60, 0}, q{60, 40},
      r{0, 40};
  return {{a, b, c}, {a, c, d}, {o, p, b}, {o, b, a}, {p, q, c},
          {p, c, b}, {q, r, d}, {q, d, c}, {r, o, a}, {r, a, d}};
}

/// Rectangles between the lines of a grid, cut along one diagonal each.
std::vector<WallPolygon> grid_of(const std::vector<double>& x, const std::vector<double>& z) {
  std::vector<WallPolygon> out;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t j = 0; j + 1 < z.size(); ++j) {
      out.push_back({{x[i], z[j]}, {x[i + 1], z[j]}, {x[i + 1], z[j + 1]}});
      out.push_back({{x[i], z[j]}, {x[i + 1], z[j + 1]}, {x[i], z[j + 1]}});
    }
  return out;
}

}  // namespace

TEST_SUITE("kernel/segment") {
  TEST_CASE("a pane stands out of the triangles of its wall") {
    CHECK(rectangles_of(wall_with_pane()) == Found{{0, 1}});
  }

  TEST_CASE("a pane stands out of the triangles of a roof and of a flat roof") {
    CHECK(rectangles_of(wall_with_pane(), {0, 0.6, 0.8}) == Found{{0, 1}});
    CHECK(rectangles_of(wall_with_pane(), {0, 1, 0}) == Found{{0, 1}});
  }

  TEST_CASE("a door that reaches the edge of its wall stands out of triangles") {
    const WallPoint a{20, 0}, b{30, 0}, c{30, 20}, d{20, 20}, o{0, 0}, p{60, 0}, q{60, 40},
        r{0, 40};
    CHECK(rectangles_of({{a, b, c},
                         {a, c, d},
                         {o, a, d},
                         {o, d, r},
                         {r, d, c},
                         {r, c, q},
                         {q, c, p},
                         {p, c, b}}) == Found{{0, 1}});
  }

  TEST_CASE("a sliver flatter than the weld beside a pane hides nothing") {
    // A corner of the pane is 0.6 mm beside the edge of two triangles.
    const WallPoint a{20, 10}, b{40, 10}, c{40, 25}, d{20, 25}, o{0, 0}, p{60, 0}, e{60, 25.012},
        q{50, 40}, r{0, 40};
    CHECK(rectangles_of({{a, b, c},
                         {a, c, d},
                         {o, p, b},
                         {o, b, a},
                         {p, c, b},
                         {p, e, c},
                         {d, c, e},
                         {d, e, q},
                         {d, q, r},
                         {r, o, a},
                         {r, a, d}}) == Found{{0, 1}});
  }

  TEST_CASE("a grid of panels has no inset rectangle") {
    CHECK(rectangles_of(grid_of({0, 10, 30, 40}, {0, 10, 20, 30})).empty());
    CHECK(rectangles_of(grid_of({0, 10, 20, 30, 40, 50}, {0, 10, 20, 30, 40, 50})).empty());
  }

  TEST_CASE("panels in a bond have no inset rectangle") {
    // The middle course is shifted: its joints end at those above and below it.
    const auto cut = [](double x0, double x1, double z0, double z1,
                        const std::vector<double>& below, const std::vector<double>& above,
                        std::vector<WallPolygon>& out) {
      WallPolygon ring{{x0, z0}};
      for (const double x : below) ring.push_back({x, z0});
      ring.push_back({x1, z0});
      ring.push_back({x1, z1});
      for (const double x : above) ring.push_back({x, z1});
      ring.push_back({x0, z1});
      out.push_back(ring);
    };
    std::vector<WallPolygon> wall;
    cut(0, 20, 0, 10, {}, {10}, wall);
    cut(20, 40, 0, 10, {}, {30}, wall);
    cut(0, 10, 10, 20, {}, {}, wall);
    cut(10, 30, 10, 20, {20}, {20}, wall);
    cut(30, 40, 10, 20, {}, {}, wall);
    cut(0, 20, 20, 30, {10}, {}, wall);
    cut(20, 40, 20, 30, {30}, {}, wall);
    cut(0, 40, 30, 40, {20}, {}, wall);
    CHECK(rectangles_of(wall).empty());
  }

  TEST_CASE(
      "piers between panes of a row are no rectangles though triangles have all their edges") {
    // Two panes of equal height: columns 2 and 4 of a row between strips of triangles.
    std::vector<WallPolygon> wall;
    const std::vector<WallPoint> low{{10, 10}, {20, 10}, {30, 10}, {40, 10}},
        high{{10, 25}, {20, 25}, {30, 25}, {40, 25}};
    for (std::size_t i = 0; i < 3; ++i) {
      wall.push_back({low[i], low[i + 1], high[i + 1]});
      wall.push_back({low[i], high[i + 1], high[i]});
    }
    const WallPoint o{0, 0}, p{50, 0}, q{50, 40}, r{0, 40};
    for (std::size_t i = 0; i < 3; ++i) {
      wall.push_back({o, low[i + 1], low[i]});
      wall.push_back({q, high[i], high[i + 1]});
    }
    for (const WallPolygon& triangle :
         {WallPolygon{o, p, low[3]}, WallPolygon{p, q, high[3]}, WallPolygon{p, high[3], low[3]},
          WallPolygon{q, r, high[0]}, WallPolygon{r, o, low[0]}, WallPolygon{r, low[0], high[0]}})
      wall.push_back(triangle);
    CHECK(rectangles_of(wall) == Found{{0, 1}, {4, 5}});
  }
}

}  // namespace oriel::detail
