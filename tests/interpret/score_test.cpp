#include "interpret/score.h"

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
}
