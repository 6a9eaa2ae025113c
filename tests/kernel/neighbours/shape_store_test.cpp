#include "kernel/neighbours/shape_store.h"

#include "kernel/base/issue.h"
#include "kernel/neighbours/neighbours.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace oriel;
using oriel::test::BoxBody;

namespace {

namespace fs = std::filesystem;

/// A folder that goes again.
struct Scratch {
  fs::path path = fs::temp_directory_path() / fmt::format("oriel-shapes-{}", ::getpid());
  Scratch() { fs::create_directory(path); }
  ~Scratch() { fs::remove_all(path); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

Building house(int number) {
  Building building = BoxBody().add({0, 0, 0}, {10, 8, 5.0 + number % 3}).build();
  building.id = fmt::format("{:03}", (number * 37) % 100);
  building.frame.origin_m = {10.0 * (number % 10), 20.0 * (number / 10), 0};
  return building;
}

/// A hundred houses in ten rows; their ids do not follow the rows.
std::vector<Building> rows() {
  std::vector<Building> all;
  for (int i = 0; i < 100; ++i) all.push_back(house(i));
  return all;
}

NeighbourSearch search_within(std::size_t held_bytes, const std::string& beside = {}) {
  NeighbourSearch search({held_bytes, beside});
  for (const Building& building : rows()) search.add(building);
  search.add(house(3));  // again
  search.finish();
  return search;
}

/// All that is said of a house.
std::string said_of(const NeighbourSearch& search, const Building& building) {
  const Neighbourhood around = search.of(building);
  std::string text = fmt::format("{}:", around.self.value_or(999));
  for (const BuildingContact& contact : around.contacts)
    text += fmt::format(" {} {}", contact.building, contact.area_m2);
  for (const NeighbourWall& wall : around.walls)
    for (const Vec3 p : wall.outlines[0]) text += fmt::format(" {},{},{}", p.x, p.y, p.z);
  for (const Vec3 way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}})
    text += fmt::format(" {}", static_cast<int>(*search.outlook(around, {5, 4, 3}, way)));
  return text;
}

StandingShape shape_of(double size_m) {
  StandingShape shape;
  shape.walls.push_back(
      {{{{0, 0, 0}, {size_m, 0, 0}, {size_m, 0, 3}}}, {0, -1, 0}, {{0, 0, 0}, {1, 1, 1}}});
  shape.ground.push_back({{{0, 0, 0}, {size_m, 0, 0}, {0, size_m, 0}}, {}});
  return shape;
}

}  // namespace

TEST_SUITE("kernel/neighbours") {
  TEST_CASE("what is on disk is what was in memory") {
    const NeighbourSearch in_memory = search_within(std::size_t{1} << 30);
    for (const std::size_t held : {0, 5'000, 40'000}) {
      const NeighbourSearch on_disk = search_within(held);
      CHECK(on_disk.size() == 100);
      CHECK(on_disk.sha256() == in_memory.sha256());
      for (const Building& building : rows())
        CHECK(said_of(on_disk, building) == said_of(in_memory, building));
    }
  }

  TEST_CASE("several threads read outlines at the same time") {
    const NeighbourSearch search = search_within(10'000);
    const std::vector<Building> all = rows();
    const auto say_all = [&](std::vector<std::string>& said) {
      for (const Building& building : all) said.push_back(said_of(search, building));
    };
    std::vector<std::string> once, again;
    say_all(once);
    std::thread other([&] { say_all(again); });
    std::vector<std::string> third;
    say_all(third);
    other.join();
    CHECK(again == once);
    CHECK(third == once);
  }

  TEST_CASE("houses that stand together are together on disk") {
    const NeighbourSearch search = search_within(0);
    std::vector<std::size_t> order = search.by_place();
    double way_m = 0;
    for (std::size_t i = 1; i < order.size(); ++i)
      way_m +=
          length(search.buildings()[order[i]].origin_m - search.buildings()[order[i - 1]].origin_m);
    CHECK(way_m < 100 * 30);  // by id it would be some 70 m from each to the next
    std::ranges::sort(order);
    std::vector<std::size_t> all(100);
    std::iota(all.begin(), all.end(), std::size_t{0});
    CHECK(order == all);
  }

  TEST_CASE("outlines come back in their new order and those that are dropped do not") {
    for (const std::size_t held : {std::size_t{0}, std::size_t{1} << 20}) {
      detail::ShapeStore store(held, fs::temp_directory_path().string());
      for (const double size_m : {1.0, 2.0, 3.0, 4.0}) store.add(shape_of(size_m));
      CHECK(store.is_on_disk() == (held == 0));
      const std::vector<std::size_t> kept{3, 0, 2}, by_place{1, 2, 0};
      store.arrange(kept, by_place);
      for (std::size_t i = 0; i < kept.size(); ++i) {
        const StandingShape expected = shape_of(static_cast<double>(kept[i]) + 1);
        const auto found = store.at(i);
        CHECK(found->ground == expected.ground);
        REQUIRE(found->walls.size() == 1);
        CHECK(found->walls[0].outlines == expected.walls[0].outlines);
        CHECK(found->walls[0].normal == expected.walls[0].normal);
        CHECK(found->walls[0].box == expected.walls[0].box);
      }
    }
  }

  TEST_CASE("nothing stays beside the output and small cities write nothing") {
    const Scratch scratch;
    const std::string output = (scratch.path / "out.city.json").string();
    const NeighbourSearch search = search_within(0, output);
    CHECK(fs::is_empty(scratch.path));
    fs::remove_all(scratch.path);
    CHECK_NOTHROW(search_within(std::size_t{1} << 30, output));
  }

  TEST_CASE("a folder that takes no file is told with its place") {
    const std::string folder = "/nowhere-at-all";
    try {
      search_within(0, folder + "/out.city.json");
      FAIL("nothing was thrown");
    } catch (const OutputError& error) {
      CHECK(error.issue().code == Code::E601);
      CHECK(error.issue().place.file == folder + "/.oriel-outlines");
    }
  }
}
