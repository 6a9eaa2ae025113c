#include "tests/interpret/support.h"

#include <random>
#include <stdexcept>

#include <fmt/ranges.h>

using namespace oriel;
using namespace oriel::test;

namespace {

constexpr const char* kBatchPack =
    "relations:\n"
    "  same_row: {within: same facade, where: host is wall and other.host is wall and storey = "
    "other.storey}\n"
    "  near: {within: beside, where: abs(base_height - other.base_height) <= 1 m}\n"
    "rules:\n"
    "  - {id: opening, label: opening, require: 'sense in [hole, imprint] and a > 0.3 m'}\n"
    "  - id: window\n"
    "    label: window\n"
    "    require: self is opening\n"
    "    unless: base_height < 0.5 m\n"
    "    score:\n"
    "      - count(same_facade where is opening and abs(a - self.a) <= 0.5 m): {rise: 0 .. 3}\n"
    "      - mean(base_height of beside): {rise: 0 m .. 2 m}\n"
    "  - id: door\n"
    "    label: door\n"
    "    require: [self is opening, exists(near where base_height > self.base_height) or "
    "base_height < 1 m]\n"
    "    score: [a: {rise: 0 m .. 2 m}]\n"
    "decide: {min_score: 0.1, ambiguous_below: 0.2}\n"
    "groups:\n"
    "  row: {of: window, by: same_row, at_least: 2}\n"
    "  heap: {of: opening, by: near, at_least: 2}\n";

struct MadeBuilding {
  FeatureTable table;
  FeatureGraph graph;
};

MadeBuilding random_building(std::mt19937& random, int features) {
  const auto below = [&](int bound) {
    return static_cast<int>(random() % static_cast<unsigned>(bound));
  };
  Scene scene;
  std::vector<int> facades;
  for (int i = 0; i < features; ++i) {
    Values values;
    for (const char* name : {"base_height", "a", "storey"})
      if (below(8) > 0) values[name] = below(6) * 0.5;
    if (below(8) > 0) values["host_inclination"] = below(4) > 0 ? 90.0 : 30.0;
    static constexpr const char* kSenses[] = {"hole", "imprint", "protrusion", "cavity"};
    if (below(8) > 0) values["sense"] = kSenses[below(4)];
    scene.add(values);
    facades.push_back(below(4) - 1);
    for (int j = std::max(0, i - 4); j < i; ++j)
      if (below(3) == 0) scene.relate_both("beside", FeatureId{i}, FeatureId{j});
  }
  MadeBuilding building{scene.table(), scene.graph()};
  if (below(4) > 0) building.graph.set_classes("same_facade", facades);
  return building;
}

/// All that was said of a building.
std::string all_said_in(const Interpretation& said) {
  std::string text;
  for (const Verdict& v : said.verdicts)
    text += fmt::format("{} {} {} {} {} {}\n", v.feature.value, v.label, v.score, v.margin, v.rule,
                        v.runner_up);
  for (const Group& group : said.groups) {
    text += fmt::format("{} {}:", group.id, group.kind);
    for (const FeatureId member : group.members) text += fmt::format(" {}", member.value);
    text += "\n";
  }
  for (const Issue& issue : said.issues) text += to_string(issue) + "\n";
  return text;
}

std::vector<FeaturesOfBuilding> views_of(const std::vector<MadeBuilding>& buildings) {
  std::vector<FeaturesOfBuilding> views;
  for (const MadeBuilding& building : buildings)
    views.push_back({&building.table, &building.graph});
  return views;
}

/// Of how many buildings something of that kind was said.
struct Said {
  std::size_t groups = 0, issues = 0, labels = 0;
};

Said check_alike(const RuleBase& base, const std::vector<MadeBuilding>& buildings) {
  Said said;
  const auto together = interpret(base, views_of(buildings));
  REQUIRE(together.size() == buildings.size());
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    const Interpretation alone = interpret(base, buildings[i].table, buildings[i].graph);
    CHECK(all_said_in(together[i]) == all_said_in(alone));
    said.groups += alone.groups.empty() ? 0 : 1;
    said.issues += alone.issues.empty() ? 0 : 1;
    for (const Verdict& verdict : alone.verdicts) said.labels += verdict.label.empty() ? 0 : 1;
  }
  return said;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("buildings that are interpreted together get what each gets alone") {
    std::mt19937 random(3);
    const RuleBase base = load(pack_with(kBatchPack));
    Said said;
    for (int run = 0; run < 40; ++run) {
      std::vector<MadeBuilding> buildings;
      const int count = 1 + static_cast<int>(random() % 60);
      for (int i = 0; i < count; ++i)
        buildings.push_back(random_building(random, static_cast<int>(random() % 30)));
      if (run % 8 == 0) buildings.push_back(random_building(random, 700));
      const Said now = check_alike(base, buildings);
      said.groups += now.groups;
      said.issues += now.issues;
      said.labels += now.labels;
    }
    CHECK(said.groups > 100);
    CHECK(said.issues > 100);
    CHECK(said.labels > 1000);
  }

  TEST_CASE("buildings that are interpreted together take as many rounds as each alone") {
    std::mt19937 random(4);
    const RuleBase base =
        load(pack_with("rules:\n"
                       "  - id: w\n"
                       "    label: window\n"
                       "    require: a > 0 m\n"
                       "    score: [a: {fall: 0 m .. 2 m}, count(beside where is window): {rise: 0 "
                       ".. 1, weight: 2}]\n"
                       "  - id: d\n"
                       "    label: door\n"
                       "    require: a > 0 m\n"
                       "    score: [a: {rise: 0 m .. 2 m}, count(beside where is door): {rise: 0 "
                       ".. 1, weight: 2}]\n"
                       "iterate: {rounds: 3}\n"));
    std::vector<MadeBuilding> buildings;
    for (int i = 0; i < 50; ++i) buildings.push_back(random_building(random, i % 12));
    CHECK(check_alike(base, buildings).issues > 0);
  }

  TEST_CASE("no building is interpreted as nothing") {
    CHECK(interpret(load(pack_with(kBatchPack)), std::vector<FeaturesOfBuilding>()).empty());
  }

  TEST_CASE("a graph of other features than its table is refused among other buildings too") {
    std::mt19937 random(5);
    std::vector<MadeBuilding> buildings;
    for (int i = 0; i < 3; ++i) buildings.push_back(random_building(random, 5));
    buildings[1].graph.set("beside", {{FeatureId{0}, FeatureId{7}}});
    CHECK_THROWS_AS(interpret(load(pack_with(kBatchPack)), views_of(buildings)),
                    std::invalid_argument);
  }
}
