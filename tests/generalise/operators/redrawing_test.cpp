#include "generalise/generalise.h"
#include "generalise/operators/operators.h"
#include "io/writer.h"
#include "tests/generalise/line.h"
#include "tests/generalise/operators/drawn_wall.h"
#include "tests/support/flush.h"
#include "tests/support/houses.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// A block of 10 x 8 x 6 m with four windows of 1 m x 1 m in a row and a door on the ground.
BoxBody facade() {
  BoxBody body;
  body.add({0, 0, 0}, {10, 8, 6});
  for (const double x : {1.0, 3.0, 5.0, 7.0}) body.remove({x, 0, 3.5}, {x + 1, 0.2, 4.5});
  return body.remove({4, 0, 0}, {5, 0.2, 2.2});
}

/// One step for each feature that `is_meant`.
template <class Meant>
Plan plan_for(const Line& line, const Step& like, Meant is_meant) {
  Plan plan{1000, {}, {}};
  for (int i = 0; i < std::ssize(line.segmentation.features); ++i)
    if (is_meant(line.segmentation.features[static_cast<std::size_t>(i)])) {
      plan.steps.push_back(like);
      plan.steps.back().feature = {i};
    }
  return plan;
}

bool is_high(const Feature& feature) { return feature.box.min.z > 3; }
bool is_low(const Feature& feature) { return feature.box.min.z < 0.1; }
bool is_any(const Feature&) { return true; }

Step step(const std::string& operation, std::map<std::string, double> numbers = {},
          std::map<std::string, std::string> words = {}) {
  return {{}, operation, "test", std::move(numbers), std::move(words)};
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("windows of a storey become one strip that keeps their area") {
    const Line line = line_of(facade().build());
    const auto out = carried(line, plan_for(line, step("aggregate"), is_high));
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 1);
    CHECK(out.removed.size() == 3);
    CHECK(volume_m3(out.solid) == doctest::Approx(volume_m3(line.solid)).epsilon(1e-6));
    CHECK(out.solid.facets.size() == line.solid.facets.size() - 15);
  }

  TEST_CASE("a row of four windows becomes two with the same area and aspect") {
    const Line line = line_of(facade().build());
    const auto out = carried(line, plan_for(line, step("typify", {{"ratio", 0.5}}), is_high));
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 2);
    CHECK(volume_m3(out.solid) == doctest::Approx(volume_m3(line.solid)).epsilon(1e-5));
    CHECK(out.solid.facets.size() == line.solid.facets.size() - 10);
  }

  TEST_CASE("typified windows grow as far as the wall has room") {
    const Line line = line_of(facade().add({0, -0.2, 4.7}, {10, 0, 4.9}).build());
    const auto is_window = [](const Feature& f) { return f.sense == Sense::hole && is_high(f); };
    const auto out = carried(line, plan_for(line, step("typify", {{"ratio", 0.5}}), is_window));
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 2);
    CHECK(out.removed.size() == 2);
  }

  TEST_CASE("a door grows from its sill on the ground") {
    const Line line = line_of(facade().build());
    const auto out = carried(
        line,
        plan_for(line, step("enlarge", {{"to", 2.5}, {"gap", 0.1}}, {{"anchor", "sill"}}), is_low));
    CHECK(out.refused.empty());
    CHECK(volume_m3(out.solid) ==
          doctest::Approx(volume_m3(line.solid) + 1 * 2.2 * 0.2 - 2.5 * 2.5 * 0.2).epsilon(1e-6));
    CHECK(box_of(out.solid).min.z == 0);
  }

  TEST_CASE("what cannot grow for its neighbours stays as it was") {
    const Line line = line_of(facade().build());
    const auto out =
        carried(line, plan_for(line, step("enlarge", {{"to", 3}, {"gap", 1.4}}), is_high));
    CHECK_FALSE(out.refused.empty());
    for (const auto& refused : out.refused) CHECK(refused.code == Code::G403);
    CHECK(out.removed.empty());
    CHECK(volume_m3(out.solid) <= volume_m3(line.solid));
  }

  TEST_CASE("a row of windows with panes of two depths is typified with the mean depth") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    for (const double x : {1.0, 3.0, 5.0, 7.0})
      body.remove({x, 0, 3.5}, {x + 1, 0.1, 4.5}).remove({x, 0.1, 3.5}, {x + 0.5, 0.3, 4.5});
    const Line line = line_of(body.build());
    const auto is_opening = [](const Feature& f) {
      return f.sense == Sense::hole && !f.parent.is_valid() && f.box.min.y == 0;
    };
    const auto out = carried(line, plan_for(line, step("typify", {{"ratio", 0.5}}), is_opening));
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 2);
    CHECK(volume_m3(out.solid) == doctest::Approx(volume_m3(line.solid)).epsilon(1e-5));
    CHECK(out.solid.facets.size() == 6 + 2 * 5);
  }

  TEST_CASE("a row with something between its new places is thinned out at its own ones") {
    // The second of three would stand at 4 m, where there is a pilaster.
    const Line line = line_of(facade().add({4.2, -0.3, 2.5}, {4.8, 0, 6}).build());
    const auto is_window = [](const Feature& f) { return f.sense == Sense::hole && is_high(f); };
    const Plan plan = plan_for(line, step("typify", {{"ratio", 0.75}, {"gap", 0.1}}), is_window);
    REQUIRE(plan.steps.size() == 4);
    const auto out = carried(line, plan);
    CHECK(out.refused.empty());
    REQUIRE(out.removed.size() == 1);
    CHECK(line.segmentation.features[out.removed[0].index()].box.min.x == doctest::Approx(3));
  }

  TEST_CASE("a row that something divides becomes a strip on either side of it") {
    BoxBody body;
    body.add({0, 0, 0}, {12, 8, 6}).add({5.2, -0.3, 0}, {5.8, 0, 6});
    for (const double x : {0.5, 2.0, 3.5, 6.5, 8.0}) body.remove({x, 0, 3.5}, {x + 1, 0.2, 4.5});
    body.add({9.3, -0.3, 0}, {9.9, 0, 6}).remove({10.5, 0, 3.5}, {11.5, 0.2, 4.5});
    const Line line = line_of(body.build());
    const auto is_window = [](const Feature& f) { return f.sense == Sense::hole; };
    const Plan plan = plan_for(line, step("aggregate", {{"gap", 0.1}}), is_window);
    REQUIRE(plan.steps.size() == 6);
    const auto out = generalise(line.context(), plan);
    REQUIRE(out.value);
    CHECK(out.issues.empty());
    CHECK(out.value->changed.size() == 2);
    CHECK(out.value->removed.size() == 3);
    CHECK(volume_m3(out.value->solid) == doctest::Approx(volume_m3(line.solid)).epsilon(1e-6));
    std::set<std::string> reasons;
    for (const FeatureOutcome& one :
         feature_outcomes(plan, *out.value, line.table(), line.interpretation))
      if (one.outcome == "kept") reasons.insert(one.reason);
    CHECK(reasons == std::set<std::string>{"", "it is alone between other parts"});
  }

  TEST_CASE("a door with a plinth before its wall grows and stands on the plinth") {
    const Line line = line_of(BoxBody()
                                  .add({0, 0, 0}, {10, 8, 6})
                                  .add({0, -0.1, 0}, {10, 0, 0.5})
                                  .remove({4, 0, 0.5}, {5, 0.2, 2.5})
                                  .build());
    const auto is_door = [](const Feature& f) { return f.sense == Sense::hole; };
    const auto out = carried(
        line, plan_for(line, step("enlarge", {{"to", 1.5}, {"gap", 0.1}}, {{"anchor", "sill"}}),
                       is_door));
    CHECK(out.refused.empty());
    CHECK(volume_m3(out.solid) ==
          doctest::Approx(volume_m3(line.solid) - 0.5 * 2 * 0.2).epsilon(1e-6));
  }

  TEST_CASE("the sill of a window goes along when the window grows, and stays when it is refused") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6}).add({3.9, -0.1, 3.4}, {5.1, 0, 3.5});
    const Line line = line_of(body.remove({4, 0, 3.5}, {5, 0.2, 4.5}).build());
    const auto find = [&](Sense sense) {
      const auto found = std::ranges::find(line.segmentation.features, sense, &Feature::sense);
      return FeatureId{static_cast<int>(found - line.segmentation.features.begin())};
    };
    const FeatureId sill = find(Sense::protrusion), window = find(Sense::hole);
    Plan plan{1000, {step("enlarge", {{"to", 2}, {"gap", 0.1}})}, {}};
    plan.steps[0].feature = window;
    plan.steps[0].with = {sill};
    const auto out = carried(line, plan);
    CHECK(out.refused.empty());
    CHECK(out.changed == std::vector{window});
    CHECK(out.removed == std::vector{sill});
    CHECK(volume_m3(out.solid) == doctest::Approx(480 - 2 * 2 * 0.2).epsilon(1e-6));
    for (const FeatureOutcome& one :
         feature_outcomes(plan, out, line.table(), line.interpretation)) {
      const bool is_sill = one.feature == line.table().id(sill);
      CHECK(one.outcome == (is_sill ? "went along" : "changed"));
      CHECK(one.reason == (is_sill ? "went along with " + line.table().id(window) : ""));
      CHECK(one.operation == "enlarge");
    }

    plan.steps[0].numbers["gap"] = 9;
    const auto refused = carried(line, plan);
    CHECK(refused.refused.size() == 1);
    CHECK(refused.removed.empty());
    CHECK(volume_m3(refused.solid) == doctest::Approx(volume_m3(line.solid)).epsilon(1e-9));

    plan.steps[0] = step("omit");
    plan.steps[0].feature = window;
    plan.steps[0].with = {sill};
    const auto omitted = carried(line, plan);
    CHECK(omitted.removed.size() == 2);
    CHECK(omitted.solid.facets.size() == 6);
  }

  TEST_CASE("openings that stand before their wall are enlarged and typified as blocks") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    for (const double x : {1.0, 3.0, 5.0, 7.0}) body.add({x, -0.08, 3.5}, {x + 1, 0, 4.5});
    const Line line = line_of(body.build());
    const auto is_frame = [](const Feature& f) { return f.sense == Sense::protrusion; };
    const auto enlarged =
        carried(line, plan_for(line, step("enlarge", {{"to", 1.5}, {"gap", 0.1}}), is_frame));
    CHECK(enlarged.refused.empty());
    CHECK(enlarged.changed.size() == 4);
    CHECK(volume_m3(enlarged.solid) == doctest::Approx(480 + 4 * 1.5 * 1.5 * 0.08).epsilon(1e-6));
    const auto typified =
        carried(line, plan_for(line, step("typify", {{"ratio", 0.5}, {"gap", 0.1}}), is_frame));
    CHECK(typified.refused.empty());
    CHECK(typified.removed.size() == 2);
    CHECK(volume_m3(typified.solid) == doctest::Approx(480 + 4 * 0.08).epsilon(1e-5));
  }

  TEST_CASE("flush windows are typified and enlarged as outlines") {
    Building building = plain_block();
    for (const double x : {1.0, 3.0, 5.0, 7.0}) add_pane(building, x, 3.5, x + 1, 4.5);
    const Line line = line_of(building);
    const auto is_pane = [](const Feature& f) { return f.sense == Sense::imprint; };
    const auto typified = carried(line, plan_for(line, step("typify", {{"ratio", 0.5}}), is_pane));
    CHECK(typified.refused.empty());
    CHECK(typified.changed.size() == 2);
    CHECK(typified.removed.size() == 2);
    CHECK(typified.solid.facets.size() == 6 + 2);
    const auto enlarged =
        carried(line, plan_for(line, step("enlarge", {{"to", 1.5}, {"gap", 0.1}}), is_pane));
    CHECK(enlarged.refused.empty());
    CHECK(enlarged.changed.size() == 4);
    CHECK(enlarged.solid.facets.size() == 6 + 4);
    CHECK(volume_m3(enlarged.solid) == volume_m3(line.solid));
  }

  TEST_CASE("a window with room above it only grows upwards") {
    BoxBody body;
    body.add({0, 0, 0}, {3.2, 8, 6});
    for (const double x : {0.4, 1.8}) body.remove({x, 0, 3.5}, {x + 1, 0.2, 4.5});
    const Line line = line_of(body.build());
    const auto out =
        carried(line, plan_for(line, step("enlarge", {{"to", 1.8}, {"gap", 0.35}}), is_high));
    CHECK(out.changed.size() == 2);
    for (const Vertex& v : out.solid.vertices)
      if (v.point.y == 0 && v.point.z > 2 && v.point.z < 5) {
        CHECK(v.point.z != doctest::Approx(3.5));
        CHECK(v.point.z != doctest::Approx(4.5));
      }
  }

  TEST_CASE("what is as its operator wants it is kept and not refused") {
    const Line line = line_of(facade().build());
    const Plan plan = plan_for(line, step("enlarge", {{"to", 0.5}}), is_high);
    const auto out = generalise(line.context(), plan);
    REQUIRE(out.value);
    CHECK(out.issues.empty());
    CHECK(out.value->changed.empty());
    int kept = 0;
    for (const FeatureOutcome& one :
         feature_outcomes(plan, *out.value, line.table(), line.interpretation)) {
      CHECK(one.outcome == "kept");
      CHECK(one.code == Code::none);
      kept += one.reason == "it is large enough" ? 1 : 0;
    }
    CHECK(kept == 4);
  }

  TEST_CASE("a balcony that merges keeps its shape and is named by its slopes") {
    const Line line =
        line_of(BoxBody().add({0, 0, 0}, {10, 8, 6}).add({2, -1.2, 3}, {5, 0, 3.2}).build());
    const auto is_balcony = [](const Feature& f) { return f.box.min.y < 0; };
    auto out = carried(line, plan_for(line, step("merge"), is_balcony));
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 1);
    CHECK(out.removed.empty());
    CHECK(volume_m3(out.solid) == volume_m3(line.solid));
    const Redrawn redrawn = redraw(line.context(), std::move(out));
    CHECK(redrawn.labelled.installations.empty());
  }

  TEST_CASE("a chimney becomes a block and a balcony a slab") {
    const Line line = line_of(BoxBody()
                                  .add({0, 0, 0}, {10, 8, 6})
                                  .add({4, 4, 6}, {4.4, 4.5, 7.2})
                                  .add({2, -1.2, 3}, {5, 0, 3.2})
                                  .build());
    const auto is_chimney = [](const Feature& f) { return f.box.min.z > 5.9; };
    const auto chimney = carried(
        line,
        plan_for(line, step("symbolise", {{"to", 1}}, {{"with", "chimney_block"}}), is_chimney));
    CHECK(chimney.refused.empty());
    CHECK(volume_m3(chimney.solid) ==
          doctest::Approx(volume_m3(line.solid) + 1.2 - 0.4 * 0.5 * 1.2).epsilon(1e-6));
    const auto is_balcony = [](const Feature& f) { return f.box.min.y < 0; };
    const auto balcony = carried(
        line,
        plan_for(line, step("symbolise", {{"to", 0.5}}, {{"with", "balcony_box"}}), is_balcony));
    CHECK(balcony.refused.empty());
    CHECK(volume_m3(balcony.solid) == doctest::Approx(volume_m3(line.solid)).epsilon(1e-6));
  }

  TEST_CASE("a chimney on a ridge becomes a block across it") {
    const Line line = line_of(ridge_chimney());
    const auto is_chimney = [](const Feature& f) {
      return f.sense == Sense::protrusion && !f.parent.is_valid() && f.box.max.z > 10;
    };
    const Plan plan =
        plan_for(line, step("symbolise", {{"to", 1}, {"gap", 0.1}}, {{"with", "chimney_block"}}),
                 is_chimney);
    const auto out = carried(line, plan);
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 1);
    // Over y 3.5 to 4.5 the roof is 8.8125 m high on the average.
    CHECK(volume_m3(out.solid) ==
          doctest::Approx(volume_m3(solid_of(gabled_house())) + 11 - 8.8125).epsilon(1e-6));
    CHECK(out.solid.facets.size() == line.solid.facets.size());
  }

  TEST_CASE("a chimney too near to a ridge for its block has it beside or across the ridge") {
    const Line line =
        line_of(ConvexBody().add(gable()).add(box({5, 3.2, 5}, {5.6, 3.7, 11})).build());
    const auto is_chimney = [](const Feature& f) { return f.box.max.z > 10; };
    const auto out = carried(
        line,
        plan_for(line, step("symbolise", {{"to", 1}, {"gap", 0.1}}, {{"with", "chimney_block"}}),
                 is_chimney));
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 1);
  }

  TEST_CASE("roof windows with upright reveals are typified without a new direction") {
    ConvexBody body;
    body.add(gable());
    for (const double x : {1.0, 4.0, 7.0, 10.0})
      body.remove({{{-1, 0, 0}, -x},
                   {{1, 0, 0}, x + 0.8},
                   {{0, -1, 0}, -1},
                   {{0, 1, 0}, 2},
                   {{0, 3, -4}, -23.8}});
    const Line line = line_of(body.build());
    const auto is_window = [](const Feature& f) { return f.sense == Sense::hole; };
    const auto out =
        carried(line, plan_for(line, step("typify", {{"ratio", 0.5}, {"gap", 0.1}}), is_window));
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 2);
    std::set<std::array<std::int64_t, 3>> before, after;
    for (const Facet& facet : line.solid.facets)
      before.insert(line.solid.planes[facet.plane.index()].coefficients);
    for (const Facet& facet : out.solid.facets)
      after.insert(out.solid.planes[facet.plane.index()].coefficients);
    CHECK(std::ranges::includes(before, after));
  }

  TEST_CASE("a slab and its parapet become one block") {
    const Line line = line_of(BoxBody()
                                  .add({0, 0, 0}, {10, 8, 6})
                                  .add({2, -1.2, 3}, {5, 0, 3.2})
                                  .add({2, -1.2, 3.2}, {5, -1.1, 4})
                                  .add({2, -1.2, 3.2}, {2.1, 0, 4})
                                  .add({4.9, -1.2, 3.2}, {5, 0, 4})
                                  .build());
    const auto is_balcony = [](const Feature& f) {
      return !f.parent.is_valid() && !f.host.is_valid() && f.box.min.y < -1;
    };
    const Plan plan =
        plan_for(line, step("aggregate", {{"gap", 0.1}}, {{"into", "block"}}), is_balcony);
    REQUIRE(plan.steps.size() == 1);
    const auto out = carried(line, plan);
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 1);
    CHECK(volume_m3(out.solid) == doctest::Approx(480 + 3 * 1.2).epsilon(1e-6));
    CHECK(out.solid.facets.size() == 11);
  }

  TEST_CASE("a window that collapses leaves its outline and no recess") {
    const Line line = line_of(facade().build());
    const auto out = carried(line, plan_for(line, step("collapse"), is_high));
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 4);
    CHECK(volume_m3(out.solid) == doctest::Approx(volume_m3(line.solid) + 4 * 0.2).epsilon(1e-6));
    CHECK(out.solid.facets.size() == line.solid.facets.size() - 4 * 5 + 4);
  }

  TEST_CASE("every operator on every feature of the samples leaves closed solids in the file") {
    std::vector<Step> operators{
        step("enlarge", {{"to", 1.5}, {"gap", 0.1}}, {{"anchor", "sill"}}),
        step("symbolise", {{"to", 0.8}, {"gap", 0.1}}, {{"with", "chimney_block"}}),
        step("symbolise", {{"to", 0.8}, {"gap", 0.1}}, {{"with", "dormer_box"}}),
        step("symbolise", {{"to", 0.8}, {"gap", 0.1}}, {{"with", "balcony_box"}}),
        step("aggregate", {{"gap", 0.1}}, {{"into", "block"}}),
        step("displace", {{"to", 1.2}, {"gap", 0.1}}),
    };
    for (const OperatorKind& kind : operator_table())
      if (kind.name != "omit")
        operators.push_back(step(kind.name, {{"ratio", 0.5}, {"gap", 0.1}, {"by", 0.1}}));
    std::size_t changed = 0;
    for (const char* name : {"house", "row"}) {
      const Line line = line_of_sample(name);
      for (const Step& like : operators) {
        auto out = carried(line, plan_for(line, like, is_any));
        changed += out.changed.size();
        const Redrawn redrawn = redraw(line.context(), std::move(out));
        const Line again = line_of_text(
            write_cityjson(line.document, {redrawn.labelled}, {.removed = redrawn.removed_ids}));
        CHECK(is_closed(again.solid));
      }
    }
    CHECK(changed > 20);
  }
}
