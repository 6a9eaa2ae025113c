#include "interpret/labelling/corrections.h"

#include <doctest/doctest.h>

using namespace oriel;

namespace {

Correction correction(int line, const std::string& feature, const std::string& label) {
  Correction result;
  result.building = "house";
  result.feature = feature;
  result.label = label;
  result.place.file = "c.jsonl";
  result.place.line = line;
  return result;
}

Correction at_point(int line, Vec3 point, const std::string& label, const std::string& id = "") {
  Correction result = correction(line, id, label);
  result.point = point;
  return result;
}

/// A dormer of 2 m and the window in its front.
const std::vector<PlacedFeature> kFeatures = {{"dormer", {{0, 0, 0}, {2, 2, 2}}},
                                              {"pane", {{0.5, 0, 0.5}, {1.5, 0, 1.5}}}};

struct FoundCorrections {
  std::vector<std::pair<std::string, std::string>> labels;
  std::vector<Code> codes;
};

FoundCorrections found_in(const std::vector<Correction>& all) {
  FoundCorrections found;
  std::vector<Issue> issues;
  const Corrections corrections(all);
  for (const auto& [feature, correction] : corrections.find("house", kFeatures, issues))
    found.labels.emplace_back(kFeatures[feature].id, correction->label);
  for (const Issue& issue : issues) {
    CHECK(issue.severity == Severity::warning);
    CHECK(issue.place.file == "c.jsonl");
    found.codes.push_back(issue.code);
  }
  return found;
}

using CorrectedLabels = std::vector<std::pair<std::string, std::string>>;
using Codes = std::vector<Code>;

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("a correction finds its feature by id or by the smallest box at the point") {
    CHECK(found_in({correction(1, "pane", "door")}).labels == CorrectedLabels{{"pane", "door"}});
    CHECK(found_in({at_point(1, {1, 0, 1}, "door")}).labels == CorrectedLabels{{"pane", "door"}});
    CHECK(found_in({at_point(1, {1, -0.04, 1}, "door")}).labels ==
          CorrectedLabels{{"pane", "door"}});
    CHECK(found_in({at_point(1, {1, 1, 1}, "bay")}).labels == CorrectedLabels{{"dormer", "bay"}});
    // The id counts before the point.
    CHECK(found_in({at_point(1, {1, 0, 1}, "bay", "dormer")}).labels ==
          CorrectedLabels{{"dormer", "bay"}});
  }

  TEST_CASE("a correction of what is not there is named with its line") {
    CHECK(found_in({correction(1, "gone", "door")}).codes == Codes{Code::E153});
    CHECK(found_in({at_point(1, {9, 9, 9}, "door")}).codes == Codes{Code::E153});
    CHECK(found_in({at_point(1, {9, 9, 9}, "door", "gone")}).codes == Codes{Code::E153});
    const FoundCorrections old = found_in({at_point(1, {1, 0, 1}, "door", "gone")});
    CHECK(old.codes == Codes{Code::E155});
    CHECK(old.labels == CorrectedLabels{{"pane", "door"}});
    const Corrections other({correction(7, "pane", "door")});
    const auto unknown = other.unknown_buildings({"hous"});
    REQUIRE(unknown.size() == 1);
    CHECK(unknown[0].place.line == 7);
    CHECK(unknown[0].sentence.find("did you mean 'hous'?") != std::string::npos);
    CHECK(other.unknown_buildings({"house"}).empty());
  }

  TEST_CASE("corrections that contradict each other are not used and others are") {
    const FoundCorrections found =
        found_in({correction(1, "pane", "door"), correction(2, "dormer", "bay"),
                  at_point(3, {1, 0, 1}, "window"), correction(4, "dormer", "bay")});
    CHECK(found.codes == Codes{Code::E154});
    CHECK(found.labels == CorrectedLabels{{"dormer", "bay"}});
  }

  TEST_CASE("classes that the pack lacks are dropped and the nearest is named") {
    std::vector<Correction> all = {correction(1, "pane", "doer"), correction(2, "pane", ""),
                                   correction(3, "pane", "door")};
    const auto issues = drop_unknown_classes(all, {"door", "window"});
    REQUIRE(issues.size() == 1);
    CHECK(issues[0].sentence == "the pack has no class 'doer'; did you mean 'door'?");
    CHECK(all.size() == 2);
  }

  TEST_CASE("a corrected verdict names no rule of the pack and leaves its groups") {
    Interpretation interpretation;
    interpretation.verdicts = {{FeatureId{0}, "dormer", 0.7, 0.2, "dormer.any", "bay"},
                               {FeatureId{1}, "window", 0.9, 0.4, "window.any", "door"}};
    interpretation.groups = {{"row.pane", "row", {FeatureId{1}}}};
    const Correction door = correction(1, "pane", "door");
    const Correction same = correction(2, "dormer", "dormer");
    correct(std::vector<CorrectedFeature>{{0, &same}, {1, &door}}, interpretation);
    CHECK(interpretation.verdicts[1].label == "door");
    CHECK(interpretation.verdicts[1].rule == "corrected");
    CHECK(interpretation.verdicts[1].runner_up == "window");
    CHECK(interpretation.verdicts[1].score == 1);
    CHECK(interpretation.verdicts[0].label == "dormer");
    CHECK(interpretation.verdicts[0].runner_up == "bay");
    CHECK(interpretation.groups.empty());
  }

  TEST_CASE("corrections are truth where there is no other and nothing is known elsewhere") {
    const Correction door = correction(1, "pane", "door");
    const std::vector<CorrectedFeature> corrected = {{1, &door}};
    const auto alone = objects_of_corrections("house", kFeatures, corrected, {});
    REQUIRE(alone.size() == 2);
    CHECK(alone[0].label == "door");
    CHECK_FALSE(is_left_out(alone[0]));
    CHECK(is_left_out(alone[1]));
    const ExpectedObject elsewhere{"house", "t", "window", "", {{8, 0, 0}, {9, 0, 1}}, true};
    CHECK(objects_of_corrections("house", kFeatures, corrected, std::vector{elsewhere}).size() ==
          1);
    const ExpectedObject there{"house", "t", "window", "", kFeatures[1].box, true};
    CHECK(objects_of_corrections("house", kFeatures, corrected, std::vector{there}).empty());
    // What was labelled rightly counts, and the dormer, of which nobody said anything, does not.
    std::vector<Prediction> predictions = {{"house", "dormer", "bay", kFeatures[0].box},
                                           {"house", "pane", "door", kFeatures[1].box}};
    const Score found = score(predictions, alone);
    CHECK(found.classes.at("door").f1() == 1);
    CHECK(found.classes.size() == 1);
    CHECK(found.neutral == 1);
    const Correction nothing = correction(1, "pane", "");
    const auto none = objects_of_corrections("house", kFeatures,
                                             std::vector<CorrectedFeature>{{1, &nothing}}, {});
    CHECK(score(predictions, none).classes.at("door").false_positives == 1);
  }
}
