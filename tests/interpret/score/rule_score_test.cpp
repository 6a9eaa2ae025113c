#include "interpret/score/rule_score.h"

#include <cmath>

#include <doctest/doctest.h>
#include <fmt/format.h>
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

  TEST_CASE("rules of the pack that decided nothing are there too") {
    const auto pack = [](const std::string& rules) {
      return load_pack(
                 "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {opening: {abstract: "
                 "true}, window: {}, door: {}}\nrules:\n"
                 "  - {id: o, label: opening, require: natural}\n"
                 "  - {id: w, label: window, require: a > 1 m}\n" +
                     rules,
                 "t.yaml")
          .value.value();
    };
    auto by_rule = scored_rules();
    const auto before = to_text(by_rule, 9);
    CHECK(before.find("decided nothing") == std::string::npos);
    CHECK_FALSE(add_rules_without_decision(pack(""), by_rule));  // "d" is of another pack
    CHECK_FALSE(add_rules_without_decision(pack("  - {id: d, label: window, require: a > 2 m}\n"),
                                           by_rule));
    CHECK(by_rule.size() == 3);
    CHECK(add_rules_without_decision(pack("  - {id: d, label: door, require: a > 2 m}\n"
                                          "  - {id: e, label: door, require: a > 3 m}\n"
                                          "  - {id: d.low, label: door, require: a > 4 m}\n"),
                                     by_rule));
    CHECK(by_rule.size() == 5);
    CHECK(by_rule.at("e").label == "door");
    CHECK(by_rule.at("e").decided() == 0);
    CHECK(to_text(by_rule, 9).find("\ndecided nothing: d.low, e\nmistakes by rule: 3\n") !=
          std::string::npos);
  }

  TEST_CASE("each rule shows some of its mistakes") {
    std::map<std::string, RuleScore> by_rule;
    for (const auto& [id, wrong] : {std::pair("a", 9), std::pair("b", 1), std::pair("c", 3)}) {
      RuleScore& rule = by_rule[id];
      rule.label = "window";
      rule.wrong = static_cast<std::size_t>(wrong);
      for (int i = 0; i < wrong; ++i) {
        Miss miss;
        miss.building = "house";
        miss.prediction_id = fmt::format("{}{}", id, i);
        miss.prediction_label = "window";
        rule.mistakes.push_back(miss);
      }
    }
    const auto shown = [&](std::size_t most) {
      const std::string text = to_text(by_rule, most);
      std::string ids;
      for (const char* id : {"a0", "a1", "a2", "a8", "b0", "c0", "c1", "c2"})
        if (text.find(std::string(": ") + id + " was called") != std::string::npos)
          ids += std::string(ids.empty() ? "" : " ") + id;
      return ids;
    };
    CHECK(shown(13) == "a0 a1 a2 a8 b0 c0 c1 c2");
    CHECK(shown(7) == "a0 a1 a2 b0 c0 c1 c2");
    CHECK(shown(6) == "a0 a1 b0 c0 c1");
    CHECK(shown(0) == "a0 b0 c0");
    CHECK(to_text(by_rule, 6).find("  a ... and 7 more\n") != std::string::npos);
  }

  TEST_CASE("rules are told in lines and as JSON") {
    const auto by_rule = scored_rules();
    const std::string text = to_text(by_rule, 2);
    CHECK(text.find("\nw    window           5      1      3         1      0.250\n") !=
          std::string::npos);
    CHECK(text.find("    wrong: 1 nothing there, 1 door, 1 niche\n") != std::string::npos);
    CHECK(text.find("    contested: 3 by door (2 wrong, 1 of them a door)\n") != std::string::npos);
    CHECK(
        text.find("mistakes by rule: 3\n  w house: b was called window, is door 2 (IoU 1.00)\n") !=
        std::string::npos);
    CHECK(text.ends_with("  w ... and 1 more\n"));
    const auto json = nlohmann::json::parse("{" + rules_json(by_rule) + "}");
    CHECK(json["rules"]["w"]["decided"] == 5);
    CHECK(json["rules"]["w"]["taken_for"]["door"] == 1);
    CHECK(json["rules"]["w"]["contests"]["door"]["second_is_right"] == 1);
    CHECK(json["rules"]["w"]["mistakes"].size() == 3);
    CHECK(json["rules"]["-"]["precision"] == 1);
  }
}
