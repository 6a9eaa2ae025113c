#include "interpret/explain/explain.h"
#include "interpret/plan/plan.h"
#include "tests/interpret/support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

constexpr const char* kInRow =
    "relations:\n"
    "  in_row: {within: same storey, where: abs(base_height - other.base_height) <= 0.2 m}\n";

/// Windows in one storey at those heights; a height below 0 is missing.
Scene storey(const std::vector<double>& heights) {
  Scene scene;
  for (const double height : heights) {
    Values values{{"sense", "hole"}, {"natural", 1.0}};
    if (height >= 0) values["base_height"] = height;
    scene.add(values);
  }
  for (int i = 0; i < static_cast<int>(heights.size()); ++i)
    for (int j = 0; j < i; ++j) scene.relate_both("same_storey", FeatureId{i}, FeatureId{j});
  return scene;
}

Labels labels_with(const std::string& sections, const std::string& condition, const Scene& scene) {
  return labels(load(pack_with(sections + "rules:\n  - {id: w, label: window, require: \"" +
                               condition + "\"}\n")),
                scene);
}

std::vector<std::string> group_ids(const Interpretation& interpretation) {
  std::vector<std::string> ids;
  for (const Group& group : interpretation.groups) ids.push_back(group.id);
  return ids;
}

constexpr const char* kRows =
    "rules: [{id: w, label: window, require: natural}]\n"
    "groups: {row: {of: window, by: in_row, at_least: 2}}\n";

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("a graph of other features than its table is refused") {
    Scene scene = storey({1.0, 1.1});
    scene.relate("beside", FeatureId{0}, FeatureId{7});
    CHECK_THROWS_AS(labels_with("", "exists(beside)", scene), std::invalid_argument);
  }

  TEST_CASE("a declared relation is the pairs of another one that fit its condition") {
    const Scene scene = storey({1.0, 1.1, 1.25, 2.0});
    CHECK(labels_with(kInRow, "count(in_row) = 2", scene) == Labels{"-", "window", "-", "-"});
    CHECK(labels_with(kInRow, "none(in_row)", scene) == Labels{"-", "-", "-", "window"});
    CHECK(labels_with(kInRow, "all(in_row where base_height > self.base_height)", scene) ==
          Labels{"window", "-", "-", "window"});
  }

  TEST_CASE("a quantifier over a declared relation answers as one with its condition written out") {
    // `where` of the relation, seen from the other feature.
    const std::string written = "abs(self.base_height - base_height) <= 0.2 m";
    const auto same = [&](const std::string& p, const std::string& q, const Scene& scene) {
      for (const char* sign : {"", "not "})
        RC_ASSERT(labels_with(kInRow, std::string(sign) + "(" + p + ")", scene) ==
                  labels_with("", std::string(sign) + "(" + q + ")", scene));
    };
    rc::check([&] {
      const auto count = *rc::gen::inRange(0, 7);
      std::vector<double> heights;
      for (int i = 0; i < count; ++i) heights.push_back(*rc::gen::inRange(-1, 6) * 0.1);
      const Scene scene = storey(heights);
      for (const std::string op : {"exists", "none"})
        same(op + "(in_row where base_height > 0.15 m)",
             op + "(same_storey where " + written + " and base_height > 0.15 m)", scene);
      same("count(in_row where base_height > 0.15 m) >= 1",
           "count(same_storey where " + written + " and base_height > 0.15 m) >= 1", scene);
      same("all(in_row where base_height > 0.15 m)",
           "all(same_storey where not " + written + " or base_height > 0.15 m)", scene);
    });
  }

  TEST_CASE("relations narrow one another and speak of self and other") {
    const std::string relations =
        "relations:\n"
        "  in_row: {within: same_storey, where: base_height ~ other.base_height by 10 %}\n"
        "  lower: {within: in_row, where: other.base_height < self.base_height and sense = "
        "other.sense}\n";
    CHECK(labels_with(relations, "count(lower) = 1", storey({1.0, 1.05, 1.5})) ==
          Labels{"-", "window", "-"});
  }

  TEST_CASE("aggregates are the least greatest and mean value of the others") {
    const Scene scene = storey({1.0, 2.0, 6.0});
    CHECK(labels_with("", "min(base_height of same_storey) = 1 m", scene) ==
          Labels{"-", "window", "window"});
    CHECK(labels_with("", "max(base_height of same_storey) = 6 m", scene) ==
          Labels{"window", "window", "-"});
    CHECK(labels_with("", "mean(base_height of same_storey) = 4 m", scene) ==
          Labels{"window", "-", "-"});
    CHECK(labels_with(
              "", "mean(base_height * base_height of same_storey where base_height < 3 m) = 1 m2",
              scene) == Labels{"-", "window", "-"});
    CHECK(labels_with("", "max(abs(base_height - self.base_height) of same_storey) = 5 m", scene) ==
          Labels{"window", "-", "window"});
    CHECK(labels_with("",
                      "mean(base_height of same_storey where base_height > self.base_height) > 3 m",
                      scene) == Labels{"window", "window", "-"});
  }

  TEST_CASE("an aggregate of nothing or of something missing is unknown") {
    for (const std::string op : {"min", "max", "mean"}) {
      const std::string condition = op + "(base_height of same_storey) > 0 m";
      CHECK(labels_with("", condition, storey({1.0})) == Labels{"-"});
      CHECK(labels_with("", "not " + condition, storey({1.0})) == Labels{"-"});
      CHECK(labels_with("", condition, storey({1.0, -1, 2.0})) == Labels{"-", "window", "-"});
    }
  }

  TEST_CASE("a mean does not depend on the order of features") {
    rc::check([] {
      const auto heights = *rc::gen::container<std::vector<double>>(
          5, rc::gen::map(rc::gen::inRange(1, 1000000), [](int i) { return i / 3e5; }));
      std::vector<int> order(heights.size());
      std::iota(order.begin(), order.end(), 0);
      std::ranges::next_permutation(order);
      std::ranges::reverse(order);
      const RuleBase base = load(pack_with(
          "rules:\n  - {id: w, label: window, require: natural, score: [\"mean(base_height of "
          "same_storey)\": {rise: 0 m .. 5 m}]}\n"));
      const Scene scene = storey(heights);
      const Scene moved = scene.reordered(order);
      const auto before = interpret(base, scene.table(), scene.graph()).verdicts;
      const auto after = interpret(base, moved.table(), moved.graph()).verdicts;
      for (std::size_t i = 0; i < before.size(); ++i)
        RC_ASSERT(before[i].score == after[static_cast<std::size_t>(order[i])].score);
    });
  }

  TEST_CASE("groups are the connected components with enough members") {
    const RuleBase base = load(pack_with(std::string(kInRow) + kRows));
    // Neighbours by 0.2 m: the first three hang together though their ends do not.
    const Scene scene = storey({1.0, 1.15, 1.3, 2.0, 3.0, 3.1, -1});
    const auto interpretation = interpret(base, scene.table(), scene.graph());
    CHECK(group_ids(interpretation) == std::vector<std::string>{"row.f0", "row.f4"});
    REQUIRE(interpretation.groups.size() == 2);
    CHECK(interpretation.groups[0].members ==
          std::vector<FeatureId>{FeatureId{0}, FeatureId{1}, FeatureId{2}});
    const auto groups = groups_by_feature(interpretation);
    CHECK(groups[2] == std::vector<std::string>{"row.f0"});
    CHECK(groups[3].empty());
    CHECK(groups[6].empty());
  }

  TEST_CASE("groups do not depend on the order of features") {
    const RuleBase base = load(pack_with(std::string(kInRow) + kRows));
    rc::check([&] {
      const auto steps = *rc::gen::container<std::vector<int>>(8, rc::gen::inRange(0, 20));
      std::vector<double> heights;
      for (const int step : steps) heights.push_back(step * 0.1);
      std::vector<int> order(heights.size());
      std::iota(order.begin(), order.end(), 0);
      std::ranges::rotate(order, order.begin() + *rc::gen::inRange(0, 8));
      const Scene scene = storey(heights);
      const Scene moved = scene.reordered(order);
      const auto partners = [&](const Scene& of, bool is_moved) {
        const auto result = interpret(base, of.table(), of.graph());
        std::vector<std::size_t> sizes(heights.size(), 0);
        for (const Group& group : result.groups)
          for (const FeatureId member : group.members) {
            const auto row = is_moved ? static_cast<std::size_t>(
                                            std::ranges::find(order, member.value) - order.begin())
                                      : member.index();
            sizes[row] = group.members.size();
          }
        return sizes;
      };
      RC_ASSERT(partners(scene, false) == partners(moved, true));
    });
  }

  TEST_CASE("an entry for a group takes it as a whole or not at all") {
    const RuleBase base =
        load(pack_with(std::string(kInRow) + kRows +
                       "generalise: [{id: rows.omit, scale: \"1:500 ..\", for: group row, when: "
                       "base_height < 1.2 m, do: omit}]\n"));
    const auto omitted = [&](const std::vector<double>& heights) {
      const Scene scene = storey(heights);
      const auto verdicts = interpret(base, scene.table(), scene.graph());
      return plan(base, scene.table(), scene.graph(), verdicts, 1000).steps.size();
    };
    CHECK(omitted({1.0, 1.1}) == 2);
    CHECK(omitted({1.1, 1.25}) == 0);
    CHECK(omitted({1.0, 1.1, 3.0}) == 2);
    CHECK(omitted({1.0}) == 0);
  }

  TEST_CASE("a pack puts its own relation in the place of a built-in measure") {
    Scene scene = storey({1.0, 1.1, 1.25});
    scene.relate_both("alike", FeatureId{0}, FeatureId{2});
    CHECK(labels_with("", "exists(alike)", scene) == Labels{"window", "-", "window"});
    const std::string own = "relations: {alike: {within: WITHIN, where: base_height < 1.2 m}}\n";
    const auto within = [&](const std::string& name) {
      return std::string(own).replace(own.find("WITHIN"), 6, name);
    };
    CHECK(labels_with(within("same storey"), "exists(alike)", scene) ==
          Labels{"window", "window", "-"});
    CHECK(labels_with(within("alike"), "exists(alike)", scene) == Labels{"window", "-", "-"});
    for (const std::string name : {"host", "contains", "inside"})
      CHECK(findings(pack_with("relations: {" + name + ": {within: beside, where: natural}}\n" +
                               "rules: []\n"))
                .find(":4:13: R216") != std::string::npos);
  }

  TEST_CASE("the distance along a facade is that of the middles of lower edges") {
    Scene scene;
    for (const auto& [along, height] : {std::pair(1.0, 1.0), {4.0, 5.0}, {1.0, 3.0}})
      scene.add({{"sense", "hole"}, {"along", along}, {"base_height", height}});
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < i; ++j) scene.relate_both("same_facade", FeatureId{i}, FeatureId{j});
    CHECK(labels_with("", "max(distance_along(other) of same_facade) > 4 m", scene) ==
          Labels{"window", "window", "-"});
    const FeatureId unplaced = scene.add({{"sense", "hole"}, {"base_height", 1.0}});
    for (int i = 0; i < 3; ++i) scene.relate_both("same_facade", FeatureId{i}, unplaced);
    const auto near = [&](const std::string& distance) {
      return labels_with("relations: {near: {within: same facade, where: distance_along(other) " +
                             distance + "}}\n",
                         "exists(near)", scene);
    };
    CHECK(near("<= 2 m") == Labels{"window", "-", "window", "-"});
    CHECK(near("= 5 m") == Labels{"window", "window", "-", "-"});
    for (const char* wrong : {"distance_along(self) < 1 m", "distance_along() < 1 m"})
      CHECK(findings(pack_requiring({wrong})).find("R220 expected 'other'") != std::string::npos);
    CHECK(findings(pack_requiring({"distance_along(other) < 1 m"})).find("R236") !=
          std::string::npos);
  }

  TEST_CASE("explain says what a declared relation is and what an aggregate is of") {
    const RuleBase base = load(pack_with(std::string(kInRow) +
                                         "rules: [{id: w, label: window, require: "
                                         "[exists(in_row), max(base_height of in_row) > 2 m]}]\n"));
    const Scene scene = storey({1.0, 1.1});
    const auto verdicts = interpret(base, scene.table(), scene.graph());
    const auto report = explain(base, scene.table(), scene.graph(), verdicts, FeatureId{0});
    REQUIRE(report.rules.at(0).require.size() == 2);
    CHECK(report.rules[0].require[0].value == "exists(in_row) is 1 of 1");
    CHECK(report.rules[0].require[0].bound ==
          "in_row: same_storey where abs(base_height - other.base_height) <= 0.2 m");
    CHECK(report.rules[0].require[1].value == "max(base_height of in_row) is 1.10 m of 1");
    CHECK(report.rules[0].require[1].miss == "misses by 0.90 m");
  }

  TEST_CASE("relations ask for nothing but the attributes of two features") {
    const auto fault = [](const std::string& where) {
      return findings(pack_with("relations: {r: {within: alike, where: \"" + where +
                                "\"}}\nrules: [{id: w, label: window, require: exists(r)}]\n"));
    };
    CHECK(fault("is window").find(":4:40: R249") != std::string::npos);
    CHECK(fault("other.host is window").find(":4:40: R249") != std::string::npos);
    CHECK(fault("exists(host)").find(":4:40: R249") != std::string::npos);
    CHECK(fault("other.host is wall and natural").empty());
    CHECK(findings(pack_with("relations: {r: {within: s, where: natural}, s: {within: alike, "
                             "where: natural}}\nrules: []\n"))
              .find(":4:25: R207 the relation 's' is declared below 'r'") != std::string::npos);
  }

  TEST_CASE("quantifiers that stop early say what all answers together say") {
    // Yes, no and unknown as 2, 0 and 1: `and` is the least, `not` 2 - x.
    const std::vector<std::string> conditions = {
        "exists(beside where X)",     "none(beside where X)",       "all(beside where X)",
        "count(beside where X) >= 2", "count(beside where X) > 2",  "count(beside where X) < 3",
        "count(beside where X) <= 1", "count(beside where X) = 2",  "count(beside where X) != 1",
        "count(beside where X) >= 0", "count(beside where X) < 1.5"};
    std::vector<RuleBase> packs;
    for (std::string condition : conditions) {
      condition.replace(condition.find('X'), 1, "a <= self.a and b > 1 m");
      packs.push_back(load(
          pack_with("rules:\n  - {id: holds, label: window, require: '" + condition +
                    "'}\n  - {id: fails, label: door, require: 'not (" + condition + ")'}\n")));
    }
    const auto compared = [](bool holds, bool is_known) { return is_known ? 2 * holds : 1; };
    const auto expected = [](std::size_t condition, const std::vector<int>& answers) {
      const auto of = [&](int answer) { return std::ranges::count(answers, answer); };
      const int exists = of(2) > 0 ? 2 : of(1) > 0 ? 1 : 0;
      const int all = of(0) > 0 ? 0 : of(1) > 0 ? 1 : 2;
      if (condition < 3) return std::vector<int>{exists, 2 - exists, all}[condition];
      if (of(1) > 0) return 1;
      const auto n = of(2);
      return 2 * std::vector<int>{
                     n >= 2, n > 2, n < 3, n <= 1, n == 2, n != 1, true, n < 2}[condition - 3];
    };
    std::size_t stopped = 0, unknown = 0;
    CHECK(rc::check("early stops", [&] {
      const int count = *rc::gen::inRange(1, 60);
      const bool has_gaps = *rc::gen::inRange(0, 2) == 1;
      const auto number = [&](int most) {
        const int n = *rc::gen::inRange(0, most);
        return has_gaps && n == 0 ? std::nan("") : n * 0.5;
      };
      Scene scene;
      std::vector<double> a, b;
      std::vector<std::vector<int>> others(static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i) {
        a.push_back(number(12));
        b.push_back(number(12));
        Values values;
        if (!std::isnan(a.back())) values["a"] = a.back();
        if (!std::isnan(b.back())) values["b"] = b.back();
        scene.add(values);
      }
      for (int self = 0; self < count; ++self)
        for (int other = 0; other < count; ++other)
          if (self != other && *rc::gen::inRange(0, 3) > 0) {
            scene.relate("beside", FeatureId{self}, FeatureId{other});
            others[static_cast<std::size_t>(self)].push_back(other);
          }
      for (std::size_t c = 0; c < packs.size(); ++c) {
        const Labels found = labels(packs[c], scene);
        for (std::size_t self = 0; self < a.size(); ++self) {
          std::vector<int> answers;
          for (const int o : others[self]) {
            const auto other = static_cast<std::size_t>(o);
            const bool is_known = !std::isnan(a[other]) && !std::isnan(a[self]);
            answers.push_back(std::min(compared(a[other] <= a[self], is_known),
                                       compared(b[other] > 1, !std::isnan(b[other]))));
          }
          const int answer = expected(c, answers);
          const std::array names = {"door", "-", "window"};
          const std::string name = names[static_cast<std::size_t>(answer)];
          RC_ASSERT(found[self] == name);
          stopped += std::ranges::count(answers, 2) > 3 ? 1U : 0U;
          unknown += answer == 1 ? 1U : 0U;
        }
      }
    }));
    // It was about something.
    CHECK(stopped > 1000);
    CHECK(unknown > 1000);
  }

  TEST_CASE(
      "a relation of classes means what its pairs mean, parted or not, values missing or not") {
    const std::vector<std::string> relations = {
        "storey = other.storey", "host is wall and other.host is wall and storey = other.storey",
        "storey = other.storey and abs(a) = abs(other.a)",
        "host is wall and storey = other.storey",  // pairs: self alone must be on a wall
        "host is wall and other.host is wall and a >= other.a"};
    std::vector<RuleBase> packs;
    for (const std::string& where : relations)
      packs.push_back(load(pack_with(
          "relations:\n  near: {within: same facade, where: '" + where +
          "'}\n  nearer: {within: near, where: 'b = other.b'}\nrules:\n"
          "  - {id: w, label: window, require: 'count(near where b > 0.2 m) >= 1'}\n"
          "  - {id: d, label: door, require: 'exists(nearer where a < self.a)'}\n"
          "groups:\n  rows: {of: window, by: near}\n  more: {of: window, by: nearer}\n")));
    std::size_t grouped = 0, labelled = 0;
    CHECK(rc::check("classes and pairs", [&] {
      const int count = *rc::gen::inRange(30, 60);
      const bool has_gaps = *rc::gen::inRange(0, 2) == 1;
      Scene scene;
      std::vector<int> facades;
      for (int i = 0; i < count; ++i) {
        Values values;
        for (const char* name : {"storey", "a", "b"})
          if (const int n = *rc::gen::inRange(0, 4); n > 0 || !has_gaps) values[name] = n * 0.5;
        if (const int n = *rc::gen::inRange(0, 8); n < 7 || !has_gaps)
          values["host_inclination"] = n < 6 ? 90.0 : 30.0;
        scene.add(values);
        facades.push_back(*rc::gen::inRange(-1, 2));
        for (int j = 0; j < i; ++j)
          if (facades.back() >= 0 && facades[static_cast<std::size_t>(j)] == facades.back())
            scene.relate_both("same_facade", FeatureId{i}, FeatureId{j});
      }
      const FeatureGraph by_pairs = scene.graph();
      FeatureGraph by_classes;
      by_classes.set_classes("same_facade", facades);
      RC_ASSERT(by_classes.pairs("same_facade") == by_pairs.pairs("same_facade"));
      for (const RuleBase& pack : packs) {
        const auto p = interpret(pack, scene.table(), by_pairs);
        const auto q = interpret(pack, scene.table(), by_classes);
        const auto groups = groups_by_feature(p);
        RC_ASSERT(groups == groups_by_feature(q));
        for (std::size_t i = 0; i < p.verdicts.size(); ++i) {
          RC_ASSERT(p.verdicts[i].label == q.verdicts[i].label);
          grouped += groups[i].size();
          labelled += p.verdicts[i].label.empty() ? 0U : 1U;
        }
        RC_ASSERT(group_ids(p) == group_ids(q));
      }
    }));
    // It was about something.
    CHECK(grouped > 1000);
    CHECK(labelled > 1000);
  }
}
