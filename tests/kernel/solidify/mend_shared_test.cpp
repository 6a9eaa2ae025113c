#include "io/reader.h"
#include "kernel/solidify/solidify.h"
#include "tests/support/shared.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

struct Tally {
  int buildings = 0, solids = 0, with_dangling = 0, with_open_edges = 0;
};

/// What becomes of the labelled files of one data set, or of those whose names end so.
Tally tally(const std::filesystem::path& folder, Closing close,
            const std::string& end = ".labelled.city.json", double least_m3 = 50) {
  Tally out;
  ReadOptions options;
  options.joins_installations = false;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.path().string().ends_with(end)) continue;
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
        if (solid.value) CHECK(solid.report.open_edges.empty());
        if (solid.value) CHECK(is_closed(*solid.value));
        if (solid.value) CHECK(volume_m3(*solid.value) > least_m3);
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
    CHECK(tally(ingolstadt, RepairOptions{}.close).solids >= 17);
    const Tally any = tally(ingolstadt, Closing::any);
    CHECK(any.buildings == 19);
    CHECK(any.solids >= 17);
    CHECK(any.solids + any.with_open_edges == any.buildings);
  }

  TEST_CASE(
      "shared data: most shells of Rotterdam 3D lack walls only and become solids by default") {
    ORIEL_NEEDS_SHARED(shared);
    const auto delfshaven = shared / "data" / "delfshaven";
    const Tally ground = tally(delfshaven, RepairOptions{}.close, ".city.json", 0);
    CHECK(ground.buildings == 853);
    CHECK(ground.solids >= 740);
    CHECK(tally(delfshaven, Closing::planar, ".city.json", 0).solids < 200);
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
