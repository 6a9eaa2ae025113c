#include "generalise/generalise.h"
#include "kernel/base/index.h"
#include "tests/generalise/line.h"
#include "tests/generalise/operators/drawn_wall.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// A window in the middle of a wall with a sill below it, a lintel above it and a shutter to either
/// side, all 3 cm off it.
BoxBody& add_dressed_window(BoxBody& body, double x) {
  body.remove({x, 0, 3}, {x + 1, 0.2, 4});
  body.add({x - 0.05, -0.12, 2.91}, {x + 1.05, 0, 2.97});
  body.add({x - 0.1, -0.08, 4.03}, {x + 1.1, 0, 4.15});
  body.add({x - 0.43, -0.04, 3}, {x - 0.03, 0, 4});
  return body.add({x + 1.03, -0.04, 3}, {x + 1.43, 0, 4});
}

/// A plan for the openings, to each of which the decor belongs whose middle is nearest.
Plan dressed_plan(const Line& line, const Step& like, Belonging belonging) {
  const auto& features = line.segmentation.features;
  const auto middle = [&](int i) {
    return 0.5 * (features[at(i)].box.min + features[at(i)].box.max);
  };
  Plan plan{1000, {}, {}};
  for (int i = 0; i < std::ssize(features); ++i)
    if (features[at(i)].sense == Sense::hole) {
      plan.steps.push_back(like);
      plan.steps.back().feature = {i};
      plan.steps.back().belonging = belonging;
    }
  for (int i = 0; i < std::ssize(features); ++i)
    if (features[at(i)].sense == Sense::protrusion) {
      Step& its = *std::ranges::min_element(plan.steps, {}, [&](const Step& step) {
        return length(middle(step.feature.value) - middle(i));
      });
      its.with.push_back({i});
      if (belonging != Belonging::goes) its.follows.push_back({i});
    }
  return plan;
}

Step enlarging(double to_m, double gap_m, const char* anchor = "centre") {
  return {{}, "enlarge", "test", {{"to", to_m}, {"gap", gap_m}}, {{"anchor", anchor}}};
}

void check_box(const Box& box, Vec3 min, Vec3 max) {
  for (const auto& [is, wanted] : {std::pair{box.min, min}, {box.max, max}}) {
    CHECK(is.x == doctest::Approx(wanted.x));
    CHECK(is.y == doctest::Approx(wanted.y));
    CHECK(is.z == doctest::Approx(wanted.z));
  }
}

/// What became of the features, by reason, "" left out.
std::map<std::string, int> reasons_of(const Line& line, const Plan& plan, const Generalised& out) {
  std::map<std::string, int> found;
  for (const FeatureOutcome& one : feature_outcomes(plan, out, line.table(), line.interpretation))
    if (!one.reason.empty()) ++found[one.reason];
  return found;
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("decor grows with its window: distances and overhangs stay") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    const Line line = line_of(add_dressed_window(body, 4).build());
    REQUIRE(line.segmentation.features.size() == 5);
    const Plan plan = dressed_plan(line, enlarging(1.5, 0.1), Belonging::grows);
    const auto out = carried(line, plan);
    CHECK(out.refused.empty());
    CHECK(out.removed.empty());
    CHECK(out.changed.size() == 5);
    const auto drawn = openings_in_front(out.solid);
    REQUIRE(drawn.size() == 5);
    check_box(drawn[0], {3.32, 0, 2.75}, {3.72, 0, 4.25});  // a shutter
    check_box(drawn[1], {3.65, 0, 4.28}, {5.35, 0, 4.4});   // the lintel
    check_box(drawn[2], {3.7, 0, 2.66}, {5.3, 0, 2.72});    // the sill
    check_box(drawn[3], {3.75, 0, 2.75}, {5.25, 0, 4.25});
    check_box(drawn[4], {5.28, 0, 2.75}, {5.68, 0, 4.25});
    CHECK(volume_m3(out.solid) == doctest::Approx(480 - 2.25 * 0.2 + 1.6 * 0.06 * 0.12 +
                                                  1.7 * 0.12 * 0.08 + 2 * 0.4 * 1.5 * 0.04)
                                      .epsilon(1e-6));
    const std::string window = line.table().id(plan.steps[0].feature);
    CHECK(reasons_of(line, plan, out) == std::map<std::string, int>{{"grew with " + window, 4}});
  }

  TEST_CASE("decor that moves keeps its size and its distance from the edge that it lies along") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    const Line line = line_of(add_dressed_window(body, 4).build());
    const Plan plan = dressed_plan(line, enlarging(1.5, 0.1, "sill"), Belonging::moves);
    const auto out = carried(line, plan);
    CHECK(out.removed.empty());
    const auto drawn = openings_in_front(out.solid);
    REQUIRE(drawn.size() == 5);
    check_box(drawn[0], {3.32, 0, 3.25}, {3.72, 0, 4.25});
    check_box(drawn[1], {3.75, 0, 3}, {5.25, 0, 4.5});
    check_box(drawn[2], {3.9, 0, 4.53}, {5.1, 0, 4.65});
    check_box(drawn[3], {3.95, 0, 2.91}, {5.05, 0, 2.97});
    check_box(drawn[4], {5.28, 0, 3.25}, {5.68, 0, 4.25});
    const std::string window = line.table().id(plan.steps[0].feature);
    CHECK(reasons_of(line, plan, out) == std::map<std::string, int>{{"moved with " + window, 4}});
  }

  TEST_CASE("a sill that its window stands on stays under it") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6}).add({3.9, -0.1, 3.4}, {5.1, 0, 3.5});
    const Line line = line_of(body.remove({4, 0, 3.5}, {5, 0.2, 4.5}).build());
    const Plan plan = dressed_plan(line, enlarging(1.5, 0.1), Belonging::grows);
    REQUIRE(plan.steps.size() == 1);
    Invariants fine;
    fine.least_edge_m = 0.125;  // longer than the sill overhangs
    const auto out = generalise(line.context(fine), plan);
    REQUIRE(out.value);
    CHECK(is_closed(out.value->solid));
    CHECK(out.issues.empty());
    CHECK(out.value->removed.empty());
    CHECK(out.value->changed.size() == 2);
    CHECK(volume_m3(out.value->solid) ==
          doctest::Approx(480 - 2.25 * 0.2 + 1.7 * 0.1 * 0.1).epsilon(1e-6));
    CHECK(out.value->solid.facets.size() == line.solid.facets.size());
  }

  TEST_CASE("decor without room goes, its window grows, and the reason is told") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6}).add({5.75, -0.3, 0}, {6.25, 0, 6});  // a pilaster
    const Line line = line_of(add_dressed_window(body, 4).build());
    Plan plan = dressed_plan(line, enlarging(1.5, 0.1), Belonging::grows);
    const auto is_pilaster = [&](FeatureId id) {
      return line.segmentation.features[id.index()].box.min.z == 0;
    };
    std::erase_if(plan.steps[0].with, is_pilaster);
    std::erase_if(plan.steps[0].follows, is_pilaster);
    const auto out = generalise(line.context(), plan);
    REQUIRE(out.value);
    CHECK(out.value->refused.empty());
    CHECK(out.value->removed.size() == 1);
    CHECK(out.value->changed.size() == 4);
    REQUIRE(out.issues.size() == 1);
    CHECK(out.issues[0].code == Code::G424);
    CHECK(out.issues[0].severity == Severity::note);
    const std::string window = line.table().id(plan.steps[0].feature);
    CHECK(reasons_of(line, plan, *out.value) ==
          std::map<std::string, int>{
              {"grew with " + window, 3},
              {"went along with " + window + ": its outline does not fit into the facet", 1}});
  }

  TEST_CASE("decor at a corner of its window goes with it") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6}).remove({4, 0, 3}, {5, 0.2, 4});
    const Line line = line_of(body.add({5.1, -0.1, 2.7}, {5.3, 0, 2.9}).build());
    const Plan plan = dressed_plan(line, enlarging(1.5, 0.1), Belonging::grows);
    const auto out = carried(line, plan);
    CHECK(out.changed == std::vector{plan.steps[0].feature});
    CHECK(out.removed.size() == 1);
    REQUIRE(out.along.size() == 1);
    CHECK(out.along[0].reason == "it lies along none of the edges of what it belongs to");
  }

  TEST_CASE("decor that would break an invariant goes, and its window is enlarged") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6}).remove({4, 0, 3}, {5, 0.2, 4});
    const Line line = line_of(body.add({3.9, -0.3, 2.7}, {5.1, 0, 2.9}).build());
    const Plan plan = dressed_plan(line, enlarging(1.5, 0.1), Belonging::grows);
    Invariants invariants;
    invariants.limits.volume_pct = 0.07;   // of 480 m³: the window and the sill take 0.32 m³
    invariants.limits.overhang_pct = 0.1;  // of 80 m²: the sill reaches out by 0.15 m² more
    const auto out = generalise(line.context(invariants), plan);
    REQUIRE(out.value);
    for (const auto& refused : out.value->refused) CHECK(refused.reason == "");
    CHECK(out.value->changed == std::vector{plan.steps[0].feature});
    REQUIRE(out.value->along.size() == 1);
    CHECK_FALSE(out.value->along[0].reason.empty());
  }

  TEST_CASE("a strip has one sill if sills grow, and none if they only move") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    for (const double x : {1.0, 3.0, 5.0})
      body.remove({x, 0, 3}, {x + 1, 0.2, 4}).add({x - 0.1, -0.1, 2.8}, {x + 1.1, 0, 2.9});
    const Line line = line_of(body.build());
    const Step strip{{}, "aggregate", "test", {{"gap", 0.1}}};
    const Plan growing = dressed_plan(line, strip, Belonging::grows);
    REQUIRE(growing.steps.size() == 3);
    const auto grown = carried(line, growing);
    const auto drawn = openings_in_front(grown.solid);
    REQUIRE(drawn.size() == 2);
    check_box(drawn[0], {0.9, 0, 3}, {6.1, 0, 3.1});  // 0.1 m below the strip
    check_box(drawn[1], {1, 0, 3.2}, {6, 0, 3.8});
    const auto moved = carried(line, dressed_plan(line, strip, Belonging::moves));
    CHECK(openings_in_front(moved.solid).size() == 1);
  }

  TEST_CASE("typified windows keep their sills") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    for (const double x : {1.0, 3.0, 5.0, 7.0})
      body.remove({x, 0, 3}, {x + 1, 0.2, 4}).add({x - 0.1, -0.1, 2.8}, {x + 1.1, 0, 2.9});
    const Line line = line_of(body.build());
    const Plan plan = dressed_plan(line, {{}, "typify", "test", {{"ratio", 0.5}, {"gap", 0.1}}},
                                   Belonging::grows);
    const auto out = carried(line, plan);
    CHECK(out.removed.size() == 4);
    CHECK(out.following.size() == 2);
    CHECK(openings_in_front(out.solid).size() == 4);
  }

  TEST_CASE("a window whose frame goes is drawn in the wall that the frame stood on") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6}).add({3.9, -0.05, 2.9}, {5.1, 0, 4.1});
    const Line line = line_of(body.remove({4, -0.05, 3}, {5, 0.2, 4}).build());
    REQUIRE(line.segmentation.features.size() == 2);
    Plan plan = dressed_plan(line, enlarging(1.5, 0.1), Belonging::goes);
    REQUIRE(plan.steps.size() == 1);
    const auto grown = carried(line, plan);
    CHECK(grown.refused.empty());
    CHECK(grown.removed.size() == 1);
    CHECK(grown.changed == std::vector{plan.steps[0].feature});
    CHECK(volume_m3(grown.solid) == doctest::Approx(480 - 2.25 * 0.2).epsilon(1e-6));
    plan.steps[0].operation = "omit";
    CHECK(carried(line, plan).solid.facets.size() == 6);
  }

  TEST_CASE("a window that is pushed takes its sill along") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6}).remove({4.5, 0, 0}, {5.5, 0.2, 2.2});
    body.remove({5.8, 0, 1}, {6.8, 0.2, 2}).add({5.7, -0.1, 0.8}, {6.9, 0, 0.9});
    const Line line = line_of(body.build());
    Plan plan = dressed_plan(line, enlarging(2, 0.3, "sill"), Belonging::grows);
    REQUIRE(plan.steps.size() == 2);
    const bool is_first = line.segmentation.features[plan.steps[0].feature.index()].box.min.z < 0.5;
    const Step window = plan.steps[is_first ? 1 : 0];
    plan.steps.erase(plan.steps.begin() + (is_first ? 1 : 0));
    plan.steps[0].openings = std::make_shared<const std::vector<FeatureId>>(
        std::vector{std::min(plan.steps[0].feature, window.feature),
                    std::max(plan.steps[0].feature, window.feature)});
    plan.steps[0].follows_pushed =
        std::make_shared<const BelongingOf>(BelongingOf{{window.feature, window.follows}});
    const auto out = carried(line, plan);
    CHECK(out.removed.empty());
    CHECK(out.pushed.size() == 1);
    REQUIRE(out.following.size() == 1);
    CHECK(out.following[0].with == window.feature);
    const auto drawn = openings_in_front(out.solid);
    REQUIRE(drawn.size() == 2);
    check_box(drawn[0], {6.201, 0, 0.8}, {7.401, 0, 0.9});
    check_box(drawn[1], {6.301, 0, 1}, {7.301, 0, 2});
  }
}
