#include "interpret/interpret.h"
#include "interpret/plan.h"
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

/// How many features have become what by which operator at 1 : scale.
std::map<std::string, int> changed_by(const Line& line, double scale) {
  const auto& [table, graph] = line.description;
  const Interpretation labels = interpret(cartographic(), table, graph);
  const Plan asked = plan(cartographic(), table, graph, labels, scale);
  const auto out = generalise(line.solid, line.segmentation, table, labels, asked);
  REQUIRE(out.value);
  CHECK(is_closed(out.value->solid));
  std::map<std::string, int> counts;
  for (const Step& step : asked.steps)
    if (std::ranges::binary_search(out.value->changed, step.feature)) ++counts[step.operation];
  return counts;
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
}
