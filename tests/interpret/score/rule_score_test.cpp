#include "interpret/score/rule_score.h"

#include <cmath>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel;

namespace {

Box pane_at(double x) { return {{x, 0, 1}, {x + 1, 0.2, 2}}; }

ExpectedObject there(const char* id, const char* label, double x, bool has_faces = true) {
  return {"house", id, label, "", pane_at(x), has_faces};
}

Prediction said(const char* id, const char* label, double x, const char* rule,
                const char* runner_up = "") {
  return {"house", id, label, pane_at(x), 0.5, rule, runner_up};
}

const std::vector<Prediction> kSaid{
    said("a", "window", 0, "w", "door"), said("b", "window", 2, "w", "door"),
    said("c", "window", 4, "w", "door"), said("d", "window", 6, "w"),
    said("e", "window", 8, "w"),         said("f", "door", 10, "d"),
    said("g", "window", 12, ""),         said("h", "", 14, "", "window")};
const std::vector<ExpectedObject> kThere{there("1", "window", 0), there("2", "door", 2),
                                         there("3", "niche", 4),  there("5", "window", 8, false),
                                         there("6", "door", 10),  there("7", "window", 12)};

std::map<std::string, RuleScore> scored_rules() {
  return score_by_rule(kSaid, score(kSaid, kThere));
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("of every rule what it decided is right or wrong or left out") {
    const auto by_rule = scored_rules();
    REQUIRE(by_rule.size() == 3);
    const RuleScore& w = by_rule.at("w");
    CHECK(w.label == "window");
    CHECK(w.decided() == 5);
    CHECK(w.right == 1);
    CHECK(w.wrong == 3);
    CHECK(w.left_out == 1);
    CHECK(w.precision() == doctest::Approx(0.25));
    CHECK(by_rule.at("d").precision() == 1);
    CHECK(by_rule.at("-").right == 1);
    CHECK(std::isnan(RuleScore().precision()));
  }

  TEST_CASE("the rules together have the counts of the classes") {
    const Score whole = score(kSaid, kThere);
    std::size_t right = 0, wrong = 0, left_out = 0;
    for (const auto& [id, rule] : scored_rules()) {
      right += rule.right;
      wrong += rule.wrong;
      left_out += rule.left_out;
    }
    ClassScore all;
    for (const auto& [label, counts] : whole.classes) all += counts;
    CHECK(right == all.true_positives);
    CHECK(wrong == all.false_positives);
    CHECK(left_out == whole.neutral);
  }

  TEST_CASE("mistakes of a rule say what is there") {
    const auto by_rule = scored_rules();
    const RuleScore& w = by_rule.at("w");
    CHECK(w.taken_for == std::map<std::string, std::size_t>{{"-", 1}, {"door", 1}, {"niche", 1}});
    REQUIRE(w.mistakes.size() == 3);
    CHECK(w.mistakes[0].prediction_id == "b");
    CHECK(w.mistakes[0].truth_id == "2");
    CHECK(w.mistakes[2].prediction_id == "d");
    CHECK(w.mistakes[2].truth_id.empty());
  }

  TEST_CASE("contests say whether what came second would have been right") {
    const auto by_rule = scored_rules();
    const auto& contests = by_rule.at("w").contests;
    REQUIRE(contests.size() == 1);
    CHECK(contests.at("door").count == 3);
    CHECK(contests.at("door").wrong == 2);
    CHECK(contests.at("door").second_is_right == 1);
    CHECK(by_rule.at("d").contests.empty());
  }

  TEST_CASE("rules are told in lines and as JSON") {
    const auto by_rule = scored_rules();
    const std::string text = to_text(by_rule, 2);
    CHECK(text.find("\nw    window           5      1      3        1      0.250\n") !=
          std::string::npos);
    CHECK(text.find("    wrong: 1 nothing there, 1 door, 1 niche\n") != std::string::npos);
    CHECK(text.find("    contested: 3 by door (2 wrong, 1 of them a door)\n") != std::string::npos);
    CHECK(
        text.find("mistakes by rule: 3\n  w house: b was called window, is door 2 (IoU 1.00)\n") !=
        std::string::npos);
    CHECK(text.ends_with("  ... and 1 more\n"));
    const auto json = nlohmann::json::parse("{" + rules_json(by_rule) + "}");
    CHECK(json["rules"]["w"]["decided"] == 5);
    CHECK(json["rules"]["w"]["taken_for"]["door"] == 1);
    CHECK(json["rules"]["w"]["contests"]["door"]["second_is_right"] == 1);
    CHECK(json["rules"]["w"]["mistakes"].size() == 3);
    CHECK(json["rules"]["-"]["precision"] == 1);
  }
}
