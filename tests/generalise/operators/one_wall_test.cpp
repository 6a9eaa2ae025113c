#include "generalise/generalise.h"
#include "kernel/base/index.h"
#include "tests/generalise/line.h"
#include "tests/generalise/operators/drawn_wall.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// Upstairs a row that a pilaster divides and a sill below its first window, on the ground a door
/// with a window to either side.
Line full_wall() {
  BoxBody body;
  body.add({0, 0, 0}, {10, 8, 8}).add({5.2, -0.3, 4.5}, {5.8, 0, 8});
  body.add({0.4, -0.1, 4.9}, {1.6, 0, 5});
  for (const double x : {0.5, 2.0, 3.5, 6.5, 8.0}) body.remove({x, 0, 5}, {x + 1, 0.2, 6});
  body.remove({4.5, 0, 0}, {5.5, 0.2, 2.2});
  for (const double x : {3.2, 5.8}) body.remove({x, 0, 1}, {x + 1, 0.2, 2});
  return line_of(body.build());
}

/// The features by what they are.
struct WallParts {
  std::vector<FeatureId> row, beside_door, openings;
  FeatureId door{}, sill{};
};

WallParts parts_of(const Line& line) {
  WallParts parts;
  for (int i = 0; i < std::ssize(line.segmentation.features); ++i) {
    const Feature& feature = line.segmentation.features[at(i)];
    if (feature.sense == Sense::hole) {
      parts.openings.push_back({i});
      if (feature.box.min.z > 4)
        parts.row.push_back({i});
      else if (feature.box.min.z > 0.5)
        parts.beside_door.push_back({i});
      else
        parts.door = {i};
    } else if (feature.box.max.z < 5.1) {
      parts.sill = {i};
    }
  }
  std::ranges::sort(parts.row, {},
                    [&](FeatureId id) { return line.segmentation.features[id.index()].box.min.x; });
  return parts;
}

Plan wall_plan(const WallParts& parts) {
  Plan plan{1000, {}, {}};
  for (const FeatureId id : parts.row)
    plan.steps.push_back({id, "aggregate", "row", {{"gap", 0.1}}, {}});
  plan.steps.front().with = {parts.sill};
  plan.steps.push_back(
      {parts.door, "enlarge", "door", {{"to", 2}, {"gap", 0.3}}, {{"anchor", "sill"}}});
  plan.steps.back().openings = std::make_shared<const std::vector<FeatureId>>(parts.openings);
  std::ranges::sort(plan.steps, {}, &Step::feature);
  return plan;
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("a row that is divided, decor that goes along and a door that pushes share a wall") {
    const Line line = full_wall();
    const WallParts parts = parts_of(line);
    REQUIRE(parts.row.size() == 5);
    REQUIRE(parts.beside_door.size() == 2);
    REQUIRE(parts.sill.is_valid());
    const Plan plan = wall_plan(parts);
    const auto out = carried(line, plan);
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 5);  // two strips, the door, two windows
    CHECK(out.removed.size() == 4);  // the rest of the row, the sill
    CHECK(out.pushed.size() == 2);
    CHECK(volume_m3(out.solid) ==
          doctest::Approx(volume_m3(line.solid) - 1.2 * 0.1 * 0.1 - 2.2 * 0.2).epsilon(1e-5));
    std::map<std::string, std::string> reasons;
    for (const FeatureOutcome& one : feature_outcomes(plan, out, line.table(), line.interpretation))
      reasons[one.feature] = one.reason;
    const auto id = [&](FeatureId feature) { return line.table().id(feature); };
    CHECK(reasons[id(parts.sill)] == "went along with " + id(parts.row[0]));
    for (const int i : {1, 2})
      CHECK(reasons[id(parts.row[at(i)])] == "went along with " + id(parts.row[0]));
    CHECK(reasons[id(parts.row[3])].empty());
    CHECK(reasons[id(parts.row[4])] == "went along with " + id(parts.row[3]));
    for (const FeatureId window : parts.beside_door)
      CHECK(reasons[id(window)] == "pushed by " + id(parts.door));
  }

  TEST_CASE("what an invariant keeps does not go along with another feature") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6}).add({3.9, -0.5, 3.2}, {5.1, 0, 3.5});
    const Line line = line_of(body.remove({4, 0, 3.5}, {5, 0.2, 4.5}).build());
    REQUIRE(line.segmentation.features.size() == 2);
    const bool is_first = line.segmentation.features[0].sense == Sense::protrusion;
    const FeatureId slab{is_first ? 0 : 1}, window{is_first ? 1 : 0};
    Plan plan{1000, {}, {}};
    plan.steps = {
        {slab, "omit", "slabs"},
        {window, "enlarge", "windows", {{"to", 1.1}, {"gap", 0.02}}, {{"anchor", "sill"}}}};
    plan.steps[1].with = {slab};
    std::ranges::sort(plan.steps, {}, &Step::feature);
    Invariants invariants;
    invariants.limits.volume_pct = 0.02;  // of 480 m³: less than the slab, more than the growth
    const auto out = generalise(line.context(invariants), plan);
    REQUIRE(out.value);
    CHECK(out.value->removed.empty());
    CHECK(out.value->changed == std::vector{window});
    REQUIRE(out.value->refused.size() == 1);
    CHECK(out.value->refused[0].feature == slab);
    CHECK(out.value->refused[0].code == Code::G405);
  }
}
