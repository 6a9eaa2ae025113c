#include "kernel/neighbours/kept_ground.h"

#include "kernel/neighbours/alike_groups.h"
#include "tests/support/shapes.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;

namespace {

Outline rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}};
}

Outline turned_round(Outline outline) { return {outline.rbegin(), outline.rend()}; }

}  // namespace

TEST_SUITE("kernel/neighbours") {
  TEST_CASE("ground that is kept free is measured in any frame, without its holes") {
    KeptGround kept;
    kept.add({rectangle(100, 100, 110, 110), turned_round(rectangle(102, 102, 108, 108))});
    kept.add({rectangle(120, 100, 121, 200)});
    kept.finish();
    const std::vector<Outline> figure{rectangle(0, 0, 5, 5)};
    CHECK(kept.under_m2(figure, {100, 100, 7}) == doctest::Approx(25 - 9));
    CHECK(kept.under_m2(figure, {103, 103, 7}) == doctest::Approx(0));
    CHECK(kept.under_m2(figure, {118, 100, 7}) == doctest::Approx(5));
    CHECK(kept.under_m2(figure, {500, 100, 7}) == 0);
    CHECK(kept.box().max.y == 200);
    CHECK(KeptGround().under_m2(figure, {}) == 0);
  }

  TEST_CASE("a gap is closed where none of it is kept free") {
    NeighbourSearch search;
    for (const double x : {0.0, 11.0, 22.0}) {
      Building building = test::BoxBody().add({0, 0, 0}, {10, 8, 6}).build();
      building.id = "at " + std::to_string(static_cast<int>(x));
      building.frame.origin_m = {x, 0, 0};
      search.add(building);
    }
    search.finish();
    KeptGround kept;
    kept.add({rectangle(10.2, -50, 10.4, 50)});
    kept.finish();
    const AlikeGroups all = alike_groups(search, {2, 3, nullptr});
    REQUIRE(all.groups.size() == 1);
    CHECK(all.groups[0].members.size() == 3);
    const AlikeGroups found = alike_groups(search, {2, 3, &kept});
    REQUIRE(found.groups.size() == 1);
    CHECK(found.groups[0].members == std::vector<std::size_t>{1, 2});
    REQUIRE(found.kept_apart.size() == 1);
    CHECK(found.kept_apart[0] == std::pair<std::size_t, std::size_t>{0, 1});
  }
}
