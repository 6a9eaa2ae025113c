#include "generalise/carry_out.h"
#include "generalise/generalise.h"
#include "generalise/operators/operators.h"
#include "interpret/plan/profile.h"
#include "tests/generalise/line.h"
#include "tests/support/shapes.h"

#include <map>
#include <string>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

constexpr double kScale = 2000;  // sizes 1, 0.5 and 0.25 m, 0.707 m2

/// A block of 10 x 8 x 6 m.
BoxBody ten_metre_block() { return BoxBody().add({0, 0, 0}, {10, 8, 6}); }

/// What the profile `map` makes of a body whose features all have the label, or none.
struct Flattened {
  Line line;
  Plan plan;
  Generalised made;
};
Flattened flattened(const BoxBody& body, const std::string& label = "") {
  Line line = line_of(body.build());
  for (Verdict& verdict : line.interpretation.verdicts) verdict.label = label;
  const Plan plan =
      plan_by_profile({kScale, {}, {}}, *load_profile_file("map").value, residential(),
                      line.segmentation, line.table(), line.interpretation, kScale);
  auto out = generalise(line.context(), plan);
  REQUIRE(out.value);
  CHECK(is_closed(out.value->solid));
  return {std::move(line), plan, std::move(*out.value)};
}

void check_volume(const Flattened& f, double volume) {
  CHECK(f.made.refused.empty());
  CHECK(volume_m3(f.made.solid) == doctest::Approx(volume).epsilon(1e-6));
}

std::string only_step(const Flattened& f) {
  REQUIRE(f.plan.steps.size() == 1);
  return f.plan.steps[0].operation + " " + f.plan.steps[0].rule;
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("a plate on most of a wall moves the wall and keeps the volume") {
    const auto f = flattened(ten_metre_block().add({0.5, -0.2, 0.5}, {9.5, 0, 5.5}));
    CHECK(only_step(f) == "flatten map:any/lamina");
    check_volume(f, 480 + 9);
    CHECK(f.made.solid.facets.size() == 6);
    CHECK(box_of(f.made.solid).min.y == doctest::Approx(-9.0 / 60).epsilon(1e-6));
    CHECK(f.made.removed.size() == 1);
  }

  TEST_CASE("a plate on less of a wall goes") {
    const auto f = flattened(ten_metre_block().add({2, -0.2, 2}, {5, 0, 4}));
    CHECK(only_step(f) == "flatten map:any/lamina");
    check_volume(f, 480);
  }

  TEST_CASE("a shallow niche over most of a wall moves the wall inwards") {
    const auto f = flattened(ten_metre_block().remove({0.5, 0, 0.5}, {9.5, 0.2, 5.5}));
    CHECK(only_step(f) == "flatten map:any/lamina");
    check_volume(f, 480 - 9);
    CHECK(f.made.solid.facets.size() == 6);
  }

  TEST_CASE("an opening that is too shallow leaves its outline") {
    const auto f = flattened(ten_metre_block().remove({2, 0, 2}, {5, 0.2, 4}), "window");
    CHECK(only_step(f) == "collapse map:any/lamina");
    check_volume(f, 480);
    CHECK(f.made.solid.facets.size() == 7);
  }

  TEST_CASE("a cap is trimmed and then raises what it lay on") {
    const auto f = flattened(ten_metre_block().add({-1, 1, 6}, {9, 7, 6.2}));
    CHECK(only_step(f) == "flatten map:any/cap");
    check_volume(f, 480 + 9 * 6 * 0.2);
    CHECK(box_of(f.made.solid).min.x == 0);
  }

  TEST_CASE("a slab with a name becomes as thick as the least length, one without goes") {
    const BoxBody body = ten_metre_block().add({3, -1.5, 3}, {7, 0, 3.15});
    const auto named = flattened(body, "balcony");
    CHECK(only_step(named) == "enlarge map:any/fin");
    check_volume(named, 480 + 4 * 1.5 * 0.25);
    CHECK(named.made.changed.size() == 1);
    const auto unnamed = flattened(body);
    CHECK(only_step(unnamed) == "omit map:any/fin");
    check_volume(unnamed, 480);
  }

  TEST_CASE("a slot is filled and what is thick enough stays") {
    const auto slot = flattened(ten_metre_block().remove({3, 0, 1}, {3.2, 4, 5}));
    CHECK(only_step(slot) == "omit map:any/enclosed");
    check_volume(slot, 480);
    CHECK(flattened(ten_metre_block().remove({3, 0, 1}, {4, 4, 5})).plan.steps.empty());
    CHECK(
        flattened(ten_metre_block().add({3, -1.5, 3}, {7, 0, 3.25}), "balcony").plan.steps.empty());
  }

  TEST_CASE("a wall with an outline that stays does not move") {
    Line line = line_of(ten_metre_block().add({0.5, -0.2, 0.5}, {9.5, 0, 5.5}).build());
    Feature window;
    window.sense = Sense::imprint;
    window.planes = {line.segmentation.features.at(0).planes.at(0)};
    for (const Facet& facet : line.solid.facets)
      if (line.solid.planes[facet.plane.index()].normal.y < -0.9 &&
          line.solid.vertices[static_cast<std::size_t>(facet.loops[0][0])].point.y == 0)
        window.source_polygons = facet.polygons;
    REQUIRE_FALSE(window.source_polygons.empty());
    line.segmentation.features.push_back(window);
    const Plan plan{kScale, {{{0}, "flatten", "test"}}, {}};
    const Generalised out = carry_out(line.context(), plan);
    REQUIRE(out.refused.size() == 1);
    CHECK(out.refused[0].reason == "an outline on its wall or roof would not move along");
    CHECK(volume_m3(out.solid) == volume_m3(line.solid));
  }
}
