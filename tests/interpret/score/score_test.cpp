#include "interpret/score/area_score.h"
#include "interpret/score/score_spread.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace oriel;

namespace {

/// A box of width 1, depth 0.2 and height 1 at x.
Box window_at(double x) { return {{x, 0, 1}, {x + 1, 0.2, 2}}; }

ExpectedObject object(const char* id, const char* label, double x) {
  return {"house", id, label, "", window_at(x), true};
}

Prediction prediction(const char* id, const char* label, double x) {
  return {"house", id, label, window_at(x)};
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("hits misses and false finds are counted per class") {
    const Score found = score({prediction("a", "window", 0), prediction("b", "window", 2.1),
                               prediction("c", "window", 50)},
                              {object("1", "window", 0), object("2", "window", 2),
                               object("3", "window", 4), object("4", "door", 6)});
    const ClassScore& window = found.classes.at("window");
    CHECK(window.true_positives == 2);
    CHECK(window.false_positives == 1);
    CHECK(window.false_negatives == 1);
    CHECK(window.precision() == doctest::Approx(2.0 / 3).epsilon(1e-12));
    CHECK(window.recall() == doctest::Approx(2.0 / 3).epsilon(1e-12));
    CHECK(window.f1() == doctest::Approx(2.0 / 3).epsilon(1e-12));
    CHECK(found.classes.at("door").f1() == 0);
    CHECK(found.macro_f1() == doctest::Approx(1.0 / 3).epsilon(1e-12));
    REQUIRE(found.misses.size() == 3);
    CHECK(found.misses[0].prediction_id == "c");
    CHECK(found.misses[1].truth_id == "4");
    CHECK(found.misses[2].truth_id == "3");
  }

  TEST_CASE("boxes are grown before they are compared") {
    // Boxes of 1 x 0 x 1 m, 0.1 m apart along y: alone they share nothing.
    const Prediction pane{"house", "p", "window", {{0, 0.03, 0}, {1, 0.03, 1}}};
    const ExpectedObject frame{"house", "t", "window", "", {{0, 0, 0}, {1, 0, 1}}, true};
    CHECK(score({pane}, {frame}).classes.at("window").true_positives == 1);
    CHECK(score({pane}, {frame}, {.grow_m = 0}).classes.at("window").true_positives == 0);
  }

  TEST_CASE("the overlap that is needed is half the union") {
    // Grown by nothing: shift s of a box of length 1 has IoU (1 - s) / (1 + s); 1/2 at s = 1/3.
    const auto hits = [](double shift) {
      const Score found =
          score({prediction("a", "window", shift)}, {object("1", "window", 0)}, {.grow_m = 0});
      return found.classes.at("window").true_positives;
    };
    CHECK(hits(0.33) == 1);
    CHECK(hits(0.34) == 0);
  }

  TEST_CASE("matching is one to one and takes the best pair first") {
    const Score found = score({prediction("a", "window", 0.2), prediction("b", "window", 0.05)},
                              {object("1", "window", 0), object("2", "window", 0.1)});
    CHECK(found.classes.at("window").true_positives == 2);
    const Score twice = score({prediction("a", "window", 0), prediction("b", "window", 0)},
                              {object("1", "window", 0)});
    CHECK(twice.classes.at("window").true_positives == 1);
    CHECK(twice.classes.at("window").false_positives == 1);
    REQUIRE(twice.misses.size() == 1);
    CHECK(twice.misses[0].prediction_id == "b");
  }

  TEST_CASE("a wrong label is a false find of one class and a miss of the other") {
    const Score found =
        score({prediction("a", "door", 0)}, {object("1", "window", 0), object("2", "door", 9)});
    CHECK(found.classes.at("door").false_positives == 1);
    CHECK(found.classes.at("door").false_negatives == 1);
    CHECK(found.classes.at("window").false_negatives == 1);
    CHECK(found.confusion.at({"window", "door"}) == 1);
    CHECK(found.confusion.at({"door", "-"}) == 1);
  }

  TEST_CASE("the right label is preferred to the better box") {
    const Score found =
        score({prediction("a", "door", 0.2)}, {object("1", "window", 0.2), object("2", "door", 0)});
    CHECK(found.classes.at("door").true_positives == 1);
  }

  TEST_CASE("objects without faces and unnamed installations neither help nor hurt") {
    ExpectedObject detached = object("1", "window", 0);
    detached.has_faces = false;
    ExpectedObject unnamed = object("2", "other", 5);
    unnamed.subclass = "installation";
    const Score found =
        score({prediction("a", "window", 0), prediction("b", "chimney", 5)}, {detached, unnamed});
    CHECK(found.classes.empty());
    CHECK(found.neutral == 2);
    CHECK(found.misses.empty());
    CHECK(std::isnan(found.macro_f1()));
    CHECK(score({}, {detached, unnamed}).classes.empty());
  }

  TEST_CASE("surfaces and decor are not missed but a label on decor is false") {
    const Score found =
        score({prediction("a", "window", 0)}, {object("1", "other", 0), object("2", "wall", 3)});
    CHECK(found.classes.size() == 1);
    CHECK(found.classes.at("window").false_positives == 1);
    CHECK(found.confusion.at({"other", "window"}) == 1);
    CHECK(std::isnan(found.macro_f1()));
  }

  TEST_CASE("buildings are kept apart") {
    ExpectedObject elsewhere = object("1", "window", 0);
    elsewhere.building = "other house";
    const Score found = score({prediction("a", "window", 0)}, {elsewhere});
    CHECK(found.classes.at("window").true_positives == 0);
  }

  TEST_CASE("predictions without a label are not looked at") {
    const Score found = score({prediction("a", "", 0)}, {object("1", "window", 0)});
    CHECK(found.classes.at("window").false_negatives == 1);
    CHECK(found.classes.at("window").false_positives == 0);
  }

  TEST_CASE("a score is written as a table and as JSON") {
    const Score found = score({prediction("a", "window", 0), prediction("b", "window", 3)},
                              {object("1", "window", 0), object("2", "door", 3)});
    CHECK(to_text(found) ==
          "class            tp     fp     fn  precision  recall     F1\n"
          "door              0      0      1          -   0.000  0.000\n"
          "window            1      1      0      0.500   1.000  0.667\n"
          "macro-F1 0.333\n"
          "truth -> predicted\n"
          "  door         -> window            1\n"
          "  window       -> window            1\n"
          "misses: 1\n"
          "  house: door 2 was called window (b, IoU 1.00)\n");
    CHECK(to_json(found) ==
          R"({"classes":{"door":{"tp":0,"fp":0,"fn":1,"precision":null,"recall":0,"f1":0},)"
          R"("window":{"tp":1,"fp":1,"fn":0,"precision":0.5,"recall":1,"f1":0.6666666666666666}},)"
          R"("macro_f1":0.3333333333333333,"neutral":0,)"
          R"("confusion":[{"truth":"door","predicted":"window","count":1},)"
          R"({"truth":"window","predicted":"window","count":1}],)"
          R"("misses":[{"building":"house","truth_id":"2","truth":"door","prediction_id":"b",)"
          R"("predicted":"window","iou":1}]})");
  }

  TEST_CASE("a table with fewer misses than there are says how many more there are") {
    const Score found = score({}, {object("1", "door", 0), object("2", "door", 3)});
    const std::string text = to_text(found, 1);
    CHECK(text.find("door 1 was not found") != std::string::npos);
    CHECK(text.find("door 2 was not found") == std::string::npos);
    CHECK(text.ends_with("  ... and 1 more\n"));
    CHECK(to_text(found, 2).find("more") == std::string::npos);
  }

  TEST_CASE("buildings are scored one by one and add up") {
    std::vector<Prediction> predictions = {prediction("a", "window", 0)};
    std::vector<ExpectedObject> truth = {object("1", "window", 0), object("2", "window", 5)};
    predictions.push_back(predictions[0]);
    predictions[1].building = "shed";
    const auto buildings = score_by_building(predictions, truth);
    REQUIRE(buildings.size() == 2);
    CHECK(buildings.at("house").classes.at("window").false_negatives == 1);
    CHECK(buildings.at("shed").classes.at("window").false_positives == 1);
    CHECK(to_json(total(buildings)) == to_json(score(predictions, truth)));
  }

  TEST_CASE("the curve has for each score what is found from there on") {
    std::vector<Prediction> predictions = {
        prediction("a", "window", 0), prediction("b", "window", 9), prediction("c", "door", 4)};
    predictions[0].score = 0.9;
    predictions[1].score = 0.5;
    predictions[2].score = 0.5;
    const std::vector<ExpectedObject> truth = {object("1", "window", 0), object("2", "door", 4)};
    const auto curve = precision_recall_curve(predictions, truth);
    REQUIRE(curve.size() == 4);
    CHECK(curve[0].label == "door");
    CHECK(curve[0].threshold == 0.9);
    CHECK(curve[0].counts.false_negatives == 1);
    CHECK(curve[1].counts.precision() == 1);
    CHECK(curve[2].counts.f1() == 1);
    CHECK(curve[3].label == "window");
    CHECK(curve[3].counts.precision() == 0.5);
    // The last threshold leaves nothing out.
    const Score all = score(predictions, truth);
    CHECK(curve[3].counts.f1() == all.classes.at("window").f1());
  }

  TEST_CASE("a better match behind the threshold gives its object back") {
    std::vector<Prediction> predictions = {prediction("a", "window", 0),
                                           prediction("b", "window", 0.2)};
    predictions[0].score = 0.1;
    predictions[1].score = 0.8;
    const auto curve = precision_recall_curve(predictions, {object("1", "window", 0)});
    REQUIRE(curve.size() == 2);
    CHECK(curve[0].counts.true_positives == 1);
    CHECK(curve[1].counts.true_positives == 1);
    CHECK(curve[1].counts.false_positives == 1);
  }

  TEST_CASE("intervals hold the value and close where all buildings are alike") {
    std::map<std::string, Score> buildings;
    for (int i = 0; i < 40; ++i) buildings[std::to_string(i)].classes["window"] = {9, 1, 1};
    const Intervals alike = bootstrap(buildings, 200);
    CHECK(alike.f1.at("window").low == alike.f1.at("window").high);
    CHECK(alike.macro_f1.low == 0.9);
    for (int i = 0; i < 20; ++i) buildings[std::to_string(i)].classes["window"] = {5, 5, 5};
    const Intervals apart = bootstrap(buildings, 2000);
    // Half of the buildings at 0.9, half at 0.5: 0.7, with a standard error of 0.2 / sqrt(40).
    CHECK(apart.macro_f1.low == doctest::Approx(0.7 - 1.96 * 0.2 / std::sqrt(40)).epsilon(0.03));
    CHECK(apart.macro_f1.high == doctest::Approx(0.7 + 1.96 * 0.2 / std::sqrt(40)).epsilon(0.03));
    CHECK(intervals_json(apart) == intervals_json(bootstrap(buildings, 2000)));
  }

  TEST_CASE("a class that a sample lacks says nothing of it") {
    std::map<std::string, Score> buildings;
    buildings["with"].classes["window"] = {3, 0, 0};
    buildings["without"].classes["door"] = {0, 0, 0};
    const Intervals intervals = bootstrap(buildings, 100);
    CHECK(intervals.f1.at("window").low == 1);
    CHECK(std::isnan(intervals.f1.at("door").low));
    CHECK(intervals_json(intervals).find(R"("door":[null,null])") != std::string::npos);
  }

  TEST_CASE("areas are compared polygon by polygon with the innermost object of each") {
    // Squares of 1, 2, 3 and 4 m side by side.
    Building building;
    for (int i = 0; i < 4; ++i) {
      const double x = 10.0 * i, side = i + 1;
      const int first = 4 * i;
      for (const Vec3 p : {Vec3{x, 0, 0}, {x + side, 0, 0}, {x + side, 0, side}, {x, 0, side}})
        building.vertices.push_back(p);
      Polygon& square = building.polygons.emplace_back();
      square.rings = {{first, first + 1, first + 2, first + 3}};
      square.source = i;
    }
    FacesOfBuilding faces;
    faces.truth = {{"w", "window", {0, 1}}, {"wall", "wall", {2}}, {"d", "dormer", {0, 1, 3}}};
    faces.predictions = {{"f", "window", {0, 2}}, {"g", "dormer", {0, 1, 3}}, {"h", "", {3}}};
    AreaScore score;
    compare_areas(building, faces, {"wall"}, score);
    CHECK(score.compared_m2 == 30);
    CHECK(score.classes.at("window").both_m2 == 1);
    CHECK(score.classes.at("window").predicted_m2 == 10);
    CHECK(score.classes.at("window").expected_m2 == 5);
    CHECK(score.classes.at("dormer").both_m2 == 16);
    CHECK(score.classes.at("dormer").predicted_m2 == 20);
    CHECK(score.macro_f1() == doctest::Approx((2.0 / 15 + 32.0 / 36) / 2).epsilon(1e-12));
    // The wall's polygon is a reveal of the window, and the last one was made to close the shell.
    faces.niches["w"] = {{20, -1, 0}, {23, 1, 3}};
    faces.left_out = {3};
    AreaScore without;
    compare_areas(building, faces, {"wall"}, without);
    CHECK(without.compared_m2 == 5);
    CHECK(without.classes.at("window").predicted_m2 == 1);
  }
}
