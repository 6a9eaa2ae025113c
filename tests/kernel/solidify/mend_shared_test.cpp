#include "kernel/io/reader.h"
#include "kernel/solidify/solidify.h"
#include "tests/support/shared.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

struct Tally {
  int buildings = 0, solids = 0, with_dangling = 0, with_open_edges = 0;
};

/// What becomes of the labelled files of one data set.
Tally tally(const std::filesystem::path& folder, Closing close) {
  Tally out;
  ReadOptions options;
  options.joins_installations = false;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.path().string().ends_with(".labelled.city.json")) continue;
    Reader reader(entry.path().string(), options);
    while (const auto record = reader.next()) {
      if (!record->value) continue;
      for (const Building& building : record->value->buildings) {
        const Solidified solid =
            solidify(building, {}, {close, RepairOptions{}.cap_area_m2, Crossings::cut});
        ++out.buildings;
        out.solids += solid.value.has_value();
        out.with_dangling += !solid.report.dangling.empty();
        out.with_open_edges += !solid.report.open_edges.empty();
        CHECK(solid.value.has_value() == solid.report.open_edges.empty());
        if (solid.value) CHECK(is_closed(*solid.value));
        if (solid.value) CHECK(volume_m3(*solid.value) > 50);
      }
    }
  }
  return out;
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("shared data: published LoD3 becomes solids") {
    ORIEL_NEEDS_SHARED(shared);
    const auto ingolstadt = shared / "data" / "ingolstadt";
    CHECK(tally(ingolstadt, Closing::planar).solids >= 17);
    const Tally any = tally(ingolstadt, Closing::any);
    CHECK(any.buildings == 19);
    CHECK(any.solids >= 17);
    CHECK(any.solids + any.with_open_edges == any.buildings);
  }

  TEST_CASE("shared data: all houses of random3dcity become solids without their overhangs") {
    ORIEL_NEEDS_SHARED(shared);
    const Tally houses = tally(shared / "data" / "random3dcity", Closing::planar);
    CHECK(houses.buildings == 76);
    CHECK(houses.solids == 76);
    CHECK(houses.with_dangling > 0);
  }
}

}  // namespace
}  // namespace oriel
