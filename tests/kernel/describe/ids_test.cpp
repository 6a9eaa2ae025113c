#include "kernel/segment/remove.h"
#include "tests/support/changed.h"
#include "tests/support/corpus.h"
#include "tests/support/described.h"
#include "tests/support/houses.h"

#include <set>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::described;
using test::Described;

std::set<std::string> ids_of(const FeatureTable& table) {
  std::set<std::string> ids;
  for (int i = 0; i < static_cast<int>(table.rows()); ++i) ids.insert(table.id(FeatureId{i}));
  return ids;
}

std::vector<Building> all_buildings() {
  std::vector<Building> all = test::samples().buildings;
  for (const auto& [name, make] : test::bodies()) {
    all.push_back(make());
    all.back().id = name;
  }
  return all;
}

TEST_SUITE("kernel/describe") {
  TEST_CASE("ids are names that no two features of a building share") {
    for (const Building& building : all_buildings()) {
      CAPTURE(building.id);
      const Described d = described(building);
      const auto ids = ids_of(d.table());
      CHECK(ids.size() == d.table().rows());
      for (const std::string& id : ids) {
        CHECK(id.size() == 14);
        CHECK(id.front() == 'f');
        CHECK(id.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyz") == std::string::npos);
        CHECK(d.table().id(d.table().find(id)) == id);
      }
      CHECK(d.table().building() == building.id);
    }
  }

  TEST_CASE("shuffled input changes neither ids nor what is said of them") {
    for (const Building& building : all_buildings()) {
      CAPTURE(building.id);
      const Described d = described(test::in_order(building)),
                      other = described(test::in_order(test::shuffled(building, 7)));
      REQUIRE(ids_of(other.table()) == ids_of(d.table()));
      for (const Attribute attribute : kAttributes) {
        CAPTURE(info_of(attribute).name);
        for (const std::string& id : ids_of(d.table())) {
          const FeatureId here = d.table().find(id), there = other.table().find(id);
          if (info_of(attribute).unit == Unit::text)
            CHECK(d.table().texts(attribute)[here.index()] ==
                  other.table().texts(attribute)[there.index()]);
          else
            CHECK(d.table().number(here, attribute) == other.table().number(there, attribute));
        }
      }
    }
  }

  TEST_CASE("ids stay when other features are taken off") {
    for (const Building& building : {test::six_pockets(), test::full_house(),
                                     test::dormer_with_window(), test::three_notches()}) {
      const Described d = described(building);
      const auto& s = d.segmented;
      const std::set<std::string> before = ids_of(d.table());
      for (const FeatureId id : test::all_features(s.segmentation)) {
        const Remainder rest = remove_features(s.solid, s.segmentation, {id});
        if (!rest.refused.empty()) continue;
        const auto after = ids_of(describe(building, segment(building, rest.solid)).table);
        CHECK(after.size() == before.size() - rest.removed.size());
        CHECK(std::ranges::includes(before, after));
        for (const FeatureId gone : rest.removed) CHECK_FALSE(after.contains(d.table().id(gone)));
      }
    }
  }

  TEST_CASE("ids are those of the place and not of the frame") {
    const Building building = test::full_house();
    Building moved = building;
    const Vec3 shift{-3, 2, 7};
    moved = test::mapped(moved, [&](Vec3 p) { return p - shift; });
    moved.frame.origin_m = shift;
    CHECK(ids_of(described(moved).table()) == ids_of(described(building).table()));
  }

  TEST_CASE("ids tell coordinates apart that have the same digits in a row") {
    const Building building = test::six_pockets();
    Segmentation segmentation = described(building).segmented.segmentation;
    const auto id_at = [&](double x, double y) {
      segmentation.features[0].box = {{x, y, 0}, {5, 5, 5}};
      return describe(building, segmentation).table.id(FeatureId{0});
    };
    // In millimetres 1 and 23, 12 and 3.
    CHECK(id_at(0.001, 0.023) != id_at(0.012, 0.003));
  }

  TEST_CASE("another building or level or place has other ids") {
    const Building building = test::six_pockets();
    const auto ids = ids_of(described(building).table());
    Building named = building, detailed = building, moved = building;
    named.id = "other";
    detailed.lod = "3.0";
    moved.frame.origin_m = {1, 0, 0};
    for (const Building& other : {named, detailed, moved})
      for (const std::string& id : ids_of(described(other).table())) CHECK_FALSE(ids.contains(id));
  }
}

}  // namespace
}  // namespace oriel
