#include "generalise/invariants/fineness.h"
#include "interpret/labelling/interpret.h"
#include "tests/generalise/bare_context.h"
#include "tests/generalise/line.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <map>
#include <string>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

const RuleBase& cartographic() {
  static const RuleBase pack = *load_pack_file("cartographic").value;
  return pack;
}

/// What the pack makes of a building at 1 : scale.
struct Redraft {
  Line named;
  Plan plan;
  Generalised generalised;
};

Redraft redraft(const Line& line, double scale, double least_edge_m = 0,
                const std::string& without = {}) {
  Line named = line;
  named.interpretation = interpret(cartographic(), line.table(), line.description.graph);
  Plan asked = named.plan_at(scale, cartographic());
  std::erase_if(asked.steps, [&](const Step& step) { return step.operation == without; });
  RedrawContext context = named.context();
  context.invariants.least_edge_m = least_edge_m;
  context.judge = &any_closed();
  auto out = generalise(context, asked);
  REQUIRE(out.value);
  CHECK(is_closed(out.value->solid));
  return {std::move(named), std::move(asked), std::move(*out.value)};
}

/// How many features have become what by which operator at 1 : scale.
std::map<std::string, int> changed_by(const Line& line, double scale) {
  const Redraft made = redraft(line, scale);
  std::map<std::string, int> counts;
  for (const Step& step : made.plan.steps)
    if (std::ranges::binary_search(made.generalised.changed, step.feature))
      ++counts[step.operation];
  return counts;
}

std::size_t short_edges_drawn(const Line& line, const Generalised& made, double least_m) {
  return short_edges_of_drawn(line.context(), made, least_m).size();
}

LabelledBuilding relabelled(const Line& line, double scale) {
  const Redraft made = redraft(line, scale);
  return redraw(made.named.context(), made.generalised).labelled;
}

/// How many facets of each type the installations with that label have.
std::map<std::string, int> types_of(const LabelledBuilding& labelled, const std::string& label) {
  std::map<std::string, int> counts;
  for (const Installation& installation : labelled.installations) {
    if (installation.label->label != label) continue;
    for (const int surface : installation.surfaces)
      ++counts[labelled.surfaces[static_cast<std::size_t>(surface)].type];
  }
  return counts;
}

/// Facets that look down where there was nothing that did.
int new_undersides(const Solid& solid) {
  return static_cast<int>(std::ranges::count_if(solid.facets, [&](const Facet& facet) {
    return facet.polygons.empty() && solid.planes[facet.plane.index()].normal.z < -0.26;
  }));
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("the cartographic pack names things as the residential pack does") {
    const Line line = line_of_sample("house");
    const Interpretation labels = interpret(cartographic(), line.table(), line.description.graph);
    for (const Verdict& verdict : labels.verdicts)
      CHECK(verdict.label == line.label(verdict.feature));
  }

  TEST_CASE("rows are typified and strips aggregated and doors and chimneys grow on the samples") {
    CHECK(changed_by(line_of_sample("row"), 4000)["typify"] >= 4);
    CHECK(changed_by(line_of_sample("block"), 2000)["aggregate"] == 4);
    auto counts = changed_by(line_of_sample("l-house"), 2500);
    CHECK(counts["symbolise"] == 1);
    CHECK(counts["enlarge"] == 1);
  }

  TEST_CASE("adjoining windows of one floor become one strip") {
    BoxBody body;
    body.add({0, 0, 0}, {12, 8, 6});
    for (const double x : {2.0, 3.2, 4.4}) body.remove({x, 0, 3.5}, {x + 1, 0.2, 4.7});
    for (const double x : {2.0, 6.0}) body.remove({x, 0, 0.9}, {x + 1, 0.2, 2.1});
    auto counts = changed_by(line_of(body.build()), 2000);
    CHECK(counts["aggregate"] == 1);
    CHECK(counts["typify"] == 0);
  }

  TEST_CASE("what operators draw has no edge shorter than asked for, or stays as it was") {
    std::size_t drawn = 0, refused = 0;
    for (const auto& [name, scale] :
         std::map<std::string, double>{{"block", 2000}, {"l-house", 2500}, {"row", 4000}}) {
      const Line line = line_of_sample(name);
      const Redraft any = redraft(line, scale);
      for (const double least_m : {0.4, 0.8, 1.2, 1.6}) {
        CAPTURE(name);
        CAPTURE(least_m);
        drawn += short_edges_drawn(line, any.generalised, least_m);
        const Redraft fine = redraft(line, scale, least_m);
        CHECK(short_edges_drawn(line, fine.generalised, least_m) == 0);
        for (const auto& [feature, code, reason, hindrance] : fine.generalised.refused) {
          if (!reason.ends_with("would be drawn")) continue;
          ++refused;
          CHECK(code == Code::G403);
          CHECK_FALSE(std::ranges::binary_search(fine.generalised.changed, feature));
          CHECK_FALSE(std::ranges::binary_search(fine.generalised.removed, feature));
        }
      }
    }
    CHECK(drawn > 0);
    CHECK(refused > 0);
  }

  TEST_CASE("members of a strip that is too low stay together") {
    BoxBody body;
    body.add({0, 0, 0}, {12, 8, 6});
    for (const double x : {2.0, 4.0, 6.0}) body.remove({x, 0, 3.5}, {x + 1, 0.2, 4.7});
    const Line line = line_of(body.build());
    CHECK(redraft(line, 2000).generalised.changed.size() == 1);
    const Generalised made = redraft(line, 2000, 1.3).generalised;
    CHECK(made.changed.empty());
    CHECK(made.removed.empty());
    CHECK(made.refused.size() == 3);
  }

  TEST_CASE("a chimney across a ridge becomes a block across it") {
    const Line line = line_of_sample("house");
    const Generalised made = redraft(line, 2500, 2500 * kGapOnMap_m).generalised;
    REQUIRE(line.features("chimney").size() == 1);
    CHECK(std::ranges::binary_search(made.changed, line.features("chimney")[0]));
    CHECK(new_undersides(made.solid) == 0);
  }

  TEST_CASE("a chimney that stays across a ridge keeps what it stands on") {
    const Line line = line_of_sample("house");
    const Redraft made = redraft(line, 2500, 0, "symbolise");
    CHECK(new_undersides(made.generalised.solid) == 0);
    const auto is_carried = [](const RefusedStep& refused) {
      return refused.code == Code::G411 && refused.reason.starts_with("what stands on it");
    };
    const auto& refused = made.generalised.refused;
    const auto piece = std::ranges::find_if(refused, is_carried);
    REQUIRE(piece != refused.end());
    CHECK(is_part(*piece, made.plan, made.named.interpretation));
    FeatureId chimney = line.segmentation.features[piece->feature.index()].parent;
    while (chimney.is_valid() && line.label(chimney) != "chimney")
      chimney = line.segmentation.features[chimney.index()].parent;
    REQUIRE(chimney.is_valid());
    CHECK_FALSE(std::ranges::binary_search(made.generalised.removed, chimney));
  }

  TEST_CASE("the shaft under the brim of a chimney goes where that is drawn as a block") {
    BoxBody body;
    body.add({0, 0, 0}, {12, 8, 6});
    body.add({3, 3, 6}, {3.5, 3.5, 7});
    body.add({2.9, 2.9, 7}, {3.6, 3.6, 7.1});
    const Line line = line_of(body.build());
    REQUIRE(line.features("chimney").size() == 1);
    const Generalised made = redraft(line, 2500).generalised;
    CHECK(made.changed == line.features("chimney"));
    CHECK_FALSE(made.removed.empty());
    CHECK(made.refused.empty());
  }

  TEST_CASE("what stays does not hang over what went") {
    for (const std::string& name : samples())
      for (const double scale : {500., 1000., 2500., 5000., 10000.}) {
        CAPTURE(name);
        CAPTURE(scale);
        CHECK(new_undersides(redraft(line_of_sample(name), scale).generalised.solid) == 0);
      }
  }

  TEST_CASE(
      "the place of an omitted window belongs to the bay it was in, that of a flue to its "
      "chimney") {
    const Line row = line_of_sample("row");
    const auto before = types_of(row.labelled, "bay");
    const auto bays = types_of(relabelled(row, 4000), "bay");
    CHECK(before.at("Window") > 0);
    CHECK(bays.count("Window") == 0);
    CHECK(bays.at("WallSurface") >= before.at("WallSurface"));
    const auto chimney = types_of(relabelled(line_of_sample("house"), 2500), "chimney");
    CHECK(chimney.at("RoofSurface") == 1);
  }

  TEST_CASE("the top of a chimney drawn as a block is a roof") {
    const auto block = types_of(relabelled(line_of_sample("l-house"), 2500), "chimney");
    CHECK(block == std::map<std::string, int>{{"RoofSurface", 1}, {"WallSurface", 4}});
  }
}
