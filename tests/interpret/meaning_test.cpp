#include "tests/interpret/support.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// True if a rule with that condition labels the feature.
bool holds(const std::string& condition, const Values& values) {
  Scene scene;
  scene.add(values);
  return labels(load(pack_requiring({condition})), scene) == Labels{"window"};
}

/// As holds(), but whether `not (condition)` holds: where neither does the condition is unknown.
bool fails(const std::string& condition, const Values& values) {
  return holds("not (" + condition + ")", values);
}

bool is_unknown(const std::string& condition, const Values& values) {
  return !holds(condition, values) && !fails(condition, values);
}

/// A pack with two competing rules; `rest` is added to each.
RuleBase competing(const std::string& window, const std::string& door,
                   const std::string& decide = "{}") {
  return load(
      pack_with("rules:\n"
                "  - {id: w, label: window, require: natural" +
                window +
                "}\n"
                "  - {id: d, label: door, require: natural" +
                door + "}\ndecide: " + decide + "\n"));
}

Verdict verdict_of(const RuleBase& base, const Values& values) {
  Scene scene;
  scene.add(values);
  return interpret(base, scene.table(), scene.graph()).verdicts.at(0);
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("comparisons arithmetic and ranges mean what they say") {
    const Values f = {{"a", 2.0}, {"b", 1.0}, {"c", 0.5}, {"volume", 1.0}, {"inclination", 90.0}};
    CHECK(holds("a > 1.99 m and a >= 2 m and a <= 200 cm and a < 2001 mm and a = 2 m", f));
    CHECK(holds("a != 1 m and not a != 2 m", f));
    CHECK(holds("a * b * c = 1 m3 and a / b = 2 and a + b - c = 2.5 m", f));
    CHECK(holds("a - b - c = 0.5 m and a / b / c = 4 / 1 m", f));
    CHECK(holds("abs(b - a) = 1 m and min(a, b, c) = 0.5 m and max(a, b, c) = 2 m", f));
    CHECK(holds("sqrt(a * a) = 2 m and -a < -1 m and volume = a * c * 1 m", f));
    CHECK(holds("b in 1 m .. 2 m and a in 1 m .. 2 m and not c in 1 m .. 2 m", f));
    CHECK(holds("a / b in [2, 3] and not b / c in [3, 4]", f));
    CHECK(holds("a + b * 2 = 4 m and (a + b) * 2 = 6 m", f));
    CHECK(holds("a / b = 200 %", f));
  }

  TEST_CASE("similar means apart by a share of the larger") {
    const Values f = {{"a", 1.0}, {"b", 0.9}};
    CHECK(holds("a ~ b by 10 %", f));
    CHECK(holds("b ~ a by 10 %", f));
    CHECK(fails("a ~ b by 9 %", f));
  }

  TEST_CASE("texts are compared with words") {
    CHECK(holds("sense = hole", {{"sense", "hole"}}));
    CHECK(holds("sense in [imprint, hole]", {{"sense", "hole"}}));
    CHECK(holds("sense != imprint", {{"sense", "hole"}}));
    CHECK(fails("sense = imprint", {{"sense", "hole"}}));
    CHECK(is_unknown("sense = imprint", {}));
    CHECK(fails("sense = imprint", {{"sense", "something else"}}));
  }

  TEST_CASE("missing is unknown and so is its negation") {
    CHECK(is_unknown("a > 1 m", {}));
    CHECK(is_unknown("a + b > 1 m", {{"b", 5.0}}));
    CHECK(is_unknown("min(a, b) < 1 m", {{"b", 0.5}}));
    CHECK(is_unknown("max(b, a) > 1 m", {{"b", 5.0}}));
    CHECK(is_unknown("natural", {}));
    CHECK(is_unknown("host is wall", {}));
    CHECK(is_unknown("a / b > 1", {{"a", 0.0}, {"b", 0.0}}));
  }

  TEST_CASE("and and or go on where the answer is settled without the unknown") {
    const Values f = {{"b", 1.0}};
    CHECK(fails("a > 1 m and b > 2 m", f));
    CHECK(is_unknown("a > 1 m and b < 2 m", f));
    CHECK(holds("a > 1 m or b < 2 m", f));
    CHECK(is_unknown("a > 1 m or b > 2 m", f));
  }

  TEST_CASE("a range is false as soon as one end is missed") {
    CHECK(fails("b in a .. 2 m", {{"b", 3.0}}));
    CHECK(is_unknown("b in a .. 2 m", {{"b", 1.0}}));
  }

  TEST_CASE("the facet a feature lies in is classed by its inclination") {
    const auto kind = [](double inclination) {
      for (const char* name : {"wall", "roof", "ground"})
        if (holds(std::string("host is ") + name, {{"host_inclination", inclination}})) return name;
      return "none";
    };
    CHECK(kind(0) == std::string("roof"));
    CHECK(kind(74.9) == std::string("roof"));
    CHECK(kind(75) == std::string("wall"));
    CHECK(kind(105) == std::string("wall"));
    CHECK(kind(180) == std::string("ground"));
    const RuleBase base = load(pack_with(
        "params: {mansard: {value: 60 deg}}\n"
        "hosts: {roof: 0 deg .. $mansard, wall: $mansard .. 100 deg, ground: 150 deg .. 180 deg}\n"
        "rules: [{id: w, label: window, require: host is wall}]\n"));
    Scene scene;
    scene.add({{"host_inclination", 70.0}});
    scene.add({{"host_inclination", 59.0}});
    CHECK(labels(base, scene) == Labels{"window", "-"});
  }

  TEST_CASE("quantifiers look at the others") {
    const auto label = [](const std::string& condition) {
      Scene scene;
      const FeatureId host = scene.add({{"a", 5.0}, {"natural", 1.0}});
      for (const double a : {1.0, 2.0, 3.0}) scene.put_on(host, scene.add({{"a", a}}));
      return labels(load(pack_requiring({"natural and " + condition})), scene)[0] == "window";
    };
    CHECK(label("exists(contains)"));
    CHECK(label("exists(contains where a > 2.5 m)"));
    CHECK_FALSE(label("exists(contains where a > 3 m)"));
    CHECK(label("none(contains where a > 3 m)"));
    CHECK(label("count(contains where a >= 2 m) = 2"));
    CHECK(label("all(contains where a > 0.5 m)"));
    CHECK_FALSE(label("all(contains where a > 1.5 m)"));
    CHECK(label("all(beside where a > 9 m)"));
    CHECK(label("none(beside)"));
    CHECK(label("count(beside) = 0"));
    CHECK(label("all(contains where self.a > a)"));
    CHECK(label("exists(contains where other.a + 2 m = self.a)"));
    CHECK(label("exists(contains where exists(host where a = 5 m) and a + 2 m = self.a)"));
  }

  TEST_CASE("an unknown answer leaves a quantifier open unless another settles it") {
    const auto verdict = [](const std::string& condition) {
      const auto holds_for_first = [](const std::string& text) {
        Scene scene;
        const FeatureId host = scene.add({{"natural", 1.0}});
        scene.put_on(host, scene.add({{"a", 2.0}}));
        scene.put_on(host, scene.add({}));
        return labels(load(pack_requiring({"natural and " + text})), scene)[0] == "window";
      };
      if (holds_for_first(condition)) return "holds";
      return holds_for_first("not " + condition) ? "fails" : "unknown";
    };
    CHECK(verdict("exists(contains where a > 1 m)") == std::string("holds"));
    CHECK(verdict("exists(contains where a > 3 m)") == std::string("unknown"));
    CHECK(verdict("none(contains where a > 1 m)") == std::string("fails"));
    CHECK(verdict("all(contains where a > 3 m)") == std::string("fails"));
    CHECK(verdict("all(contains where a > 1 m)") == std::string("unknown"));
    CHECK(verdict("count(contains where a > 1 m) = 1") == std::string("unknown"));
  }

  TEST_CASE("asking for a class whose rule was unknown is unknown") {
    const RuleBase base =
        load(pack_with("rules:\n"
                       "  - {id: o, label: opening, require: depth < 1 m}\n"
                       "  - {id: w, label: window, require: natural and not self is opening}\n"
                       "  - {id: d, label: door, require: exists(beside where is window)}\n"));
    Scene scene;
    const FeatureId known = scene.add({{"depth", 2.0}, {"natural", 1.0}});
    const FeatureId unknown = scene.add({{"natural", 1.0}});
    scene.relate("beside", scene.add({}), known);
    scene.relate("beside", scene.add({}), unknown);
    CHECK(labels(base, scene) == Labels{"window", "-", "door", "-"});
  }

  TEST_CASE("require holds only on true and unless vetoes only on true") {
    const RuleBase base = load(
        pack_with("rules: [{id: w, label: window, require: natural, unless: [quality > 0.9]}]\n"));
    Scene scene;
    scene.add({{"natural", 1.0}, {"quality", 0.95}});
    scene.add({{"natural", 1.0}, {"quality", 0.5}});
    scene.add({{"natural", 1.0}});
    scene.add({{"quality", 0.5}});
    CHECK(labels(base, scene) == Labels{"-", "window", "window", "-"});
  }

  TEST_CASE("scores rise and fall along their ramps") {
    const RuleBase base =
        load(pack_with("rules:\n"
                       "  - id: w\n"
                       "    label: window\n"
                       "    require: natural\n"
                       "    score: [a: {rise: 1 m .. 2 m, fall: 3 m .. 5 m}]\n"));
    const auto score = [&](double a) {
      return verdict_of(base, {{"natural", 1.0}, {"a", a}}).score;
    };
    CHECK(score(0.5) == 0);
    CHECK(score(1.5) == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(score(2) == 1);
    CHECK(score(3) == 1);
    CHECK(score(4) == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(score(9) == 0);
  }

  TEST_CASE("a ramp without width is a step") {
    const auto score = [&](const std::string& ramp, double a) {
      return verdict_of(
                 load(pack_with("rules: [{id: w, label: window, require: natural, score: [a: {" +
                                ramp + "}]}]\n")),
                 {{"natural", 1.0}, {"a", a}})
          .score;
    };
    CHECK(score("rise: 2 m .. 2 m", 1.9) == 0);
    CHECK(score("rise: 2 m .. 2 m", 2.0) == 1);
    CHECK(score("fall: 2 m .. 2 m", 2.0) == 1);
    CHECK(score("fall: 2 m .. 2 m", 2.1) == 0);
  }

  TEST_CASE("a score is the weighted mean of the terms that are known") {
    const RuleBase base =
        load(pack_with("rules:\n"
                       "  - id: w\n"
                       "    label: window\n"
                       "    require: natural\n"
                       "    score:\n"
                       "      - a: {rise: 0 m .. 1 m, weight: 3}\n"
                       "      - sense = hole\n"));
    CHECK(verdict_of(base, {{"natural", 1.0}, {"a", 1.0}, {"sense", "imprint"}}).score == 0.75);
    CHECK(verdict_of(base, {{"natural", 1.0}, {"sense", "hole"}}).score == 1);
    CHECK(verdict_of(base, {{"natural", 1.0}, {"a", 0.5}}).score == 0.5);
    CHECK(verdict_of(base, {{"natural", 1.0}}).label.empty());
  }

  TEST_CASE("a rule without score scores one") {
    const Verdict verdict = verdict_of(competing("", ", priority: -1"), {{"natural", 1.0}});
    CHECK(verdict.score == 1);
    CHECK(verdict.label == "window");
  }

  TEST_CASE("the highest priority wins then the highest score then the smallest id") {
    const Values f = {{"natural", 1.0}, {"a", 0.5}};
    const std::string half = ", score: [a: {rise: 0 m .. 1 m}]";
    CHECK(verdict_of(competing("", half + ", priority: 1"), f).label == "door");
    CHECK(verdict_of(competing("", half), f).label == "window");
    CHECK(verdict_of(competing("", ""), f).label == "door");
  }

  TEST_CASE("a score below the least does not label") {
    const Values f = {{"natural", 1.0}, {"a", 0.3}};
    const std::string low = ", priority: 5, score: [a: {rise: 0 m .. 1 m}]";
    CHECK(verdict_of(competing("", low, "{min_score: 0.35}"), f).label == "window");
    CHECK(verdict_of(competing(low, low, "{min_score: 0.35}"), f).label.empty());
    CHECK(verdict_of(competing("", low, "{min_score: 0.30}"), f).label == "door");
  }

  TEST_CASE("margin and runner-up are kept and a small margin is noted") {
    const RuleBase base = competing(", score: [a: {rise: 0 m .. 1 m}]",
                                    ", score: [b: {rise: 0 m .. 1 m}]", "{ambiguous_below: 0.1}");
    const Verdict clear = verdict_of(base, {{"natural", 1.0}, {"a", 0.75}, {"b", 0.25}});
    CHECK(clear.label == "window");
    CHECK(clear.margin == 0.5);
    CHECK(clear.runner_up == "door");
    CHECK(clear.rule == "w");

    Scene scene;
    scene.add({{"natural", 1.0}, {"a", 0.75}, {"b", 0.6875}});
    const Interpretation close = interpret(base, scene.table(), scene.graph());
    REQUIRE(close.issues.size() == 1);
    CHECK(close.issues[0].severity == Severity::note);
    CHECK(to_string(close.issues[0]) ==
          "house f0: R260 window 0.75 is close to door: margin 0.06 < 0.10");

    const Verdict alone = verdict_of(competing("", ", priority: -1"), {{"natural", 1.0}});
    CHECK(alone.margin == 1);
    CHECK(alone.runner_up == "door");
  }

  TEST_CASE("a verdict that a rule for a subclass refines is close only if it is itself") {
    const RuleBase base = load(
        "schema: oriel/1\n"
        "pack: {name: t, version: 1.0.0}\n"
        "classes: {window: {}, oval: {is: window}, door: {}}\n"
        "rules:\n"
        "  - {id: w, label: window, require: natural, score: [a: {rise: 0 m .. 1 m}]}\n"
        "  - {id: d, label: door, require: natural, score: [b: {rise: 0 m .. 1 m}]}\n"
        "  - {id: o, label: oval, require: self is window}\n"
        "decide: {ambiguous_below: 0.1}\n");
    Scene scene;
    scene.add({{"natural", 1.0}, {"a", 0.75}, {"b", 0.6875}});
    const Interpretation refined = interpret(base, scene.table(), scene.graph());
    CHECK(refined.verdicts[0].label == "oval");
    CHECK(refined.verdicts[0].margin == 1);
    CHECK(refined.issues.empty());
  }

  TEST_CASE("rules without scores decide as rules that all score one") {
    const auto pack = [](const char* score) {
      const auto rule = [&](const char* id, const char* label, const char* where, int priority) {
        return fmt::format("  - {{id: {}, label: {}, require: '{}', priority: {}{}}}\n", id, label,
                           where, priority, score);
      };
      return load(
          pack_with("rules:\n" + rule("low", "door", "a > 2 m", 0) +
                    rule("first", "window", "a > 1 m", 1) + rule("equal", "door", "b > 1 m", 1) +
                    rule("best", "window", "b > 2 m", 2) + rule("last", "window", "c > 1 m", 0) +
                    "decide: {min_score: 0.5, ambiguous_below: 0.1}\n"));
    };
    Scene scene;
    const double missing = std::numeric_limits<double>::quiet_NaN();
    for (const double a : {0.5, 1.5, 2.5, missing})
      for (const double b : {0.5, 1.5, 2.5, missing})
        for (const double c : {0.5, 1.5})
          scene.add({{"natural", 1.0}, {"a", a}, {"b", b}, {"c", c}});
    const auto plain = interpret(pack(""), scene.table(), scene.graph());
    const auto scored = interpret(pack(", score: [natural]"), scene.table(), scene.graph());
    REQUIRE(plain.verdicts.size() == 32);
    for (std::size_t i = 0; i < plain.verdicts.size(); ++i) {
      CAPTURE(i);
      CHECK(plain.verdicts[i].rule == scored.verdicts[i].rule);
      CHECK(plain.verdicts[i].label == scored.verdicts[i].label);
      CHECK(plain.verdicts[i].score == scored.verdicts[i].score);
      CHECK(plain.verdicts[i].margin == scored.verdicts[i].margin);
      CHECK(plain.verdicts[i].runner_up == scored.verdicts[i].runner_up);
    }
    CHECK(plain.issues.size() > 2);
    CHECK(plain.issues.size() == scored.issues.size());
  }

  TEST_CASE("macros mean the feature that they are used for") {
    const RuleBase base =
        load(pack_with("macros: {large: a > 1 m}\n"
                       "rules: [{id: w, label: window, require: not large and exists(beside where "
                       "large)}]\n"));
    Scene scene;
    scene.relate("beside", scene.add({{"a", 0.5}}), FeatureId{1});
    scene.add({{"a", 2.0}});
    CHECK(labels(base, scene) == Labels{"window", "-"});
  }

  TEST_CASE("params are constants") {
    const RuleBase base = load(pack_with(
        "params: {sill_max: {value: 60 cm, range: 0.3 m .. 1 m, why: doors}}\n"
        "rules: [{id: d, label: door, require: base_height <= $sill_max * 2 - 0.1 m}]\n"));
    Scene scene;
    scene.add({{"base_height", 1.09}});
    scene.add({{"base_height", 1.11}});
    CHECK(labels(base, scene) == Labels{"door", "-"});
  }

  TEST_CASE("a table without features has no verdicts") {
    const RuleBase base = load(pack_requiring({"exists(contains where a > 1 m)", "sense = hole"}));
    CHECK(interpret(base, FeatureTable(), FeatureGraph()).verdicts.empty());
    CHECK(interpret(base, FeatureTable("house", 0), FeatureGraph()).verdicts.empty());
  }

  TEST_CASE("verdicts do not depend on the order of the features") {
    const RuleBase base = load(pack_with(
        "rules:\n"
        "  - {id: o1, label: opening, require: a < 1 m}\n"
        "  - {id: o2, label: opening, require: exists(beside where is opening) and b < 1 m}\n"
        "  - {id: d, label: door, require: self is opening and c < 1 m, score: [c: {fall: 0 m .. 1 "
        "m}, count(beside where is opening): {rise: 0 .. 3, weight: 2}]}\n"
        "  - {id: w, label: window, require: self is opening and not exists(beside where is door), "
        "score: [b: {rise: 0 m .. 2 m}]}\n"
        "decide: {min_score: 0.2, ambiguous_below: 0.1}\n"));
    rc::check("shuffling features shuffles verdicts", [&] {
      const int count = *rc::gen::inRange(1, 40);
      Scene scene;
      const auto maybe = [](Values& values, const char* name) {
        const int tenths = *rc::gen::inRange(0, 25);
        if (tenths < 22) values[name] = tenths / 10.0;
      };
      for (int i = 0; i < count; ++i) {
        Values values;
        for (const char* name : {"a", "b", "c"}) maybe(values, name);
        scene.add(values);
      }
      for (int i = 0; i < 2 * count; ++i)
        scene.relate("beside", FeatureId{*rc::gen::inRange(0, count)},
                     FeatureId{*rc::gen::inRange(0, count)});
      std::vector<int> order(static_cast<std::size_t>(count));
      std::iota(order.begin(), order.end(), 0);
      for (int i = count - 1; i > 0; --i)
        std::swap(order[static_cast<std::size_t>(i)],
                  order[static_cast<std::size_t>(*rc::gen::inRange(0, i + 1))]);
      const Scene shuffled = scene.reordered(order);
      const auto before = interpret(base, scene.table(), scene.graph()).verdicts;
      const auto after = interpret(base, shuffled.table(), shuffled.graph()).verdicts;
      for (std::size_t i = 0; i < before.size(); ++i) {
        const Verdict& moved = after[static_cast<std::size_t>(order[i])];
        RC_ASSERT(before[i].label == moved.label);
        RC_ASSERT(before[i].score == moved.score);
        RC_ASSERT(before[i].margin == moved.margin);
        RC_ASSERT(before[i].rule == moved.rule);
        RC_ASSERT(before[i].runner_up == moved.runner_up);
      }
    });
  }

  TEST_CASE("blocks make no difference") {
    const RuleBase base = load(pack_with(
        "rules:\n"
        "  - {id: o, label: opening, require: a < 1 m}\n"
        "  - {id: w, label: window, require: exists(beside where is opening and self.a > a)}\n"));
    Scene scene;
    const int count = 1500;
    for (int i = 0; i < count; ++i) scene.add({{"a", i % 3 == 0 ? 0.5 : 2.0}});
    for (int i = 0; i < count; ++i)
      scene.relate("beside", FeatureId{i}, FeatureId{(i * 7 + 3) % count});
    const Labels found = labels(base, scene);
    for (int i = 0; i < count; ++i) {
      const bool is_window = i % 3 != 0 && (i * 7 + 3) % count % 3 == 0;
      REQUIRE(found[static_cast<std::size_t>(i)] == (is_window ? "window" : "-"));
    }
  }

  TEST_CASE("a quantifier over very many pairs is answered") {
    const RuleBase base = load(pack_requiring({"count(same_facade where a > self.a) = 10"}));
    Scene scene;
    const int count = 700;
    for (int i = 0; i < count; ++i) scene.add({{"a", static_cast<double>(i)}});
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) scene.relate("same_facade", FeatureId{i}, FeatureId{j});
    const Labels found = labels(base, scene);
    CHECK(std::ranges::count(found, "window") == 1);
    CHECK(found[static_cast<std::size_t>(count) - 11] == "window");
  }
}
