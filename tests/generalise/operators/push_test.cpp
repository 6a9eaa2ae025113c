#include "generalise/generalise.h"
#include "generalise/operators/operators.h"
#include "generalise/series/scale_series.h"
#include "generalise/series/series_levels.h"
#include "kernel/base/index.h"
#include "tests/generalise/line.h"
#include "tests/generalise/operators/drawn_wall.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// A wall of 10 m with a door of 1 m on the ground and a window to either side.
BoxBody wall_with_door(double left, double right) {
  BoxBody body;
  body.add({0, 0, 0}, {10, 8, 6}).remove({4.5, 0, 0}, {5.5, 0.2, 2.2});
  for (const double x : {left, right}) body.remove({x, 0, 1}, {x + 1, 0.2, 2});
  return body;
}

bool is_door(const Feature& feature) { return feature.box.min.z < 0.1; }

/// The door grows to a width; what is no protrusion may make room.
Plan door_grows(const Line& line, double to_m, double gap_m) {
  Plan plan{1000, {}, {}};
  std::vector<FeatureId> openings;
  for (int i = 0; i < std::ssize(line.segmentation.features); ++i)
    if (line.segmentation.features[at(i)].sense == Sense::hole) openings.push_back({i});
  for (const FeatureId id : openings)
    if (is_door(line.segmentation.features[id.index()])) {
      plan.steps.push_back(
          {id, "enlarge", "test", {{"to", to_m}, {"gap", gap_m}}, {{"anchor", "sill"}}});
      plan.steps.back().openings = std::make_shared<const std::vector<FeatureId>>(openings);
    }
  return plan;
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("a door on the ground grows though the gap is more than the depth of its recess") {
    const Line line = line_of(wall_with_door(1, 8).build());
    const auto out = carried(line, door_grows(line, 2, 0.5));
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 1);
    CHECK(out.pushed.empty());
    CHECK(volume_m3(line.solid) - volume_m3(out.solid) == doctest::Approx(0.2 * 2.2));
  }

  TEST_CASE("a door that grows pushes the windows beside it along the wall") {
    const Line line = line_of(wall_with_door(3.2, 5.8).build());
    const Plan plan = door_grows(line, 2, 0.3);
    const auto out = carried(line, plan);
    CHECK(out.refused.empty());
    CHECK(out.removed.empty());
    CHECK(out.changed.size() == 3);
    REQUIRE(out.pushed.size() == 2);
    for (const PushedFeature& one : out.pushed) CHECK(one.by == plan.steps[0].feature);
    const auto windows = openings_in_front(out.solid);
    REQUIRE(windows.size() == 2);
    CHECK(windows[0].max.x == doctest::Approx(4 - 0.3).epsilon(1e-3));
    CHECK(windows[1].min.x == doctest::Approx(6 + 0.3).epsilon(1e-3));
    for (const Box& window : windows) {
      CHECK(window.min.z == 1);
      CHECK(window.max.x - window.min.x == doctest::Approx(1));
    }
    int told = 0;
    for (const FeatureOutcome& one : feature_outcomes(plan, out, line.table(), line.interpretation))
      if (one.reason == "pushed by " + line.table().id(plan.steps[0].feature)) {
        CHECK(one.outcome == "changed");
        CHECK(one.operation == "enlarge");
        ++told;
      }
    CHECK(told == 2);
  }

  TEST_CASE("a window that is pushed pushes the next one and no other moves") {
    const Line line = line_of(wall_with_door(2.9, 7.5).remove({1.8, 0, 1}, {2.8, 0.2, 2}).build());
    const auto out = carried(line, door_grows(line, 2, 0.3));
    CHECK(out.refused.empty());
    CHECK(out.pushed.size() == 2);
    const auto windows = openings_in_front(out.solid);
    REQUIRE(windows.size() == 3);
    CHECK(windows[1].max.x <= 4 - 0.3);
    // They come no nearer to each other than they were.
    CHECK(windows[1].min.x - windows[0].max.x == doctest::Approx(0.1).epsilon(1e-3));
    CHECK(windows[2].min.x == doctest::Approx(7.5));
  }

  TEST_CASE("where windows have no room to be pushed the door grows as far as it can") {
    const Line line = line_of(wall_with_door(3.2, 5.8).remove({0.4, 0, 1}, {3.1, 0.2, 2}).build());
    const auto out = carried(line, door_grows(line, 3.4, 0.1));
    CHECK(out.refused.empty());
    const auto windows = openings_in_front(out.solid);
    REQUIRE(windows.size() == 3);
    CHECK(windows[0].min.x == doctest::Approx(0.4));
    CHECK(windows[1].min.x == doctest::Approx(3.2));
    CHECK(std::ranges::find(out.changed, door_grows(line, 3.4, 0.1).steps[0].feature) !=
          out.changed.end());
  }

  TEST_CASE("a feature that has a step of its own is not pushed") {
    const Line line = line_of(wall_with_door(3.2, 5.8).build());
    Plan plan = door_grows(line, 2, 0.3);
    for (const FeatureId id : *plan.steps[0].openings)
      if (id != plan.steps[0].feature) plan.steps.push_back({id, "omit", "test"});
    std::ranges::sort(plan.steps, {}, &Step::feature);
    const auto out = carried(line, plan);
    CHECK(out.pushed.empty());
    CHECK(out.removed.size() == 2);
  }

  TEST_CASE("what is refused tells what is beside it and with which gap it would do") {
    BoxBody body;
    body.add({0, 0, 0}, {2, 8, 1.2}).remove({0.1, 0, 0.1}, {1.9, 0.2, 1.1});
    const Line line = line_of(body.build());
    Plan plan{1000, {}, {}};
    for (int i = 0; i < std::ssize(line.segmentation.features); ++i)
      plan.steps.push_back({{i}, "enlarge", "test", {{"to", 1.88}, {"gap", 0.5}}, {}});
    const auto out = carried(line, plan);
    REQUIRE(out.refused.size() == 1);
    const Hindrance& hindrance = out.refused[0].hindrance;
    REQUIRE(hindrance.needs.size() == 1);
    CHECK(hindrance.needs[0].what == "gap");
    CHECK(hindrance.needs[0].less + hindrance.needs[0].then == doctest::Approx(0.5));
    for (Step& step : plan.steps) step.numbers["gap"] = hindrance.needs[0].then;
    CHECK(carried(line, plan).changed.size() == 1);
    CHECK(reason_of(out.refused[0], line.table()).find("; it would with a gap of ") !=
          std::string::npos);
  }

  TEST_CASE("a row without room tells how much less of a gap and how many fewer would do") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    for (int i = 0; i < 6; ++i) body.remove({0.3 + 1.6 * i, 0, 3}, {1.7 + 1.6 * i, 0.2, 4});
    const Line line = line_of(body.build());
    Plan plan{1000, {}, {}};
    for (int i = 0; i < std::ssize(line.segmentation.features); ++i)
      plan.steps.push_back({{i}, "displace", "test", {{"gap", 0.3}}, {}});
    const auto out = carried(line, plan);
    REQUIRE(out.refused.size() == 6);
    const auto& needs = out.refused[0].hindrance.needs;
    REQUIRE(needs.size() == 2);
    CHECK(needs[0].what == "gap");
    CHECK(needs[1].what == "count");
    CHECK(needs[1].less == 1);
    CHECK(needs[1].then == 5);
    for (Step& step : plan.steps) step.numbers["gap"] = needs[0].then;
    const auto with_less = carried(line, plan);
    for (const auto& refused : with_less.refused) CHECK(refused.code == Code::none);
  }
}
