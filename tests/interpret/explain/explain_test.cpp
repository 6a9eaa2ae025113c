#include "interpret/explain/explain.h"

#include "tests/interpret/support.h"

#include <cmath>
#include <fstream>
#include <iterator>

#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

const std::string kPack =
    "schema: oriel/1\n"
    "pack: {name: t, version: 1.0.0}\n"
    "params: {sill_max: {value: 0.6 m, range: 0.3 m .. 1 m}}\n"
    "classes: {opening: {abstract: true}, window: {}, door: {}}\n"
    "macros: {shallow: depth <= 0.6 m}\n"
    "relations: {alike: {within: same facade, where: a ~ other.a by 10 %}}\n"
    "rules:\n"
    "  - {id: opening.shape, label: opening, require: sense = hole and shallow}\n"
    "  - id: door.ground\n"
    "    label: door\n"
    "    require:\n"
    "      - self is opening\n"
    "      - base_height <= $sill_max and host is wall\n"
    "  - id: window.regular\n"
    "    label: window\n"
    "    require: [self is opening and base_height > $sill_max]\n"
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
             {"base_height", 0.61},
             {"a", 2.1},
             {"host_inclination", 90.0},
             {"quality", 0.1}});
  scene.add({{"sense", "hole"}, {"depth", 0.1}, {"base_height", 3.0}, {"a", 1.4}});
  scene.relate_both("same_facade", FeatureId{0}, FeatureId{1});
  return scene;
}

/// The label that a feature gets, and what a pack with `params` says would flip it.
FlipSearch flip_of(const std::string& params, const std::string& rules, const Scene& scene) {
  return explain_first("schema: oriel/1\npack: {name: t, version: 1.0.0}\nparams: {" + params +
                           "}\nclasses: {window: {}, door: {}}\n" + rules,
                       scene)
      .flip.value();
}

std::string flip_line_of(const std::string& params, const std::string& rules,
                         const Values& values) {
  Scene scene;
  scene.add(values);
  return flip_line(flip_of(params, rules, scene));
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
  opening.shape   holds                                    opening                                                   t.yaml:8:5
    holds         sense is hole                                                                                      t.yaml:8:50
    holds         depth is 0.10 m                          at most 0.60 m                                            t.yaml:5:19
  door.ground     fails                                    door                                                      t.yaml:9:5
    holds         self is opening: yes                                                                               t.yaml:12:9
    fails         base_height is 0.61 m                    must be at most 0.60 m ($sill_max), misses by 0.01 m      t.yaml:13:9
    holds         host_inclination is 90.00 deg            within 75.00 deg .. 105.00 deg                            t.yaml:13:38
  window.regular  holds, score 0.29                        window                                                    t.yaml:14:5
    holds         self is opening: yes                                                                               t.yaml:16:15
    holds         base_height is 0.61 m                    above 0.60 m ($sill_max)                                  t.yaml:16:35
    no veto       quality > 0.9 and not natural                                                                      t.yaml:17:14
      fails       quality is 0.10                          must be above 0.90, misses by 0.80                        t.yaml:17:14
      unknown     not natural: ?                           natural is missing                                        t.yaml:17:32
    0.87 x1       a is 2.10 m                              rises 0.40 m .. 0.90 m, falls 2.00 m .. 2.80 m            t.yaml:19:9
    0.00 x2       count(alike where is opening) is 0 of 0  rises 0 .. 3, nearest miss f1: a is 2.10 m, must be within 10 % of 1.40 m, differs by 33.3 % t.yaml:20:9
  nearest flip: sill_max 0.60 m -> 0.61 m: door 1.00 by door.ground
)");
  }

  TEST_CASE("the explanation in the reference is what is printed") {
    std::ifstream docs(std::string(ORIEL_SOURCE_DIR) + "/docs/rules.md");
    const std::string text{std::istreambuf_iterator<char>(docs), {}};
    CHECK(text.find(to_text(explain_first(kPack, window_with_a_low_sill()))) != std::string::npos);
  }

  TEST_CASE("a label is explained with rule margin and runner-up") {
    Scene scene;
    scene.add(
        {{"sense", "hole"}, {"depth", 0.1}, {"base_height", 0.1}, {"host_inclination", 90.0}});
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
    CHECK(range.value == "b is 2.50 m");
    CHECK(range.bound == "must be within 0.30 m .. 2.20 m");
    CHECK(range.miss == "misses by 0.30 m");

    const ConditionReport list = judged("sense in [hole, imprint]", {{"sense", "cavity"}});
    CHECK(list.value == "sense is cavity");
    CHECK(list.bound == "must be one of [hole, imprint]");
    CHECK(list.miss.empty());

    const ConditionReport similar = judged("a ~ b by 10 %", {{"a", 1.0}, {"b", 1.5}});
    CHECK(similar.value == "a is 1.00 m");
    CHECK(similar.bound == "must be within 10 % of 1.50 m");
    CHECK(similar.miss == "differs by 33.3 %");

    const ConditionReport turned = judged("2 m <= a", {{"a", 1.0}});
    CHECK(turned.value == "a is 1.00 m");
    CHECK(turned.bound == "must be at least 2.00 m");
    CHECK(turned.miss == "misses by 1.00 m");

    const ConditionReport derived = judged("a / b >= 1.2", {{"a", 1.0}, {"b", 1.0}});
    CHECK(derived.value == "a / b is 1.00");
    CHECK(derived.bound == "must be at least 1.20");

    const ConditionReport facet = judged("host is roof", {{"host_inclination", 80.0}});
    CHECK(facet.miss == "misses by 5.00 deg");

    const ConditionReport count = judged("split_order = 2", {{"split_order", 1.0}});
    CHECK(count.value == "split_order is 1");
    CHECK(count.bound == "must be 2");
    CHECK(count.miss == "misses by 1");
  }

  TEST_CASE("a narrow miss is shown with enough decimals") {
    const ConditionReport report = judged("base_height <= 0.6 m", {{"base_height", 0.6004}});
    CHECK(report.value == "base_height is 0.6004 m");
    CHECK(report.bound == "must be at most 0.6000 m");
    CHECK(report.miss == "misses by 0.0004 m");
  }

  TEST_CASE("what numbers that look alike are said to be is true") {
    const double below = std::nextafter(0.7, 0);
    const ConditionReport rounding = judged("b in 0.7 m .. 6 m", {{"b", below}});
    CHECK(rounding.value == "b is 0.70 m");
    CHECK(rounding.bound == "must be within 0.70 m .. 6.00 m");
    CHECK(rounding.miss == "misses by less than 0.0001 m");

    const ConditionReport micrometre = judged("b >= 0.7 m", {{"b", 0.699999}});
    CHECK(micrometre.value == "b is 0.70 m");
    CHECK(micrometre.miss == "misses by less than 0.0001 m");

    const ConditionReport held = judged("b > 0.7 m", {{"b", std::nextafter(0.7, 1)}});
    CHECK(held.outcome == Outcome::holds);
    CHECK(held.bound == "above 0.70 m by less than 0.0001 m");

    const ConditionReport equal = judged("b > 0.7 m", {{"b", 0.7}});
    CHECK(equal.bound == "must be above 0.70 m");
    CHECK(equal.miss == "equal is not enough");

    const ConditionReport count = judged("split_order < 3", {{"split_order", 3.0}});
    CHECK(count.value == "split_order is 3");
    CHECK(count.bound == "must be below 3");
    CHECK(count.miss.empty());

    const ConditionReport share = judged("a ~ b by 10 %", {{"a", 0.8999}, {"b", 1.0}});
    CHECK(share.bound == "must be within 10 % of 1.00 m");
    CHECK(share.miss == "differs by 10.01 %");
  }

  TEST_CASE("small numbers keep their digits") {
    const ConditionReport report = judged("a <= 0.005 m", {{"a", 3.0}});
    CHECK(report.bound == "must be at most 0.005 m");
    CHECK(judged("a > 1 m", {{"a", 0.0123}}).value == "a is 0.012 m");
    CHECK(judged("a > 1 m", {{"a", 2.004}}).value == "a is 2.00 m");
  }

  TEST_CASE("a score just below the least is shown apart from it") {
    Scene scene;
    scene.add({{"sense", "hole"}, {"a", 1.3496}});
    const std::string head = headline(explain_first(
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}}\n"
        "rules: [{id: w, label: window, require: sense = hole, score: [a: {rise: 1 m .. 2 m}]}]\n"
        "decide: {min_score: 0.35}\n",
        scene));
    CHECK(head == "f0 -> unknown   best candidate: window 0.3496 (< min_score 0.3500)");
  }

  TEST_CASE("the summary says why in one sentence and what came near") {
    CHECK(
        summary_text(explain_first(kPack, window_with_a_low_sill())) ==
        R"(f0 has no label: window comes first with 0.29 by window.regular, below the minimum score of 0.35.
best           window.regular for window, score 0.29                                         t.yaml:14:5
                 self is opening: yes                                                        t.yaml:16:15
                 base_height is 0.61 m, above 0.60 m ($sill_max)                             t.yaml:16:35
                 no veto: quality > 0.9 and not natural                                      t.yaml:17:14
                 score 0.87 x1: a is 2.10 m, rises 0.40 m .. 0.90 m, falls 2.00 m .. 2.80 m  t.yaml:19:9
                 score 0.00 x2: count(alike where is opening) is 0 of 0, rises 0 .. 3, nearest miss f1: a is 2.10 m, must be within 10 % of 1.40 m, differs by 33.3 %  t.yaml:20:9
nearest miss   door.ground for door                                                          t.yaml:9:5
                 base_height is 0.61 m, must be at most 0.60 m ($sill_max), misses by 0.01 m  t.yaml:13:9
smallest flip  sill_max 0.60 m -> 0.61 m: door 1.00 by door.ground                           t.yaml:3:10
--full shows all 3 rules, --rule NAME one of them.
)");
  }

  TEST_CASE("the summary in the reference is what is printed") {
    std::ifstream docs(std::string(ORIEL_SOURCE_DIR) + "/docs/rules.md");
    const std::string text{std::istreambuf_iterator<char>(docs), {}};
    CHECK(text.find(summary_text(explain_first(kPack, window_with_a_low_sill()))) !=
          std::string::npos);
  }

  TEST_CASE("the sentence names what came second and why it did") {
    const auto said = [](const std::string& second) {
      Scene scene;
      scene.add({{"sense", "hole"}, {"a", 1.8}});
      return sentence(explain_first(
          "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}, door: {}}\n"
          "rules:\n  - {id: w, label: window, priority: 1, require: sense = hole, score: [a: "
          "{rise: 1 m .. 2 m}]}\n  - {id: d, label: door, " +
              second + "}\ndecide: {min_score: 0.35}\n",
          scene));
    };
    CHECK(said("priority: 1, require: sense = hole, score: [a: {rise: 1 m .. 3 m}]") ==
          "f0 is labelled window by w with score 0.80, ahead of door by 0.40.");
    CHECK(said("require: sense = hole") ==
          "f0 is labelled window by w with score 0.80, ahead of door, whose priority 0 is below "
          "1.");
    CHECK(said("priority: 2, require: sense = hole, score: [a: {rise: 1.5 m .. 3 m}]") ==
          "f0 is labelled window by w with score 0.80, ahead of door, whose score 0.20 is below "
          "the minimum of 0.35.");
    CHECK(said("priority: 1, require: sense = hole, score: [a: {rise: 1 m .. 2.001 m}]") ==
          "f0 is labelled window by w with score 0.80, ahead of door by 0.001.");
    CHECK(said("priority: 1, require: sense = hole, score: [a: {rise: 1 m .. 2.000000001 m}]") ==
          "f0 is labelled window by w with score 0.80, ahead of door by less than 0.000001.");
    CHECK(said("require: sense = cavity") ==
          "f0 is labelled window by w with score 0.80; no rule for another label holds.");
  }

  TEST_CASE("of a tie the sentence says what decided") {
    Scene scene;
    scene.add({{"sense", "hole"}});
    CHECK(sentence(explain_first(
              "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}, door: {}}\n"
              "rules:\n  - {id: w, label: window, require: sense = hole}\n"
              "  - {id: d, label: door, require: sense = hole}\n",
              scene)) ==
          "f0 is labelled door by d with score 1.00, tied with window; of equal scores the rule "
          "whose id sorts first wins.");
  }

  TEST_CASE("the nearest miss looks into the classes that are asked for") {
    Scene scene;
    scene.add({{"sense", "hole"}, {"depth", 0.66}, {"base_height", 0.5}, {"a", 9.0}});
    const Explanation explanation = explain_first(
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\n"
        "classes: {opening: {abstract: true}, window: {}, door: {}}\nrules:\n"
        "  - {id: opening.far, label: opening, require: depth <= 0.1 m}\n"
        "  - {id: opening.near, label: opening, require: [depth <= 0.6 m, sense = hole]}\n"
        "  - {id: w, label: window, require: a <= 3 m}\n"
        "  - {id: d, label: door, require: self is opening}\n",
        scene);
    REQUIRE(explanation.nearest_miss);
    const NearestMiss& nearest = *explanation.nearest_miss;
    CHECK(explanation.rules[nearest.rule].id == "d");
    CHECK(nearest.gap == doctest::Approx(0.06 / 0.66).epsilon(1e-9));
    REQUIRE(nearest.misses.size() == 1);
    CHECK(nearest.misses[0].rule == "opening.near");
    CHECK(nearest.misses[0].condition.miss == "misses by 0.06 m");
    CHECK(sentence(explanation) == "f0 has no label: no rule for a label holds; d comes nearest.");
  }

  TEST_CASE("classes that need each other are no endless way to the nearest miss") {
    Scene scene;
    scene.add({{"sense", "hole"}, {"a", 1.0}});
    const Explanation explanation = explain_first(
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\n"
        "classes: {p: {abstract: true}, q: {abstract: true}, window: {}}\nrules:\n"
        "  - {id: p.one, label: p, require: [self is q, a > 2 m]}\n"
        "  - {id: q.one, label: q, require: self is p}\n"
        "  - {id: w, label: window, require: self is p}\n",
        scene);
    REQUIRE(explanation.nearest_miss);
    CHECK(!explanation.nearest_miss->misses.empty());
    CHECK(std::isfinite(explanation.nearest_miss->gap));
  }

  TEST_CASE("a summary has at most twenty lines and counts what it leaves out") {
    std::string conditions, terms;
    for (int i = 0; i < 30; ++i) {
      conditions += fmt::format("{}a > {} m", i == 0 ? "" : ", ", i + 10);
      terms += fmt::format("{}a: {{rise: {} m .. 50 m}}", i == 0 ? "" : ", ", i);
    }
    Scene scene;
    scene.add({{"sense", "hole"}, {"a", 1.0}});
    const std::string text = summary_text(explain_first(
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}, door: {}, vent: "
        "{}}\niterate: {rounds: 3}\nrules:\n  - {id: w, label: window, require: sense = hole, "
        "score: [" +
            terms + "]}\n  - {id: v, label: vent, priority: -1, require: sense = hole}\n" +
            "  - {id: d, label: door, require: [" + conditions + "]}\n",
        scene));
    CAPTURE(text);
    CHECK(std::ranges::count(text, '\n') <= static_cast<int>(kMostSummaryLines));
    CHECK(std::ranges::count(text, '\n') > 14);
    CHECK(text.find("  and 25 more: --rule w\n") != std::string::npos);
    CHECK(text.find("  and 27 more: --rule d\n") != std::string::npos);
  }

  TEST_CASE("a rule is found by its id and all rules for a label by the label") {
    const RuleBase base = load(kPack);
    CHECK(find_rules(base, "door.ground") == std::vector<std::size_t>{1});
    CHECK(find_rules(base, "window") == std::vector<std::size_t>{2});
    CHECK(find_rules(base, "windw").empty());
    CHECK(similar_rule(base, "windw") == "; did you mean 'window'?");
    const Explanation explanation = explain_first(kPack, window_with_a_low_sill());
    const std::string text = rules_text(explanation, {1});
    CHECK(text.starts_with(sentence(explanation) + "\n  door.ground  fails "));
    CHECK(text.find("window.regular  holds") == std::string::npos);
  }

  TEST_CASE("the nearest miss stands in the JSON with what it misses") {
    const std::string json = to_json(explain_first(kPack, window_with_a_low_sill()));
    CHECK(json.find(R"("nearest_miss":{"rule":"door.ground","gap":0.01639)") != std::string::npos);
    CHECK(json.find(R"("misses":[{"rule":"","veto":false,"condition":{"text":"base_height <= )"
                    R"($sill_max")") != std::string::npos);
  }

  TEST_CASE("what is missing is named") {
    const ConditionReport report = judged("a + b > 1 m and natural or sense = hole", {{"b", 1.0}});
    CHECK(report.outcome == Outcome::unknown);
    CHECK(report.missing == std::vector<std::string>{"a", "natural", "sense"});
    REQUIRE(report.parts.size() == 2);
    CHECK(report.parts[0].parts.size() == 2);
    CHECK(report.parts[1].value == "sense is ?");
  }

  TEST_CASE("the nearest miss is that of the other feature that misses least") {
    Scene scene = window_with_a_low_sill();
    scene.add({{"sense", "imprint"}, {"depth", 0.1}, {"base_height", 3.0}, {"a", 2.0}});
    scene.add({{"sense", "hole"}, {"depth", 0.8}, {"base_height", 3.0}, {"a", 1.6}});
    for (const int other : {2, 3}) scene.relate("same_facade", FeatureId{0}, FeatureId{other});
    const Explanation explanation = explain_first(kPack, scene);
    const TermReport& term = explanation.rules[2].terms[1];
    // f1 is an opening and differs by 33 %, f2 is alike and none, f3 is neither.
    CHECK(term.value == "count(alike where is opening) is 0 of 1");
    CHECK(term.nearest == "f1");
    REQUIRE(term.nearest_misses.size() == 1);
    CHECK(term.nearest_misses[0].value == "a is 2.10 m");
    CHECK(term.nearest_misses[0].miss == "differs by 33.3 %");
    CHECK(to_json(explanation)
              .find(R"("nearest":{"feature":"f1","misses":[{"text":"a ~ other.a )"
                    R"(by 10 %")") != std::string::npos);
  }

  TEST_CASE("nearest misses and what is in the way are said of every quantifier") {
    Scene scene;
    for (const double a : {1.0, 2.0, 2.5, 4.0}) scene.add({{"a", a}, {"sense", "hole"}});
    for (const int other : {1, 2, 3}) scene.relate("beside", FeatureId{0}, FeatureId{other});
    const auto said = [&](const std::string& condition) {
      const ConditionReport report =
          explain_first(pack_requiring({condition}), scene).rules[0].require[0];
      CHECK(report.outcome == Outcome::fails);
      std::string text = report.miss;
      for (const ConditionReport& miss : report.nearest_misses)
        text += " " + report.nearest + " " + miss.value + " " + miss.bound + " " + miss.miss;
      return text;
    };
    CHECK(said("exists(beside where a < self.a)") ==
          " f1 a is 2.00 m must be below 1.00 m (self.a) misses by 1.00 m");
    CHECK(said("exists(beside where a > 3 m and sense = cavity)") ==
          " f3 sense is hole must be cavity ");
    CHECK(said("none(beside where a > 2 m)") == "in the way: f2, f3");
    CHECK(said("all(beside where a > 2 m)") == "in the way: f1");
    CHECK(said("not exists(beside where a > 3 m)") == "in the way: f3");
    CHECK(said("count(beside where a > 2.2 m) >= 3") ==
          "misses by 1 f1 a is 2.00 m must be above 2.20 m misses by 0.20 m");
    CHECK(said("count(beside where a > 2.2 m) < 2") == "in the way: f2, f3");
    CHECK(said("count(beside where a > 2.2 m) in 3 .. 5") ==
          "misses by 1 f1 a is 2.00 m must be above 2.20 m misses by 0.20 m");
  }

  TEST_CASE("the smallest change of a param that flips the label is found") {
    const std::string low = "low: {value: 1 m, range: 0.5 m .. 2 m}";
    const std::string wide = "wide: {value: 2 m, range: 1 m .. 4 m}";
    const std::string rules =
        "rules:\n  - {id: d, label: door, priority: 1, require: base_height <= $low}\n"
        "  - {id: w, label: window, require: a < $wide}\n";
    const auto line = [&](double height, double a) {
      return flip_line_of(low + ", " + wide, rules, {{"base_height", height}, {"a", a}});
    };
    CHECK(line(1.3, 1.0) == "nearest flip: low 1.00 m -> 1.30 m: door 1.00 by d");
    CHECK(line(0.8, 1.0) == "nearest flip: low 1.00 m -> 0.79 m: window 1.00 by w");
    // As a share of its range `wide` moves less; at 2 m itself the condition still fails.
    CHECK(line(1.9, 2.0) == "nearest flip: wide 2.00 m -> 2.01 m: window 1.00 by w");
    CHECK(line(1.31234567, 9) == "nearest flip: low 1.00 m -> 1.32 m: door 1.00 by d");
    CHECK(line(1.9999, 1.00001) == "nearest flip: wide 2.00 m -> 1.00 m: unknown");
    CHECK(line(3.0, 0.5) == "nearest flip: no param (2) flips the label within its range");
    CHECK(flip_line_of(
              "low: {value: 1 m}", "rules: [{id: d, label: door, require: base_height <= $low}]\n",
              {{"base_height", 1.1}}) == "nearest flip: no param has a range to be moved in");
    CHECK(flip_line_of(low + ", wide: {value: 2 m}", rules, {{"base_height", 2.1}, {"a", 2.1}}) ==
          "nearest flip: no param (1) flips the label within its range; without a range: wide");
  }

  TEST_CASE("five features in the way are named and further ones counted") {
    const auto said = [](int others) {
      Scene scene;
      scene.add({{"a", 1.0}});
      for (int i = 1; i <= others; ++i) {
        scene.add({{"a", 1.0}});
        scene.relate("beside", FeatureId{0}, FeatureId{i});
      }
      return explain_first(pack_requiring({"none(beside where a > 0.5 m)"}), scene)
          .rules[0]
          .require[0]
          .miss;
    };
    CHECK(said(5) == "in the way: f1, f2, f3, f4, f5");
    CHECK(said(7) == "in the way: f1, f2, f3, f4, f5 and 2 more");
  }

  TEST_CASE("a flip is found where a condition is a curve of the param") {
    const auto line = [](const char* condition) {
      return flip_line_of("share: {value: 0.5, range: 0.1 .. 1}",
                          fmt::format("rules: [{{id: d, label: door, require: {}}}]\n", condition),
                          {{"quality", 0.49}});
    };
    // At 0.7 both sides are equal.
    CHECK(line("quality < $share * $share") == "nearest flip: share 0.50 -> 0.701: door 1.00 by d");
    CHECK(line("quality > $share * $share") == "nearest flip: share 0.50 -> 0.701: unknown");
  }

  TEST_CASE("flips are found in scores hosts relations and labels of others") {
    const Values values{
        {"sense", "hole"}, {"a", 1.3}, {"base_height", 1.0}, {"host_inclination", 70.0}};
    // 0.3 / (top - 1 m) is 0.6 at 1.5 m and sinks to 0.5 at 1.6 m.
    CHECK(
        flip_line_of("top: {value: 1.5 m, range: 1.1 m .. 3 m}",
                     "rules: [{id: w, label: window, require: sense = hole, score: [a: {rise: 1 m "
                     ".. $top}]}]\ndecide: {min_score: 0.5}\n",
                     values) == "nearest flip: top 1.50 m -> 1.61 m: unknown");
    CHECK(
        flip_line_of("least: {value: 40 %, range: 10 % .. 90 %}",
                     "rules: [{id: w, label: window, require: sense = hole, score: [a: {rise: 1 m "
                     ".. 1.5 m}]}]\ndecide: {min_score: $least}\n",
                     values) == "nearest flip: least 0.40 -> 0.61: unknown");
    CHECK(flip_line_of("steep: {value: 75 deg, range: 10 deg .. 85 deg}",
                       "hosts: {roof: 0 deg .. $steep, wall: $steep .. 105 deg}\n"
                       "rules: [{id: w, label: window, require: host is wall}]\n",
                       values) == "nearest flip: steep 75.00 deg -> 70.00 deg: window 1.00 by w");
    Scene scene;
    scene.add(values);
    scene.add({{"sense", "imprint"}, {"a", 2.0}, {"base_height", 1.8}});
    scene.relate_both("beside", FeatureId{0}, FeatureId{1});
    CHECK(flip_line(flip_of(
              "near: {value: 0.5 m, range: 0 m .. 2 m}",
              "relations: {next: {within: beside, where: abs(base_height - other.base_height) "
              "<= $near}}\n"
              "rules: [{id: w, label: window, require: exists(next)}]\n",
              scene)) == "nearest flip: near 0.50 m -> 0.80 m: window 1.00 by w");
    CHECK(flip_line(flip_of("long: {value: 3 m, range: 1 m .. 4 m}",
                            "rules:\n  - {id: d, label: door, require: a >= $long and sense = "
                            "imprint}\n"
                            "  - {id: w, label: window, require: exists(beside where is door)}\n",
                            scene)) == "nearest flip: long 3.00 m -> 2.00 m: window 1.00 by w");
  }

  TEST_CASE("a pack with the flipped value gives the flipped label and none nearer does") {
    const auto pack = [](double low, double wide, double near) {
      return fmt::format(
          "schema: oriel/1\npack: {{name: t, version: 1.0.0}}\nparams:\n"
          "  low: {{value: {} m, range: 0 m .. 2 m}}\n  wide: {{value: {} m, range: 0 m .. 4 m}}\n"
          "  near: {{value: {}, range: 0 .. 1}}\nclasses: {{window: {{}}, door: {{}}}}\n"
          "relations: {{like: {{within: beside, where: a ~ other.a by $near}}}}\nrules:\n"
          "  - {{id: d, label: door, priority: 1, require: base_height in $low - 1 m .. $low and a "
          "> "
          "$wide / 2}}\n"
          "  - {{id: w, label: window, require: exists(like where base_height > self.base_height), "
          "score: "
          "[a: {{rise: $wide .. $wide + 1 m}}, base_height < $low]}}\ndecide: {{min_score: 0.3}}\n",
          low, wide, near);
    };
    std::size_t flips = 0;
    CHECK(rc::check("flips", [&] {
      Scene scene;
      for (int i = 0; i < 4; ++i)
        scene.add({{"a", *rc::gen::inRange(0, 30) * 0.1},
                   {"base_height", *rc::gen::inRange(0, 30) * 0.1}});
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) scene.relate_both("beside", FeatureId{i}, FeatureId{j});
      const double low = *rc::gen::inRange(0, 21) * 0.1, wide = *rc::gen::inRange(0, 41) * 0.1;
      const double near = *rc::gen::inRange(0, 11) * 0.1;
      const auto label = [&](double l, double w, double n) {
        return labels(load(pack(l, w, n)), scene)[0];
      };
      const std::string said = label(low, wide, near);
      const auto search = explain_first(pack(low, wide, near), scene).flip.value();
      double share = 2;
      if (search.nearest) {
        ++flips;
        const Flip& flip = *search.nearest;
        const bool is_low = flip.param == "low", is_wide = flip.param == "wide";
        const std::string found = label(is_low ? flip.to : low, is_wide ? flip.to : wide,
                                        is_low || is_wide ? near : flip.to);
        RC_ASSERT(found == (flip.label.empty() ? "-" : flip.label));
        RC_ASSERT(found != said);
        share = std::abs(flip.to - flip.from) / (is_low ? 2 : is_wide ? 4 : 1);
      }
      // Rounding takes it on by a hundredth of a unit at most.
      for (int i = 0; i <= 20; ++i) {
        const double part = i / 20.0;
        if (std::abs(2 * part - low) / 2 < share - 0.0051)
          RC_ASSERT(label(2 * part, wide, near) == said);
        if (std::abs(4 * part - wide) / 4 < share - 0.01)
          RC_ASSERT(label(low, 4 * part, near) == said);
        if (std::abs(part - near) < share - 0.0101) RC_ASSERT(label(low, wide, part) == said);
      }
    }));
    CHECK(flips > 20);
  }

  TEST_CASE("a flip that nobody waits for is given up at once") {
    const Scene scene = window_with_a_low_sill();
    const RuleBase base = load(kPack);
    const FeatureTable table = scene.table();
    const FeatureGraph graph = scene.graph();
    const Interpretation said = interpret(base, table, graph);
    const Explainer explainer(base, table, graph, said);
    int asked = 0;
    const auto whole = explainer.find_flip(FeatureId{0}, [&] { return ++asked < 0; });
    CHECK_FALSE(whole.is_given_up);
    REQUIRE(whole.nearest);
    CHECK(asked > 2);
    for (int most = 0; most < asked; ++most) {
      int count = 0;
      const auto search = explainer.find_flip(FeatureId{0}, [&] { return count++ == most; });
      CHECK(search.is_given_up);
      CHECK_FALSE(search.nearest);
      CHECK(count == most + 1);
    }
    const auto explained = explainer.explain_fully(FeatureId{0}, [] { return true; });
    CHECK(explained.flip.value().is_given_up);
    CHECK(explained.nearest_miss);
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
        R"({"building":"house","feature":"f0","sentence":"f0 is labelled window by w with score 0.50; )"
        R"(no rule for another label holds.","label":"window","score":0.5,"margin":0.5,"rule":"w",)"
        R"("runner_up":"","min_score":0,"best":"w","rules":[{"id":"w","label":"window",)"
        R"("priority":0,"predicate":false,"place":{"file":"t.yaml","line":5,"column":5},)"
        R"("outcome":"holds","score":0.5,"require":[{"text":"a > 1 m",)"
        R"("place":{"file":"t.yaml","line":7,"column":14},"outcome":"holds","value":"a is 1.50 m",)"
        R"("bound":"above 1.00 m"}],"unless":[],"terms":[{"text":"a",)"
        R"("place":{"file":"t.yaml","line":8,"column":13},"judged":0.5,"weight":1,)"
        R"("value":"a is 1.50 m","bound":"rises 1.00 m .. 2.00 m"}]}],"flip":{"nearest":null,)"
        R"("params":0,"without_range":[],"tried":0,"reach":1}})");
  }
}
