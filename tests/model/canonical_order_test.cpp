#include "model/canonical_order.h"

#include "tests/support/changed.h"
#include "tests/support/houses.h"

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// Inner rings in the opposite order.
Building with_rings_turned_about(Building building) {
  for (Polygon& polygon : building.polygons)
    if (polygon.rings.size() > 2) std::reverse(polygon.rings.begin() + 1, polygon.rings.end());
  return building;
}

void check_same(const CanonicalOrder& here, const CanonicalOrder& there) {
  CHECK(here.building.vertices == there.building.vertices);
  REQUIRE(here.building.polygons.size() == there.building.polygons.size());
  for (std::size_t i = 0; i < here.building.polygons.size(); ++i) {
    CHECK(here.building.polygons[i].rings == there.building.polygons[i].rings);
    CHECK(here.building.polygons[i].source == there.building.polygons[i].source);
  }
}

TEST_SUITE("model") {
  TEST_CASE("the canonical order is that of the geometry whatever order it was read in") {
    for (const auto& [name, make] : test::bodies()) {
      CAPTURE(std::string(name));
      const Building building = make();
      const CanonicalOrder order(building);
      for (const std::uint64_t seed : {1, 2, 3}) {
        std::vector<int> origin;
        const Building other = with_rings_turned_about(test::shuffled(building, seed, &origin));
        const CanonicalOrder again(other);
        check_same(order, again);
        for (std::size_t i = 0; i < origin.size(); ++i)
          CHECK(order.from_reading[static_cast<std::size_t>(origin[i])] == again.from_reading[i]);
      }
    }
  }

  TEST_CASE("the canonical order moves nothing and keeps every polygon once") {
    for (const auto& [name, make] : test::bodies()) {
      CAPTURE(std::string(name));
      const Building building = make();
      const CanonicalOrder order(building);
      std::vector<char> is_met(building.polygons.size(), 0);
      for (const Polygon& polygon : order.building.polygons) {
        const int read = order.to_reading[static_cast<std::size_t>(polygon.source)];
        is_met[static_cast<std::size_t>(read)] = 1;
        CHECK(order.from_reading[static_cast<std::size_t>(read)] == polygon.source);
        const auto points = [](const Building& of, const std::vector<int>& ring) {
          std::vector<Vec3> list;
          for (const int v : ring) list.push_back(of.vertices[static_cast<std::size_t>(v)]);
          return list;
        };
        auto here = points(order.building, polygon.rings[0]);
        const auto there =
            points(building, building.polygons[static_cast<std::size_t>(read)].rings[0]);
        REQUIRE(here.size() == there.size());
        std::ranges::rotate(here, std::ranges::find(here, there[0]));
        CHECK(here == there);
      }
      CHECK(std::ranges::count(is_met, 0) == 0);
    }
  }

  TEST_CASE("installations stay behind the polygons of their building") {
    Building building = test::gabled_house();
    building.installations.push_back({"i", building.polygons.size(), building.vertices.size()});
    const Building low = test::gabled_house();
    const int first = static_cast<int>(building.vertices.size());
    for (const Vec3 p : low.vertices) building.vertices.push_back(p - Vec3{90, 90, 90});
    for (Polygon polygon : low.polygons) {
      for (auto& ring : polygon.rings)
        for (int& v : ring) v += first;
      polygon.source = static_cast<int>(building.polygons.size());
      building.polygons.push_back(std::move(polygon));
    }
    const CanonicalOrder order(building);
    for (std::size_t i = 0; i < order.building.polygons.size(); ++i)
      for (const int v : order.building.polygons[i].rings[0])
        CHECK((v >= first) == (i >= building.installations[0].first_polygon));
  }
}

}  // namespace
}  // namespace oriel
