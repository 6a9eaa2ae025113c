#include "interpret/explain.h"

#include "tests/interpret/support.h"

#include <fstream>
#include <iterator>

using namespace oriel;
using namespace oriel::test;

namespace {

const std::string kPack =
    "schema: oriel/1\n"
    "pack: {name: t, version: 1.0.0}\n"
    "params: {sill_max: {value: 0.6 m}}\n"
    "classes: {opening: {abstract: true}, window: {}, door: {}}\n"
    "macros: {shallow: depth <= 0.6 m}\n"
    "rules:\n"
    "  - {id: opening.shape, label: opening, require: sense = hole and shallow}\n"
    "  - id: door.ground\n"
    "    label: door\n"
    "    require:\n"
    "      - self is opening\n"
    "      - height <= $sill_max and host is wall\n"
    "  - id: window.regular\n"
    "    label: window\n"
    "    require: [self is opening and height > $sill_max]\n"
    "    unless: [quality > 0.9 and not natural]\n"
    "    score:\n"
    "      - a: {rise: 0.4 m .. 0.9 m, fall: 2.0 m .. 2.8 m}\n"
    "      - count(alike where is opening): {rise: 0 .. 3, weight: 2}\n"
    "decide: {min_score: 0.35}\n";

Explanation explain_first(const std::string& pack, const Scene& scene) {
  const RuleBase base = load(pack);
  const FeatureTable table = scene.table();
  const FeatureGraph graph = scene.graph();
  return explain(base, table, graph, interpret(base, table, graph), FeatureId{0});
}

Scene window_with_a_low_sill() {
  Scene scene;
  scene.add({{"sense", "hole"},
             {"depth", 0.1},
             {"height", 0.61},
             {"a", 2.1},
             {"host_inclination", 90.0},
             {"quality", 0.1}});
  return scene;
}

/// The one condition of a rule, judged for a feature.
ConditionReport judged(const std::string& condition, const Values& values) {
  Scene scene;
  scene.add(values);
  const Explanation explanation = explain_first(pack_requiring({condition}), scene);
  REQUIRE(explanation.rules[0].require.size() == 1);
  return explanation.rules[0].require[0];
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("an unknown feature is explained with its nearest candidate") {
    CHECK(to_text(explain_first(kPack, window_with_a_low_sill())) ==
          R"(f0 -> unknown   best candidate: window 0.29 (< min_score 0.35)
  opening.shape   holds                                   opening                                         t.yaml:7:5
    holds         sense = hole                            = hole                                          t.yaml:7:50
    holds         depth = 0.10 m                          <= 0.60 m                                       t.yaml:5:19
  door.ground     fails                                   door                                            t.yaml:8:5
    holds         self is opening = yes                                                                   t.yaml:11:9
    fails         height = 0.61 m                         <= 0.60 m ($sill_max), misses by 0.01 m         t.yaml:12:9
    holds         host_inclination = 90.00 deg            in 75.00 deg .. 105.00 deg                      t.yaml:12:33
  window.regular  holds, score 0.29                       window                                          t.yaml:13:5
    holds         self is opening = yes                                                                   t.yaml:15:15
    holds         height = 0.61 m                         > 0.60 m ($sill_max)                            t.yaml:15:35
    no veto       quality > 0.9 and not natural                                                           t.yaml:16:14
      fails       quality = 0.10                          > 0.90, misses by 0.80                          t.yaml:16:14
      unknown     not natural = ?                         natural is missing                              t.yaml:16:32
    0.87 x1       a = 2.10 m                              rises 0.40 m .. 0.90 m, falls 2.00 m .. 2.80 m  t.yaml:18:9
    0.00 x2       count(alike where is opening) = 0 of 0  rises 0 .. 3                                    t.yaml:19:9
)");
  }

  TEST_CASE("the explanation in the reference is what is printed") {
    std::ifstream docs(std::string(ORIEL_SOURCE_DIR) + "/docs/rules.md");
    const std::string text{std::istreambuf_iterator<char>(docs), {}};
    CHECK(text.find(to_text(explain_first(kPack, window_with_a_low_sill()))) != std::string::npos);
  }

  TEST_CASE("a label is explained with rule margin and runner-up") {
    Scene scene;
    scene.add({{"sense", "hole"}, {"depth", 0.1}, {"height", 0.1}, {"host_inclination", 90.0}});
    const Explanation explanation = explain_first(kPack, scene);
    CHECK(to_text(explanation).starts_with("f0 -> door 1.00 by door.ground, margin 1.00\n"));
    REQUIRE(explanation.best);
    CHECK(explanation.rules[*explanation.best].id == "door.ground");
  }

  TEST_CASE("a feature that no rule fits says so") {
    Scene scene;
    scene.add({{"sense", "protrusion"}});
    CHECK(to_text(explain_first(kPack, scene))
              .starts_with("f0 -> unknown   no rule for a label holds\n"));
  }

  TEST_CASE("outcomes agree with the verdicts") {
    const Explanation explanation = explain_first(kPack, window_with_a_low_sill());
    REQUIRE(explanation.rules.size() == 3);
    CHECK(explanation.rules[0].outcome == Outcome::holds);
    CHECK(explanation.rules[0].is_predicate);
    CHECK(explanation.rules[1].outcome == Outcome::fails);
    CHECK(explanation.rules[2].outcome == Outcome::holds);
    CHECK(explanation.rules[2].score == doctest::Approx(0.875 / 3).epsilon(1e-12));
    CHECK(explanation.verdict.label.empty());
    CHECK(explanation.feature == "f0");
    CHECK(explanation.building == "house");
  }

  TEST_CASE("values bounds and misses are shown in units") {
    const ConditionReport range = judged("b in 0.3 m .. 2.2 m", {{"b", 2.5}});
    CHECK(range.value == "b = 2.50 m");
    CHECK(range.bound == "in 0.30 m .. 2.20 m");
    CHECK(range.miss == "misses by 0.30 m");

    const ConditionReport list = judged("sense in [hole, imprint]", {{"sense", "cavity"}});
    CHECK(list.value == "sense = cavity");
    CHECK(list.bound == "in [hole, imprint]");
    CHECK(list.miss.empty());

    const ConditionReport similar = judged("a ~ b by 10 %", {{"a", 1.0}, {"b", 1.5}});
    CHECK(similar.value == "a = 1.00 m");
    CHECK(similar.bound == "~ 1.50 m by 10 %");
    CHECK(similar.miss == "differs 33.3 %");

    const ConditionReport turned = judged("2 m <= a", {{"a", 1.0}});
    CHECK(turned.value == "a = 1.00 m");
    CHECK(turned.bound == ">= 2.00 m");
    CHECK(turned.miss == "misses by 1.00 m");

    const ConditionReport derived = judged("a / b >= 1.2", {{"a", 1.0}, {"b", 1.0}});
    CHECK(derived.value == "a / b = 1.00");
    CHECK(derived.bound == ">= 1.20");

    const ConditionReport facet = judged("host is roof", {{"host_inclination", 80.0}});
    CHECK(facet.miss == "misses by 5.00 deg");

    const ConditionReport count = judged("split_order = 2", {{"split_order", 1.0}});
    CHECK(count.value == "split_order = 1");
    CHECK(count.bound == "= 2");
    CHECK(count.miss == "misses by 1");
  }

  TEST_CASE("a narrow miss is shown with enough decimals") {
    const ConditionReport report = judged("height <= 0.6 m", {{"height", 0.6004}});
    CHECK(report.value == "height = 0.6004 m");
    CHECK(report.bound == "<= 0.6000 m");
    CHECK(report.miss == "misses by 0.0004 m");
  }

  TEST_CASE("what is missing is named") {
    const ConditionReport report = judged("a + b > 1 m and natural or sense = hole", {{"b", 1.0}});
    CHECK(report.outcome == Outcome::unknown);
    CHECK(report.missing == std::vector<std::string>{"a", "natural", "sense"});
    REQUIRE(report.parts.size() == 2);
    CHECK(report.parts[0].parts.size() == 2);
    CHECK(report.parts[1].value == "sense = ?");
  }

  TEST_CASE("explanations are written as JSON") {
    Scene scene;
    scene.add({{"a", 1.5}});
    const RuleBase base =
        load(pack_with("rules:\n"
                       "  - id: w\n"
                       "    label: window\n"
                       "    require: a > 1 m\n"
                       "    score: [a: {rise: 1 m .. 2 m}]\n"));
    const Interpretation verdicts = interpret(base, scene.table(), scene.graph());
    CHECK(
        to_json(explain(base, scene.table(), scene.graph(), verdicts, FeatureId{0})) ==
        R"({"building":"house","feature":"f0","label":"window","score":0.5,"margin":0.5,"rule":"w",)"
        R"("runner_up":"","min_score":0,"best":"w","rules":[{"id":"w","label":"window",)"
        R"("priority":0,"predicate":false,"place":{"file":"t.yaml","line":5,"column":5},)"
        R"("outcome":"holds","score":0.5,"require":[{"text":"a > 1 m",)"
        R"("place":{"file":"t.yaml","line":7,"column":14},"outcome":"holds","value":"a = 1.50 m",)"
        R"("bound":"> 1.00 m"}],"unless":[],"terms":[{"text":"a",)"
        R"("place":{"file":"t.yaml","line":8,"column":13},"judged":0.5,"weight":1,)"
        R"("value":"a = 1.50 m","bound":"rises 1.00 m .. 2.00 m"}]}]})");
  }
}
