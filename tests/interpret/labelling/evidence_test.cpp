#include "interpret/explain/explain.h"
#include "tests/interpret/support.h"

#include <algorithm>
#include <numeric>

#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// Openings of up to 1.5 m are windows, larger ones doors; how sure that is grows with the
/// distance. `typical` stands in the classes of window and door, `decide` beside min_score.
std::string sizing(const std::string& window, const std::string& door, const std::string& decide) {
  return "schema: oriel/1\n"
         "pack: {name: t, version: 1.0.0}\n"
         "classes:\n"
         "  opening: {abstract: true}\n"
         "  window: {is: opening" +
         window +
         "}\n"
         "  door: {is: opening" +
         door +
         "}\n"
         "rules:\n"
         "  - {id: w, label: window, require: natural, score: [a: {fall: 1 m .. 2 m}]}\n"
         "  - {id: d, label: door, require: natural, score: [a: {rise: 1 m .. 2 m}]}\n"
         "decide: {" +
         decide + "}\n";
}

constexpr const char* kWeighing = "ambiguous_below: 0.2, evidence: 0.1";
constexpr const char* kNotWeighing = "ambiguous_below: 0.2";

std::string counting_doors(const std::string& typical) {
  return sizing("", ", typical: {" + typical + "}", kWeighing);
}

Scene openings(const std::vector<double>& sizes) {
  Scene scene;
  for (const double size : sizes) scene.add({{"a", size}, {"natural", 1.0}});
  return scene;
}

void relate_all(Scene& scene, const std::string& relation, int count) {
  for (int p = 0; p < count; ++p)
    for (int q = 0; q < p; ++q) scene.relate_both(relation, FeatureId{p}, FeatureId{q});
}

/// Five windows and one more opening of that size, all alike.
Scene five_windows_and(double size) {
  Scene scene = openings({1.2, 1.2, 1.2, 1.2, 1.2, size});
  relate_all(scene, "alike", 6);
  return scene;
}

Explanation explained(const RuleBase& base, const Scene& scene, int feature) {
  const FeatureTable table = scene.table();
  const FeatureGraph graph = scene.graph();
  return explain(base, table, graph, interpret(base, table, graph), FeatureId{feature});
}

bool has_line(const std::string& text, const std::string& begin) {
  return text.find("\n" + begin) != std::string::npos;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("a feature that is close takes the label that its company holds") {
    const Scene scene = five_windows_and(1.52);
    CHECK(labels(load(sizing("", "", kNotWeighing)), scene).back() == "door");
    const RuleBase base = load(sizing("", "", kWeighing));
    CHECK(labels(base, scene).back() == "window");
    const Verdict verdict = interpret(base, scene.table(), scene.graph()).verdicts.back();
    CHECK(verdict.score == doctest::Approx(0.48 + 0.1));
    CHECK(verdict.margin == doctest::Approx(0.06));
    CHECK(verdict.runner_up == "door");
  }

  TEST_CASE("company that is mixed adds the share that holds the label") {
    Scene scene = openings({1.2, 1.2, 1.2, 1.8, 1.52});
    relate_all(scene, "alike", 5);
    const auto report = explained(load(sizing("", "", kWeighing)), scene, 4);
    REQUIRE(report.rules[0].evidence);
    CHECK(report.rules[0].evidence->shift == doctest::Approx(0.075));
    REQUIRE(report.rules[1].evidence);
    CHECK(report.rules[1].evidence->shift == doctest::Approx(0.025));
    CHECK(report.verdict.label == "window");
  }

  TEST_CASE("evidence does not touch what is clear") {
    for (const double size : {1.6, 1.7, 2.0}) {
      CAPTURE(size);
      const Verdict verdict =
          interpret(load(sizing("", "", kWeighing)), five_windows_and(size).table(),
                    five_windows_and(size).graph())
              .verdicts.back();
      CHECK(verdict.label == "door");
      CHECK(verdict.score == doctest::Approx(size - 1));
      CHECK(verdict.margin == doctest::Approx(2 * size - 3));
    }
  }

  TEST_CASE("a building without a door finds one in what is nearly one") {
    const Scene scene = openings({1.2, 1.47, 1.49});
    CHECK(labels(load(sizing("", "", kWeighing)), scene) == Labels{"window", "window", "window"});
    // The closest goes first, and then the building has its door.
    CHECK(labels(load(counting_doors("per building: 1 .. 3")), scene) ==
          Labels{"window", "window", "door"});
  }

  TEST_CASE("what would be one too many is held back") {
    const Scene scene = openings({1.9, 1.9, 1.51});
    const auto with = [&](const char* typical) {
      return labels(load(counting_doors(typical)), scene).back();
    };
    CHECK(with("per building: 0 .. 2") == "window");
    CHECK(with("per building: 0 .. 3") == "door");
    CHECK(with("per building: 0 ..") == "door");
  }

  TEST_CASE("counts of a storey and a facade look no further") {
    Scene scene = openings({1.9, 1.9, 1.51, 1.51});
    for (const char* relation : {"same_storey", "same_facade"}) {
      scene.relate_both(relation, FeatureId{0}, FeatureId{2});
      scene.relate_both(relation, FeatureId{1}, FeatureId{2});
      scene.relate_both(relation, FeatureId{0}, FeatureId{1});
    }
    const Labels expected{"door", "door", "window", "door"};
    CHECK(labels(load(counting_doors("per storey: 0 .. 2")), scene) == expected);
    CHECK(labels(load(counting_doors("per facade: 0 .. 2")), scene) == expected);
  }

  TEST_CASE("counts of a storey say nothing of a feature that is alone in it") {
    const Scene scene = openings({1.49});
    CHECK(labels(load(counting_doors("per storey: 1 .. 2")), scene) == Labels{"window"});
    CHECK(labels(load(counting_doors("per building: 1 .. 2")), scene) == Labels{"door"});
  }

  TEST_CASE("counts of a class above a label count all that is beneath it") {
    const std::string pack =
        "schema: oriel/1\n"
        "pack: {name: t, version: 1.0.0}\n"
        "classes: {opening: {abstract: true, typical: {per building: 0 .. 2}}, window: {is: "
        "opening}, door: {is: opening}, hatch: {}}\n"
        "rules:\n"
        "  - {id: w, label: window, require: natural, score: [a: {fall: 1 m .. 2 m}]}\n"
        "  - {id: d, label: door, require: natural, score: [a: {rise: 1.6 m .. 2 m}]}\n"
        "  - {id: h, label: hatch, require: natural, score: [a: {rise: 1 m .. 2 m, fall: 2 m .. 3 "
        "m}]}\n"
        "decide: {ambiguous_below: 0.2, evidence: 0.1}\n";
    CHECK(labels(load(pack), openings({1.1, 1.49})).back() == "window");
    CHECK(labels(load(pack), openings({1.1, 1.1, 1.49})).back() == "hatch");
  }

  TEST_CASE("evidence lifts over min_score and drops below it by its most and no more") {
    const auto pack = [](const std::string& typical) {
      return sizing(typical, "", "min_score: 0.6, ambiguous_below: 0.2, evidence: 0.1");
    };
    const auto with = [&](const std::string& typical, double size) {
      return labels(load(pack(typical)), five_windows_and(size)).back();
    };
    CHECK(with("", 1.45) == "window");
    CHECK(with("", 1.51) == "-");
    const auto alone = [&](const std::string& typical, double size) {
      return labels(load(pack(typical)), openings({1.2, size})).back();
    };
    CHECK(alone(", typical: {per building: 0 .. 1}", 1.35) == "-");
    CHECK(alone(", typical: {per building: 0 .. 1}", 1.25) == "window");
    CHECK(alone("", 1.35) == "window");
  }

  TEST_CASE("evidence never names what no rule holds for") {
    Scene scene = five_windows_and(1.52);
    const FeatureId silent = scene.add({{"a", 1.2}, {"natural", 0.0}});
    for (int i = 0; i < 6; ++i) scene.relate_both("alike", silent, FeatureId{i});
    CHECK(labels(load(sizing("", "", kWeighing)), scene).back() == "-");
  }

  TEST_CASE("company is what the pack says it is") {
    Scene scene = openings({1.2, 1.2, 1.52});
    scene.relate("beside", FeatureId{2}, FeatureId{0});
    scene.relate("above", FeatureId{2}, FeatureId{1});
    scene.relate("above", FeatureId{2}, FeatureId{0});
    const auto with = [&](const std::string& company) {
      return explained(load(sizing("", "", std::string(kWeighing) + ", company: " + company)),
                       scene, 2);
    };
    CHECK(with("beside").rules[0].evidence->company == 1);
    CHECK(with("[beside, above]").rules[0].evidence->company == 2);
    CHECK(with("[beside, above]").verdict.label == "window");
    CHECK(with("[]").rules[0].evidence->company == 0);
    CHECK(with("[]").verdict.label == "door");
    CHECK(with("alike").verdict.label == "door");
  }

  TEST_CASE("company may be a relation of the pack") {
    const std::string row =
        "relations: {in_row: {within: same storey, where: abs(base_height - other.base_height) <= "
        "0.2 m}}\n";
    const RuleBase base = load(sizing("", "", std::string(kWeighing) + ", company: in_row") + row);
    Scene scene;
    scene.add({{"a", 1.2}, {"natural", 1.0}, {"base_height", 0.9}});
    scene.add({{"a", 1.52}, {"natural", 1.0}, {"base_height", 1.0}});
    scene.add({{"a", 1.52}, {"natural", 1.0}, {"base_height", 0.5}});
    relate_all(scene, "same_storey", 3);
    CHECK(labels(base, scene) == Labels{"window", "window", "door"});
  }

  TEST_CASE("those that are close are decided together") {
    // The second is turned by the first, the third by the second, and so on.
    Scene scene = openings({1.2, 1.51, 1.52, 1.53, 1.54});
    for (int i = 1; i < 5; ++i) scene.relate("alike", FeatureId{i}, FeatureId{i - 1});
    const RuleBase base = load(sizing("", "", kWeighing));
    CHECK(labels(base, scene) == Labels{"window", "window", "window", "window", "window"});
    // The same where the closest is the last of the chain.
    Scene back = openings({1.2, 1.54, 1.53, 1.52, 1.51});
    for (int i = 1; i < 5; ++i) back.relate("alike", FeatureId{i}, FeatureId{i - 1});
    CHECK(labels(base, back) == Labels{"window", "window", "window", "window", "window"});
    CHECK(interpret(base, back.table(), back.graph()).issues.empty() == false);  // R260, close
    for (const Issue& issue : interpret(base, back.table(), back.graph()).issues)
      CHECK(issue.code == Code::R260);
  }

  TEST_CASE("evidence that never settles is reported") {
    // The first wants to be what the second is, the second what the first is not.
    Scene scene = openings({1.51, 1.52});
    scene.relate("alike", FeatureId{0}, FeatureId{1});
    scene.relate("same_storey", FeatureId{1}, FeatureId{0});
    const RuleBase base = load(counting_doors("per storey: 1 .. 1"));
    const auto said = interpret(base, scene.table(), scene.graph());
    const auto issue = std::ranges::find(said.issues, Code::R261, &Issue::code);
    REQUIRE(issue != said.issues.end());
    CHECK(to_string(*issue) ==
          "house: R261 after 8 looks at their neighbours 2 features still change: f0, f1");
    CHECK(issue->severity == Severity::warning);
  }

  TEST_CASE("later rules read the labels that evidence has made") {
    const std::string later =
        "  - {id: h, label: hatch, require: exists(beside where is window) and not natural}\n"
        "decide";
    const auto pack = [&](const std::string& decide) {
      std::string text = sizing("", "", decide);
      text.replace(text.find("decide"), 6, later);
      return text.replace(text.find("rules:"), 0, "  hatch: {}\n");
    };
    Scene scene = five_windows_and(1.52);
    scene.relate("beside", scene.add({{"a", 1.0}, {"natural", 0.0}}), FeatureId{5});
    CHECK(labels(load(pack(kNotWeighing)), scene).back() == "-");
    CHECK(labels(load(pack(kWeighing)), scene).back() == "hatch");
  }

  TEST_CASE("a pack that iterates weighs in every round") {
    const std::string iterating = sizing("", "", kWeighing) + "iterate: {rounds: 2}\n";
    CHECK(labels(load(iterating), five_windows_and(1.52)).back() == "window");
  }

  TEST_CASE("what is labelled later is no evidence for what is labelled before") {
    // Three openings are typical. The last feature is close: it is a window where fewer are there.
    // Hatches are openings, too, and are found beside windows.
    const auto pack = [](const std::string& more) {
      return "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses:\n"
             "  opening: {abstract: true, typical: {per building: 3 ..}}\n"
             "  window: {is: opening}\n"
             "  hatch: {is: opening}\n"
             "  door: {}\n"
             "rules:\n"
             "  - {id: w, label: window, require: natural, score: [a: {fall: 1 m .. 2 m}]}\n"
             "  - {id: d, label: door, require: natural, score: [a: {rise: 1 m .. 2 m}]}\n"
             "  - {id: h, label: hatch, require: exists(beside where is window) and not natural}\n"
             "decide: {ambiguous_below: 0.2, evidence: 0.1, company: []}\n" +
             more;
    };
    Scene scene = openings({1.2, 1.2, 1.52});
    for (int i = 0; i < 2; ++i)
      scene.relate("beside", scene.add({{"a", 1.0}, {"natural", 0.0}}), FeatureId{0});
    const Labels expected{"window", "window", "window", "hatch", "hatch"};
    CHECK(labels(load(pack("")), scene) == expected);
    // Nor are the labels of the round before.
    CHECK(labels(load(pack("iterate: {rounds: 3}\n")), scene) == expected);
    // If the hatches were there already, there would be openings enough.
    for (int i = 0; i < 2; ++i) scene.add({{"a", 1.0}, {"natural", 1.0}});
    CHECK(labels(load(pack("")), scene) ==
          Labels{"window", "window", "door", "hatch", "hatch", "window", "window"});
  }

  TEST_CASE("evidence that would need itself is refused with its place") {
    const auto refused = [](const std::string& sections) {
      return findings("schema: oriel/1\npack: {name: t, version: 1.0.0}\n" + sections +
                      "decide: {ambiguous_below: 0.2, evidence: 0.1, company: [row]}\n");
    };
    const std::string rules = "rules: [{id: w, label: window, require: natural}]\n";
    const auto with_relations = [&](const std::string& relations) {
      return refused("classes: {window: {}}\nrelations: {" + relations + "}\n" + rules);
    };
    CHECK(with_relations("row: {within: row, where: a > 1 m}") ==
          "t.yaml:4:27: R207 the relation 'row' uses itself: 'within' names one that is built in "
          "or declared above\nrelations: {row: {within: row, where: a > 1 m}}\n                    "
          "      ^~~\n");
    CHECK(with_relations("row: {within: line, where: a > 1 m}, line: {within: row, where: b > 1 m}")
              .starts_with("t.yaml:4:27: R207 the relation 'line' is declared below 'row': "));
    CHECK(with_relations("row: {within: beside, where: other is window}")
              .starts_with("t.yaml:4:42: R249 "));
    CHECK(
        with_relations("row: {within: beside, where: exists(row)}").starts_with("t.yaml:4:42: R"));
    CHECK(with_relations("beside: {within: beside, where: a > 1 m}, row: {within: beside, where: b "
                         "> 1 m}")
              .empty());  // the built-in one, narrowed twice
    const std::string beside = "relations: {row: {within: beside, where: a > 1 m}}\n";
    CHECK(refused("classes: {window: {is: part}, part: {is: window, typical: {per storey: 1 "
                  "..}}}\n" +
                  beside + rules)
              .starts_with("t.yaml:3:11: R244 "));
    // Labels whose rules ask for each other, whatever evidence says between them.
    const std::string asking =
        "classes: {window: {typical: {per storey: 1 .. 2}}, door: {typical: {per storey: 1 .. "
        "2}}}\n"
        "rules:\n"
        "  - {id: w, label: window, require: exists(row where is door)}\n"
        "  - {id: d, label: door, require: exists(row where is window)}\n";
    CHECK(refused(asking + beside).find("R243 these rules depend on each other") !=
          std::string::npos);
  }

  TEST_CASE("explain says what the others added") {
    const RuleBase base = load(sizing(", typical: {per building: 2 .. 12}", "", kWeighing));
    const auto report = explained(base, five_windows_and(1.52), 5);
    REQUIRE(report.without_evidence);
    CHECK(report.without_evidence->label == "door");
    const std::string text = to_text(report);
    CHECK(
        text.starts_with("f5 -> window 0.58 by w, margin 0.06, then door; without evidence door "
                         "0.52 by d\n"));
    CHECK(has_line(text, "  w                 holds, score 0.48, evidence +0.10"));
    CHECK(has_line(text, "    evidence +0.10  5 of 5 alike are window "));
    CHECK(text.find("f0, f1, f2, f3, f4") != std::string::npos);
    CHECK(has_line(text, "    evidence 0.00   window in the building: 5 others "));
    CHECK(text.find("typical 2 .. 12") != std::string::npos);
    CHECK(reason(report) ==
          "window 0.58 by w: natural: yes; 0.48 x1: a is 1.52 m, falls 1.00 m .. 2.00 m; evidence "
          "+0.10: 5 of 5 alike are window, f0, f1, f2, f3, f4; evidence 0.00: window in the "
          "building: 5 others, typical 2 .. 12; without evidence door 0.52 by d");
    const std::string json = to_json(report);
    CHECK(json.find(R"("without_evidence":{"label":"door","score":0.52)") != std::string::npos);
    CHECK(json.find(R"("company":{"relations":["alike"],"others":5,"holders":["f0",)") !=
          std::string::npos);
    CHECK(json.find(R"("counts":[{"label":"window","per":"building","others":5,"low":2,)") !=
          std::string::npos);
  }

  TEST_CASE("explain says nothing of evidence where a verdict is clear") {
    const auto report = explained(load(sizing("", "", kWeighing)), five_windows_and(1.7), 5);
    CHECK_FALSE(report.without_evidence);
    CHECK(to_text(report).find("evidence") == std::string::npos);
    CHECK(to_json(report).find("evidence") == std::string::npos);
  }

  TEST_CASE("the best candidate of an unknown feature counts its evidence") {
    const auto report =
        explained(load(sizing("", ", typical: {per building: 1 .. 2}",
                              "min_score: 0.65, ambiguous_below: 0.2, evidence: 0.1")),
                  openings({1.49}), 0);
    CHECK(report.verdict.label.empty());
    CHECK(to_text(report).starts_with("f0 -> unknown   no rule for a label holds") == false);
  }

  TEST_CASE("the nearest flip is labelled with evidence") {
    const std::string params =
        "params:\n"
        "  most: {value: 0.1, range: 0 .. 0.1}\n";
    const RuleBase base = load(sizing("", "", "ambiguous_below: 0.2, evidence: $most") + params);
    const auto report = explained(base, five_windows_and(1.52), 5);
    CHECK(report.verdict.label == "window");
    REQUIRE(report.flip);
    REQUIRE(report.flip->nearest);
    CHECK(report.flip->nearest->param == "most");
    CHECK(report.flip->nearest->label == "door");
    CHECK(report.flip->nearest->to == doctest::Approx(0.03).epsilon(0.5));
  }

  TEST_CASE("labels do not depend on the order of features and what is clear stays") {
    const std::string typical = ", typical: {per building: 1 .. 3, per storey: 0 .. 2}";
    const std::string few = ", typical: {per building: 1 .. 4}";
    const RuleBase weighing = load(sizing(few, typical, kWeighing));
    const RuleBase plain = load(sizing("", "", kNotWeighing));
    int moved = 0;
    rc::check([&] {
      const auto count = *rc::gen::inRange(1, 12);
      Scene scene;
      for (int i = 0; i < count; ++i)
        scene.add({{"a", *rc::gen::inRange(120, 181) / 100.0}, {"natural", 1.0}});
      const auto pairs = *rc::gen::inRange(0, 4 * count);
      for (int i = 0; i < pairs; ++i) {
        const FeatureId p{*rc::gen::inRange(0, count)}, q{*rc::gen::inRange(0, count)};
        if (p == q) continue;
        scene.relate_both(*rc::gen::element<std::string>("alike", "same_storey"), p, q);
      }
      std::vector<int> order(static_cast<std::size_t>(count));
      std::iota(order.begin(), order.end(), 0);
      for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1],
                  order[static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(i)))]);
      const Scene moved_scene = scene.reordered(order);
      FeatureTable table = scene.table(), reordered = moved_scene.table();
      for (int i = 0; i < count; ++i)
        reordered.set_id(FeatureId{order[static_cast<std::size_t>(i)]}, table.id(FeatureId{i}));
      const auto said = interpret(weighing, table, scene.graph()).verdicts;
      const auto again = interpret(weighing, reordered, moved_scene.graph()).verdicts;
      const auto alone = interpret(plain, table, scene.graph()).verdicts;
      for (std::size_t i = 0; i < said.size(); ++i) {
        const Verdict& other = again[static_cast<std::size_t>(order[i])];
        RC_ASSERT(said[i].label == other.label);
        RC_ASSERT(said[i].score == other.score);
        RC_ASSERT(said[i].margin == other.margin);
        if (said[i].label != alone[i].label) ++moved;
        if (alone[i].margin < 0.2) continue;
        RC_ASSERT(said[i].label == alone[i].label);
        RC_ASSERT(said[i].rule == alone[i].rule);
        RC_ASSERT(said[i].score == alone[i].score);
        RC_ASSERT(said[i].margin == alone[i].margin);
      }
    });
    CHECK(moved > 0);
  }
}
