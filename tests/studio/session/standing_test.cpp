#include "studio/session/standing.h"

#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel::studio {

namespace {

Standee house(const std::string& file, double x, double y, double width = 10, double depth = 8) {
  return {file, {{x, y, 0}, {x + width, y + depth, 9}}, {x, y, 0}};
}

Box seen(const Standee& standee, const Standing& standing) {
  return standee.box_m.moved(-standing.origin_m);
}

bool meet(const Box& a, const Box& b) {
  return a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y;
}

}  // namespace

TEST_SUITE("studio/session") {
  TEST_CASE("files on one spot stand side by side") {
    std::vector<Standee> all;
    for (int i = 0; i < 14; ++i)
      all.push_back(house("f" + std::to_string(i), 0.1 * i, 0, 9 + i % 3));
    const auto made = standings(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      CHECK(made[i].is_moved);
      CHECK(seen(all[i], made[i]).min.z == 0);
      for (std::size_t j = 0; j < i; ++j)
        CHECK_FALSE(meet(seen(all[i], made[i]), seen(all[j], made[j])));
    }
  }

  TEST_CASE(
      "buildings of a street stay where they are though their boxes touch and overlap a little") {
    std::vector<Standee> all;
    for (int i = 0; i < 10; ++i)
      all.push_back(house("f" + std::to_string(i), 500000 + 9.5 * i, 5e6));
    for (const Standing& standing : standings(all)) {
      CHECK_FALSE(standing.is_moved);
      CHECK(standing.origin_m == Vec3{500000, 5e6, 0});
    }
  }

  TEST_CASE("a file that lies upon a street keeps its buildings together beside the others") {
    std::vector<Standee> all;
    for (int i = 0; i < 4; ++i) all.push_back(house("street", 20.0 * i, 0));
    all.push_back(house("again", 20, 0));
    all.push_back(house("elsewhere", 300, 0));
    const auto made = standings(all);
    for (int i = 1; i < 4; ++i) CHECK(made[i].origin_m == made[0].origin_m);
    CHECK(made[0].is_moved);
    CHECK(made[4].is_moved);
    CHECK_FALSE(made[5].is_moved);
    for (int i = 0; i < 4; ++i) CHECK_FALSE(meet(seen(all[i], made[i]), seen(all[4], made[4])));
  }

  TEST_CASE("a file whose buildings all lie on one spot has each of them beside the others") {
    const std::vector<Standee> all{house("f", 0, 0), house("f", 0, 0), house("f", 1, 0)};
    const auto made = standings(all);
    CHECK_FALSE(meet(seen(all[0], made[0]), seen(all[1], made[1])));
    CHECK_FALSE(meet(seen(all[1], made[1]), seen(all[2], made[2])));
  }

  TEST_CASE("what lies far from most is said and stays near enough to be drawn exactly") {
    std::vector<Standee> all{house("far", 604000, 5403766), house("far again", 604000, 5403766)};
    for (int i = 0; i < 5; ++i) all.push_back(house("near", 20.0 * i, 0));
    const auto made = standings(all);
    CHECK(std::abs(made[0].away_m - 5437000) < 1000);
    CHECK(std::abs(seen(all[0], made[0]).min.x) < 50000);
    CHECK_FALSE(meet(seen(all[0], made[0]), seen(all[1], made[1])));
    CHECK(made[2].away_m == 0);
    CHECK(made[2].origin_m == Vec3{0, 0, 0});
  }

  TEST_CASE("what names another reference system than most stands beside them as it lies") {
    std::vector<Standee> all;
    const auto add = [&](const std::string& file, double x, double y, const std::string& system) {
      all.push_back(house(file, x, y));
      all.back().system = system;
    };
    for (int i = 0; i < 3; ++i) add("germany", 500000 + 20.0 * i, 5e6, "EPSG:25832");
    add("unnamed", 500060, 5e6, "");
    for (int i = 0; i < 2; ++i) add("next zone", 500000 + 20.0 * i, 5e6 + 40, "EPSG:25833");
    add("far in it", 700000, 5e6, "EPSG:25833");
    const auto made = standings(all);
    for (int i = 0; i < 4; ++i) {
      CHECK_FALSE(made[i].is_moved);
      CHECK(made[i].origin_m == made[0].origin_m);
    }
    CHECK(made[4].is_moved);
    CHECK(made[5].origin_m == made[4].origin_m);
    CHECK(seen(all[4], made[4]).min.x > seen(all[3], made[3]).max.x);
    CHECK(std::abs(made[6].away_m - 200000) < 1000);
  }

  TEST_CASE("of nothing and of buildings without vertices nothing is moved") {
    CHECK(standings({}).empty());
    const std::vector<Standee> all{{"f", {}, {}}, {"g", {}, {}}};
    for (const Standing& standing : standings(all)) CHECK_FALSE(standing.is_moved);
  }
}

}  // namespace oriel::studio
