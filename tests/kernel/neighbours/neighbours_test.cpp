#include "kernel/neighbours/neighbours.h"

#include "kernel/base/random.h"
#include "kernel/geometry/shared_area.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using oriel::test::BoxBody;

namespace {

Building block(const std::string& id, Vec3 at_m, Vec3 size_m = {10, 8, 6}) {
  Building building = BoxBody().add({0, 0, 0}, size_m).build();
  building.id = id;
  building.frame.origin_m = at_m;
  return building;
}

NeighbourSearch search_of(const std::vector<Building>& buildings) {
  NeighbourSearch search;
  for (const Building& building : buildings) search.add(building);
  search.finish();
  return search;
}

std::vector<std::string> ids_of(const Neighbourhood& around) {
  std::vector<std::string> ids;
  for (const BuildingContact& contact : around.contacts) ids.push_back(contact.building);
  return ids;
}

double shared_m2(const Neighbourhood& around, const std::string& id) {
  for (const BuildingContact& contact : around.contacts)
    if (contact.building == id) return contact.area_m2;
  return 0;
}

std::string codes_of(const Neighbourhood& around) {
  std::string text;
  for (const Issue& issue : around.issues) text += to_string(issue.code) + " ";
  return text;
}

/// Eight houses around a yard, 10 m by 10 m each.
std::vector<Building> courtyard() {
  std::vector<Building> all;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      if (x != 1 || y != 1)
        all.push_back(block(std::string("h") + std::to_string(x) + std::to_string(y),
                            {10.0 * x, 10.0 * y, 0}, {10, 10, 6}));
  return all;
}

const Building& named(const std::vector<Building>& all, const std::string& id) {
  return *std::ranges::find(all, id, &Building::id);
}

}  // namespace

TEST_SUITE("kernel/neighbours") {
  TEST_CASE("buildings touch where their walls lie against each other") {
    const std::vector<Building> all{block("a", {0, 0, 0}), block("b", {10, 2, 0}, {5, 6, 4}),
                                    block("c", {-10, 8, 0}), block("d", {0.5, 8.2, 0})};
    const NeighbourSearch search = search_of(all);
    const Neighbourhood of_a = search.of(all[0]);
    CHECK(ids_of(of_a) == std::vector<std::string>{"b"});
    CHECK(shared_m2(of_a, "b") == doctest::Approx(24));
    CHECK(shared_m2(search.of(all[1]), "a") == doctest::Approx(24));
    CHECK(search.of(all[3]).contacts.empty());
  }

  TEST_CASE("walls five centimetres apart touch and a note says so") {
    const std::vector<Building> all{block("a", {0, 0, 0}), block("b", {10.04, 0, 0}),
                                    block("c", {-10.06, 0, 0})};
    const Neighbourhood around = search_of(all).of(all[0]);
    CHECK(ids_of(around) == std::vector<std::string>{"b"});
    CHECK(codes_of(around) == "E178 ");
    CHECK(around.issues[0].sentence.find("40 mm apart") != std::string::npos);
    // It is moved into the plane of the building's own wall.
    for (const NeighbourWall& wall : around.walls)
      for (const Vec3 p : wall.outlines[0]) CHECK(p.x == doctest::Approx(10));
  }

  TEST_CASE("houses of different heights share what both have") {
    const std::vector<Building> all{block("a", {0, 0, 0}, {10, 8, 12}), block("b", {10, 0, 0})};
    const NeighbourSearch search = search_of(all);
    const Neighbourhood high = search.of(all[0]), low = search.of(all[1]);
    CHECK(shared_m2(high, "b") == doctest::Approx(48));
    CHECK(shared_m2(low, "a") == doctest::Approx(48));
    const std::vector<Outline> wall{{{10, 0, 0}, {10, 8, 0}, {10, 8, 12}, {10, 0, 12}}};
    CHECK(high.covered_share(wall, {1, 0, 0}) == doctest::Approx(0.5));
  }

  TEST_CASE("overlapping buildings are told and so is one that stands in another") {
    const std::vector<Building> all{block("a", {0, 0, 0}), block("b", {9, 0, 0}),
                                    block("c", {2, 2, 0}, {3, 3, 3})};
    const NeighbourSearch search = search_of(all);
    CHECK(codes_of(search.of(all[0])) == "E175 E175 ");
    CHECK(codes_of(search.of(all[1])) == "E175 ");
    CHECK(codes_of(search.of(all[2])) == "E176 ");
    CHECK(search.of(all[1]).contacts[0].overlap_m2 == doctest::Approx(8));
    CHECK(search.of(all[1]).walls.empty());
  }

  TEST_CASE("what stands above another building does not overlap it") {
    const std::vector<Building> all{block("a", {0, 0, 0}), block("b", {5, 0, 6})};
    CHECK(search_of(all).of(all[0]).issues.empty());
  }

  TEST_CASE("buildings of another reference system are no neighbours") {
    std::vector<Building> all{block("a", {0, 0, 0}), block("b", {10, 0, 0}),
                              block("c", {20, 0, 0})};
    for (Building& building : all) building.frame.crs = "EPSG:25832";
    all[1].frame.crs = "EPSG:28992";
    const NeighbourSearch search = search_of(all);
    CHECK(search.of(all[0]).contacts.empty());
    REQUIRE(search.issues().size() == 1);
    CHECK(search.issues()[0].code == Code::E177);
    CHECK(search.issues()[0].place.building == "b");
  }

  TEST_CASE("a building that comes again counts once and another one with its id is told") {
    std::vector<Building> all{block("a", {0, 0, 0}), block("b", {10, 0, 0}), block("a", {0, 0, 0})};
    CHECK(search_of(all).size() == 2);
    CHECK(search_of(all).issues().empty());
    all.push_back(block("a", {20, 0, 0}));
    const NeighbourSearch search = search_of(all);
    REQUIRE(search.issues().size() == 1);
    CHECK(search.issues()[0].code == Code::E179);
    CHECK(ids_of(search.of(all[1])) == std::vector<std::string>{"a", "a"});
  }

  TEST_CASE("before a wall lies a street or the yard that its group stands around") {
    const std::vector<Building> all = courtyard();
    const NeighbourSearch search = search_of(all);
    const Neighbourhood around = search.of(named(all, "h10"));  // to the south of the yard
    CHECK(around.contacts.size() == 2);
    CHECK(search.outlook(around, {5, 10, 3}, {0, 1, 0}) == Outlook::yard);
    CHECK(search.outlook(around, {5, 0, 3}, {0, -1, 0}) == Outlook::street);
    CHECK_FALSE(search.outlook(around, {5, 5, 6}, {0, 0, 1}));
    const Neighbourhood stranger = search.of(block("x", {100, 100, 0}));
    CHECK_FALSE(search.outlook(stranger, {5, 10, 3}, {0, 1, 0}));
  }

  TEST_CASE("a yard may be open to one side") {
    std::vector<Building> all = courtyard();
    std::erase_if(all, [](const Building& building) { return building.id == "h12"; });
    const NeighbourSearch search = search_of(all);
    CHECK(search.outlook(search.of(named(all, "h01")), {10, 5, 3}, {1, 0, 0}) == Outlook::yard);
    // Nothing stands opposite.
    CHECK(search.outlook(search.of(named(all, "h10")), {5, 10, 3}, {0, 1, 0}) == Outlook::street);
  }

  TEST_CASE("across the street stands another group") {
    const std::vector<Building> all{block("a", {0, 0, 0}), block("b", {10, 0, 0}),
                                    block("c", {0, 30, 0}), block("d", {10, 30, 0})};
    const NeighbourSearch search = search_of(all);
    CHECK(search.outlook(search.of(all[0]), {5, 8, 3}, {0, 1, 0}) == Outlook::street);
  }

  TEST_CASE("a wall above the roof of a neighbour looks over that roof") {
    const std::vector<Building> all{block("a", {0, 0, 0}, {10, 8, 12}), block("b", {10, 0, 0})};
    const NeighbourSearch search = search_of(all);
    CHECK(search.outlook(search.of(all[0]), {10, 4, 9}, {1, 0, 0}) == Outlook::roof);
  }

  TEST_CASE("results do not depend on the order of the buildings") {
    const std::vector<Building> all = courtyard();
    std::vector<Building> other(all.rbegin(), all.rend());
    const NeighbourSearch one = search_of(all), two = search_of(other);
    CHECK(one.sha256() == two.sha256());
    for (const Building& building : all) {
      CHECK(ids_of(one.of(building)) == ids_of(two.of(building)));
      CHECK(one.of(building).self == two.of(building).self);
    }
  }

  TEST_CASE("a turned street has the neighbours that it had") {
    std::vector<Building> all = courtyard();
    for (Building& building : all) {
      for (Vec3& p : building.vertices) {
        const Vec3 q = p + building.frame.origin_m;
        p = {0.6 * q.x - 0.8 * q.y, 0.8 * q.x + 0.6 * q.y, q.z};
      }
      building.frame.origin_m = {1e6, 5e6, 0};
    }
    const NeighbourSearch search = search_of(all);
    for (const Building& building : all) {
      const Neighbourhood around = search.of(building);
      CHECK(around.contacts.size() == 2);
      for (const BuildingContact& contact : around.contacts)
        CHECK(contact.area_m2 == doctest::Approx(60));
    }
  }

  TEST_CASE("ground of others is found whatever stands on it") {
    const std::vector<Building> all{block("a", {0, 0, 0}), block("b", {20, 0, 50})};
    const NeighbourSearch search = search_of(all);
    const Neighbourhood around = search.of(all[0]);
    CHECK(search.is_built_on(around, {{19, 0, 0}, {21, 1, 0}}));
    CHECK_FALSE(search.is_built_on(around, {{11, 0, 0}, {19, 1, 0}}));
    CHECK_FALSE(search.is_built_on(around, {{0, 0, 0}, {1, 1, 0}}));
  }
}

TEST_SUITE("kernel/neighbours") {
  TEST_CASE("the area that two figures share is that of what both cover") {
    const std::vector<Outline> frame{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
                                     {{1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}}};
    const std::vector<Outline> bar{{{-1, 1.5, 0}, {9, 1.5, 0}, {9, 2.5, 0}, {-1, 2.5, 0}}};
    CHECK(figure_area_m2(frame, {0, 0, 1}) == doctest::Approx(12));
    CHECK(shared_area_m2(frame, bar, {0, 0, 1}) == doctest::Approx(2));
    CHECK(shared_area_m2(bar, frame, {0, 0, -1}) == doctest::Approx(2));
    CHECK(shared_area_m2(frame, frame, {0, 0, 1}) == doctest::Approx(12));
  }

  TEST_CASE("areas that meet are one and cracks between them are no more") {
    const auto square = [](double x, double y) {
      return detail::PlanArea{{{x, y, 0}, {x + 10, y, 0}, {x + 10, y + 10, 0}, {x, y + 10, 0}}};
    };
    std::vector<detail::PlanArea> ring;
    for (int x = 0; x < 3; ++x)
      for (int y = 0; y < 3; ++y)
        if (x != 1 || y != 1) ring.push_back(square(10.01 * x, 10.01 * y));
    Work work;
    const auto whole = detail::united(ring, 0.05, work);
    REQUIRE(whole.size() == 1);
    CHECK(whole[0].size() == 2);
    CHECK(figure_area_m2(whole[0], {0, 0, 1}) == doctest::Approx(800).epsilon(0.01));
    ring.push_back(square(100, 0));
    CHECK(detail::united(ring, 0.05, work).size() == 2);
    Work little(10);
    CHECK(detail::united(ring, 0.05, little).empty());
    CHECK(little.is_used_up());
  }

  TEST_CASE("the gap between two areas is the strip where they face each other") {
    const detail::PlanArea one{{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}};
    const detail::PlanArea other{{{12, 4, 0}, {20, 4, 0}, {20, 20, 0}, {12, 20, 0}}};
    const auto strips = detail::gaps_between(one, other, 2.5, 0.1);
    REQUIRE(strips.size() == 1);
    CHECK(figure_area_m2(strips[0], {0, 0, 1}) == doctest::Approx(12));
    CHECK(detail::gaps_between(one, other, 1.5, 0.1).empty());
  }
}
