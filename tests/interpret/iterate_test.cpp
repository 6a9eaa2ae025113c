#include "interpret/explain/explain.h"
#include "tests/interpret/support.h"

using namespace oriel;
using namespace oriel::test;

namespace {

/// Openings are windows or doors by their size, the more surely the more of their neighbours are.
/// `ramp` says how much those count.
std::string mutual(const std::string& ramp) {
  return "rules:\n"
         "  - id: w\n"
         "    label: window\n"
         "    require: natural\n"
         "    score: [a: {fall: 1 m .. 2 m}, count(beside where is window): {" +
         ramp +
         "}]\n"
         "  - id: d\n"
         "    label: door\n"
         "    require: natural\n"
         "    score: [a: {rise: 1 m .. 2 m}, count(beside where is door): {" +
         ramp + "}]\n";
}
constexpr const char* kGentle = "rise: 0 .. 2";
constexpr const char* kStrong = "rise: 0 .. 1, weight: 2";

std::string iterating(int rounds, const std::string& ramp) {
  return pack_with("iterate: {rounds: " + std::to_string(rounds) + "}\n" + mutual(ramp));
}

/// Openings of these sizes in a row, each beside the next.
Scene row_of(const std::vector<double>& sizes) {
  Scene scene;
  for (const double size : sizes) scene.add({{"a", size}, {"natural", 1.0}});
  for (int i = 1; i < static_cast<int>(sizes.size()); ++i)
    scene.relate_both("beside", FeatureId{i - 1}, FeatureId{i});
  return scene;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("mutual evidence is a circle unless a pack iterates") {
    CHECK(findings(pack_with(mutual(kGentle))).find("R243") != std::string::npos);
    CHECK(findings(iterating(4, kGentle)).empty());
  }

  TEST_CASE("scores read the labels of the round before") {
    // By its size alone the one in the middle is a door.
    const Scene scene = row_of({1.2, 1.6, 1.2});
    CHECK(labels(load(iterating(8, kGentle)), scene) == Labels{"window", "window", "window"});
    const RuleBase base = load(iterating(8, kGentle));
    const auto verdicts = interpret(base, scene.table(), scene.graph());
    CHECK(verdicts.issues.empty());
    const auto report = explain(base, scene.table(), scene.graph(), verdicts, FeatureId{1});
    REQUIRE(report.rounds.size() >= 3);
    CHECK(report.rounds[0].label == "door");
    CHECK(report.rounds[1].label == "window");
    CHECK(report.rounds.back().label == "window");
    CHECK(to_text(report).find("\n  round 1: door 0.60 by d, margin 0.20\n") != std::string::npos);
    CHECK(to_json(report).find(R"("rounds":[{"label":"door","score":0.6)") != std::string::npos);
  }

  TEST_CASE("what never settles is reported") {
    // Each takes the label of the other, over and over.
    const Scene scene = row_of({1.2, 1.8});
    const RuleBase base = load(iterating(5, kStrong));
    const auto verdicts = interpret(base, scene.table(), scene.graph());
    REQUIRE(verdicts.issues.size() == 1);
    CHECK(to_string(verdicts.issues[0]) ==
          "house: R261 after 5 rounds 2 features still change: f0, f1");
    CHECK(verdicts.issues[0].severity == Severity::warning);
    const auto report = explain(base, scene.table(), scene.graph(), verdicts, FeatureId{0});
    REQUIRE(report.rounds.size() == 5);
    CHECK(report.rounds.back().label == verdicts.verdicts[0].label);
    CHECK(report.rounds[3].label != report.rounds[4].label);
  }

  TEST_CASE("iterating changes nothing where no score asks for a label") {
    const std::string rules =
        "rules:\n"
        "  - {id: w, label: window, require: a > 1.3 m}\n"
        "  - {id: d, label: door, require: exists(beside where is window) and a < 1.3 m}\n";
    const Scene scene = row_of({1.2, 1.6, 1.2, 1.2});
    const Labels expected{"door", "window", "door", "-"};
    CHECK(labels(load(pack_with(rules)), scene) == expected);
    CHECK(labels(load(pack_with("iterate: {rounds: 3}\n" + rules)), scene) == expected);
  }
}
