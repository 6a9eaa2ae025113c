#include "generalise/to_lod.h"

#include "generalise/invariants/fineness.h"
#include "io/writer.h"
#include "tests/generalise/line.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <set>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel;
using namespace oriel::test;
using nlohmann::json;

namespace {

Plan plan_of(const Line& line, const Profile& profile) {
  return plan_by_profile({}, profile, residential(), line.segmentation, line.table(),
                         line.interpretation, std::nullopt);
}

/// How many features the level 2.0 takes off.
std::size_t steps_at_lod2(const Line& line) {
  return plan_of(line, *load_profile_file("lod:2.0").value).steps.size();
}

/// The same of a house with one box on it; nothing of it has a label.
std::size_t steps_with(Vec3 from, Vec3 to) {
  Line line = line_of(
      BoxBody().add({0, 0, 0}, {12, 10, 4}).add({0, 5, 4}, {12, 10, 9}).add(from, to).build());
  for (Verdict& verdict : line.interpretation.verdicts) verdict.label.clear();
  return steps_at_lod2(line);
}

Checked<Redrawn> product(const Line& line, const std::string& level) {
  const Profile profile = *load_profile_file("lod:" + level).value;
  auto left = generalise(line.context(), plan_of(line, profile));
  REQUIRE(left.value);
  Work work(kWorkBudget);
  return to_lod(line.context(), profile, std::move(*left.value), work);
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("every sample at every level is a closed solid in the file too") {
    for (const std::string& name : samples()) {
      const Line line = line_of_sample(name);
      for (const char* level : {"2.0", "1.3", "1.2", "1.0"}) {
        const auto made = product(line, level);
        REQUIRE(made.value);
        const std::string text = write_cityjson(line.document, {made.value->labelled},
                                                {.removed = made.value->removed_ids});
        const Line again = line_of_text(text);
        CHECK(is_closed(again.solid));
        CHECK(again.building().lod == level);
        const json city = json::parse(text);
        for (const auto& [id, object] : city["CityObjects"].items()) {
          // What stands on the ground is a part of the building: a bay keeps its name.
          if (object["type"] == "BuildingInstallation") {
            CHECK(object["attributes"]["oriel_label"] == "bay");
            CHECK(level == std::string("2.0"));
            continue;
          }
          for (const json& geometry : object["geometry"]) {
            REQUIRE(geometry.contains("semantics"));
            for (const json& shell : geometry["semantics"]["values"])
              for (const json& value : shell) CHECK(value.is_number());
            for (const json& surface : geometry["semantics"]["surfaces"]) {
              CHECK(surface["type"] != "Window");
              CHECK(surface["type"] != "Door");
            }
          }
        }
      }
    }
  }

  TEST_CASE("a door in its wall goes at 2.0 and a recess deeper than a wall stays") {
    for (const double depth_m : {0.3, 0.8}) {
      Line line = line_of(
          BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({2, 0, 0}, {3, depth_m, 2.1}).build());
      REQUIRE(line.segmentation.features.size() == 1);
      line.interpretation.verdicts[0].label = "door";
      const Plan plan =
          plan_by_profile({}, *load_profile_file("lod:2.0").value, residential(), line.segmentation,
                          line.description.table, line.interpretation, std::nullopt);
      CHECK(plan.steps.size() == (depth_m < 0.5 ? 1U : 0U));
    }
  }

  TEST_CASE("what is short or thin goes at 2.0 but no storey and no part of the main roof") {
    CHECK(steps_with({1, 1, 4}, {3.5, 3.5, 6}) == 1);     // 2 m high
    CHECK(steps_with({1, 1, 4}, {3.5, 3.5, 7.2}) == 0);   // a storey
    CHECK(steps_with({1, 1, 4}, {2.5, 2.5, 7.2}) == 1);   // as high, on 2 m2
    CHECK(steps_with({1, 1, 4}, {7, 3, 5.5}) == 1);       // 12 m2 of roof
    CHECK(steps_with({1, 1, 4}, {9, 3, 5.5}) == 0);       // 16 m2
    CHECK(steps_with({1, 6, 9}, {4.5, 6.8, 10.5}) == 1);  // on the ridge, and not much higher
    CHECK(steps_with({1, 6, 9}, {4.5, 6.8, 11.5}) == 0);  // it holds the ridge
  }

  TEST_CASE("a building smaller than the sizes keeps its parts and a notch without lintel stays") {
    Line shed =
        line_of(BoxBody().add({0, 0, 0}, {3, 3, 2.5}).add({1, 1, 2.5}, {2, 2, 3.2}).build());
    for (Verdict& verdict : shed.interpretation.verdicts) verdict.label.clear();
    REQUIRE(shed.segmentation.features.size() == 1);
    CHECK(steps_at_lod2(shed) == 0);
    for (const double top_m : {2.1, 6.0}) {
      Line line =
          line_of(BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({2, 0, 0}, {3, 0.3, top_m}).build());
      REQUIRE(line.segmentation.features.size() == 1);
      line.interpretation.verdicts[0].label = "door";
      CHECK(steps_at_lod2(line) == (top_m < 6 ? 1U : 0U));
    }
  }

  TEST_CASE("the house at 2.0 has its roof and no dormer chimney or balcony") {
    const Line line = line_of_sample("house");
    const auto made = product(line, "2.0");
    REQUIRE(made.value);
    CHECK(made.value->removed.at("dormer") == 2);
    CHECK(made.value->removed.at("chimney") == 1);
    CHECK(made.value->removed.at("balcony") == 1);
    const Solid& solid = *made.value->labelled.geometry;
    std::set<PlaneId> roofs;
    for (const Facet& facet : solid.facets)
      if (solid.planes[facet.plane.index()].normal.z > 0.3) roofs.insert(facet.plane);
    CHECK(roofs.size() >= 2);
  }

  TEST_CASE("a wing on the ground without label stays and a small block on the roof goes") {
    const Line line = line_of(BoxBody()
                                  .add({0, 0, 0}, {12, 10, 6})
                                  .add({2, -1.5, 0}, {5, 0, 1.8})
                                  .add({4, 4, 6}, {5.5, 7, 7.5})
                                  .build());
    REQUIRE(line.segmentation.features.size() == 2);
    const auto made = product(line, "2.0");
    REQUIRE(made.value);
    CHECK(volume_m3(*made.value->labelled.geometry) ==
          doctest::Approx(720 + 3 * 1.5 * 1.8).epsilon(1e-6));
  }

  TEST_CASE("a part that holds another up stays") {
    // The tower is thin enough to be a line; the cabin on top of it is not small.
    const Line line = line_of(BoxBody()
                                  .add({0, 0, 0}, {20, 20, 6})
                                  .add({8, 8, 6}, {9.9, 9.9, 12})
                                  .add({6, 6, 12}, {14, 14, 16})
                                  .build());
    const auto made = product(line, "2.0");
    REQUIRE(made.value);
    CHECK(volume_m3(*made.value->labelled.geometry) ==
          doctest::Approx(volume_m3(line.solid)).epsilon(1e-6));
  }

  TEST_CASE("edges and gaps below a length are told with the feature that has them") {
    // A plinth of 0.1 m, and two blocks on the roof 0.15 m from each other.
    const Line line = line_of(BoxBody()
                                  .add({0, 0, 0}, {12, 10, 6})
                                  .add({2, -0.1, 0}, {5, 0, 1.8})
                                  .add({4, 4, 6}, {6, 7, 8})
                                  .add({6.15, 2, 6}, {8, 8, 9})
                                  .build());
    const auto edges = short_edges(line.solid, line.segmentation, {}, 0.2);
    CHECK(edges.size() == 4);
    for (const ShortEdge& edge : edges) {
      CHECK(edge.length_m == doctest::Approx(0.1).epsilon(1e-6));
      REQUIRE(edge.feature.is_valid());
      CHECK(line.segmentation.features[edge.feature.index()].box.min.y ==
            doctest::Approx(-0.1).epsilon(1e-6));
    }
    CHECK(short_edges(line.solid, line.segmentation, {}, 0.1).empty());
    const auto gaps = narrow_gaps(line.solid, line.segmentation, {}, 0.2);
    REQUIRE(gaps.size() == 1);
    CHECK(gaps[0].width_m == doctest::Approx(0.15).epsilon(1e-6));
    CHECK(narrow_gaps(line.solid, line.segmentation, {}, 0.15).empty());
    // Facets that look at each other through the wall between them are no gap.
    CHECK(narrow_gaps(line.solid, line.segmentation, {}, 5).size() == 1);

    Generalised nothing;
    nothing.solid = line.solid;
    const auto told = [&](const Fineness& asked) {
      std::string codes;
      for (const Issue& issue : fineness_issues(line.context(), line.solid, nothing, asked)) {
        CHECK((issue.severity == Severity::warning) == asked.is_everywhere);
        codes += to_string(issue.code) + ' ';
      }
      return codes;
    };
    CHECK(told({0.2, true}) == "G415 G416 ");
    CHECK(told({0.05, true}).empty());
    CHECK(told({0.2, false}).empty());  // nothing is new
    const Solid other = line_of(BoxBody().add({50, 50, 0}, {60, 60, 9}).build()).solid;
    const RedrawContext drawn_of_other{line.building(),   line.labelled, other,
                                       line.segmentation, line.table(),  line.interpretation};
    CHECK_FALSE(fineness_issues(drawn_of_other, line.solid, nothing, {0.2, false}).empty());
  }

  TEST_CASE("a feature with an edge too short goes if it is narrow and not if it is wide") {
    // Capstones that stick out by 0.08 m.
    const Line line = line_of(BoxBody()
                                  .add({0, 0, 0}, {20, 10, 6})
                                  .add({2, 2, 6}, {2.7, 2.7, 8})
                                  .add({1.92, 1.92, 8}, {2.78, 2.78, 8.2})
                                  .add({8, 2, 6}, {12, 6, 8})
                                  .add({7.92, 1.92, 8}, {12.08, 6.08, 8.2})
                                  .build());
    Generalised left;
    left.solid = line.solid;
    Plan plan;
    for (int i = 0; i < 3; ++i) {
      if (!add_fine_owners(line.context(), left, 0.3, 1.5, "r", plan)) break;
      left = *generalise(line.context(), plan).value;
    }
    REQUIRE_FALSE(plan.steps.empty());
    for (const Step& step : plan.steps) {
      CHECK(step.rule == "r");
      CHECK(*line.table().number(step.feature, Attribute::b) < 1.5);
    }
    for (const ShortEdge& edge : short_edges(left.solid, line.segmentation, left.removed, 0.3))
      CHECK(edge.from.x > 7);
  }
}
