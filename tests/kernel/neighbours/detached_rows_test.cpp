#include "kernel/neighbours/detached_rows.h"

#include "tests/support/shapes.h"

#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace oriel;

namespace {

struct Standing {
  double x = 0, y = 0, width = 8, height = 6;
};

/// Their ids ascend in the order given.
NeighbourSearch detached(const std::vector<Standing>& all) {
  NeighbourSearch search;
  int number = 0;
  for (const Standing& one : all) {
    Building building = test::BoxBody().add({0, 0, 0}, {one.width, 8, one.height}).build();
    building.id = fmt::format("{:03}", number++);
    building.frame.origin_m = {one.x, one.y, 0};
    search.add(building);
  }
  search.finish();
  return search;
}

std::vector<DetachedRow> rows_of(const std::vector<Standing>& all) {
  return detached_rows(detached(all), 3, [](std::size_t) { return true; });
}

}  // namespace

TEST_SUITE("kernel/neighbours") {
  TEST_CASE("detached houses in a line are a row from end to end") {
    const auto rows = rows_of({{30, 0}, {0, 0}, {15, 0}, {45, 1}, {60, 0}});
    REQUIRE(rows.size() == 1);
    CHECK(rows[0] == DetachedRow{1, 2, 0, 3, 4});
  }

  TEST_CASE(
      "a row ends where houses are of another size or height, or far off, or round a corner") {
    CHECK(rows_of({{0, 0}, {15, 0}, {30, 0}}).empty());
    CHECK(rows_of({{0, 0}, {15, 0}, {30, 0, 20}, {60, 0}, {75, 0}}).empty());
    CHECK(rows_of({{0, 0}, {15, 0}, {30, 0, 8, 12}, {45, 0}, {60, 0}}).empty());
    CHECK(rows_of({{0, 0}, {15, 0}, {30, 0}, {60, 0}, {75, 0}, {90, 0}}).empty());
    CHECK(rows_of({{0, 0}, {15, 0}, {30, 0}, {30, 15}, {30, 30}}).empty());
    const auto rows = rows_of({{0, 0}, {15, 0}, {30, 0}, {45, 0}, {45, 15}, {45, 30}});
    REQUIRE(rows.size() == 1);
    CHECK(rows[0] == DetachedRow{0, 1, 2, 3});
  }

  TEST_CASE("of crossing rows the denser one has the house that is in both") {
    std::vector<Standing> grid;
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x) grid.push_back({12.0 * x, 16.0 * y});
    const auto rows = rows_of(grid);
    REQUIRE(rows.size() == 3);
    for (const DetachedRow& row : rows) CHECK(row.size() == 5);
    CHECK(rows[1] == DetachedRow{5, 6, 7, 8, 9});
  }

  TEST_CASE("houses that are no candidates are passed over") {
    const NeighbourSearch search = detached({{0, 0}, {15, 0}, {30, 0}, {45, 0}});
    CHECK(detached_rows(search, 3, [](std::size_t i) { return i != 3; }).empty());
  }
}
