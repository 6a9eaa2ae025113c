#include "interpret/compile/strata.h"

#include "tests/interpret/support.h"

#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

const std::string kHeader =
    "schema: oriel/1\n"
    "pack: {name: t, version: 1.0.0}\n";

/// True for every pair of nodes with a path from the first to the second.
std::vector<std::vector<bool>> reach(int nodes, const std::vector<std::pair<int, int>>& edges) {
  const auto count = static_cast<std::size_t>(nodes);
  std::vector<std::vector<bool>> reaches(count, std::vector<bool>(count, false));
  for (std::size_t i = 0; i < count; ++i) reaches[i][i] = true;
  for (const auto& [from, to] : edges)
    reaches[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)] = true;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j)
        if (reaches[i][k] && reaches[k][j]) reaches[i][j] = true;
  return reaches;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("labels that wait for each other are refused with the whole circle") {
    CHECK(findings(kHeader +
                   "classes: {opening: {abstract: true}, window: {is: opening}, dormer: {}}\n"
                   "rules:\n"
                   "  - {id: o, label: opening, require: sense = hole}\n"
                   "  - {id: d, label: dormer, require: exists(contains where is window)}\n"
                   "  - {id: w, label: window, require: self is opening and host is dormer}\n") ==
          "t.yaml:6:59: R243 these rules depend on each other: 'dormer' asks for 'window' "
          "(t.yaml:6:59), 'window' asks for 'dormer' (t.yaml:7:57); a label is decided before it "
          "is asked for; to break the cycle ask for 'opening' in place of 'window'\n  - {id: d, "
          "label: dormer, require: exists(contains where is window)}\n                             "
          "                             ^~~~~~~~~\n");
  }

  TEST_CASE("predicates that wait for each other through a negation are refused") {
    const std::string found = findings(kHeader +
                                       "classes: {p: {abstract: true}, q: {abstract: true}}\n"
                                       "rules:\n"
                                       "  - {id: p, label: p, require: self is q}\n"
                                       "  - {id: q, label: q, require: not self is p}\n");
    CHECK(
        found.starts_with("t.yaml:6:36: R243 these rules depend on each other: 'q' asks for 'p' "
                          "(t.yaml:6:36), 'p' asks for 'q' (t.yaml:5:32); not, none, count, unless "
                          "and scores ask for what is known already"));
  }

  TEST_CASE("none count unless and scores are strict as well") {
    const auto is_refused = [](const std::string& rest) {
      return findings(kHeader +
                      "classes: {p: {abstract: true}, w: {}}\nrules:\n  - {id: p, label: p, " +
                      rest + "}\n")
                 .find("R243") != std::string::npos;
    };
    CHECK(is_refused("require: none(beside where is p)"));
    CHECK(is_refused("require: count(beside where is p) > 1"));
    CHECK(is_refused("require: natural, unless: exists(beside where is p)"));
    CHECK_FALSE(is_refused("require: exists(beside where is p)"));
    CHECK_FALSE(is_refused("require: all(beside where is p)"));
    CHECK_FALSE(is_refused("require: natural or host is p"));
  }

  TEST_CASE("a label that asks for itself is refused") {
    CHECK(findings(kHeader +
                   "classes: {w: {}}\n"
                   "rules: [{id: w, label: w, require: natural, score: [{count(beside where is w): "
                   "{rise: 0 .. 3}}]}]\n")
              .starts_with("t.yaml:4:73: R243 these rules depend on each other: 'w' asks for 'w' "
                           "(t.yaml:4:73); a label is decided before it is asked for"));
  }

  TEST_CASE("a rule for a subclass must ask for the predicate above it") {
    CHECK(findings(kHeader + "classes: {opening: {abstract: true}, window: {is: opening}}\n"
                             "rules:\n"
                             "  - {id: o, label: opening, require: sense = hole}\n"
                             "  - {id: w, label: window, require: depth > 1 m}\n") ==
          "t.yaml:6:5: R245 'window' is a kind of 'opening', which has rules of its own: require "
          "'self is opening'\n"
          "  - {id: w, label: window, require: depth > 1 m}\n"
          "    ^\n");
    CHECK(findings(kHeader + "classes: {opening: {abstract: true}, window: {is: opening}}\n"
                             "macros: {cut: self is opening and natural}\n"
                             "rules:\n"
                             "  - {id: o, label: opening, require: sense = hole}\n"
                             "  - {id: w, label: window, require: cut and depth > 1 m}\n")
              .empty());
  }

  TEST_CASE("rules may stand in any order") {
    const std::string header =
        kHeader +
        "classes: {opening: {abstract: true}, window: {is: opening}, dormer: {}}\nrules:\n";
    const std::string opening = "  - {id: o, label: opening, require: sense = hole}\n";
    const std::string window = "  - {id: w, label: window, require: self is opening}\n";
    const std::string dormer =
        "  - {id: d, label: dormer, require: exists(contains where is window)}\n";
    Scene scene;
    const FeatureId host = scene.add({{"sense", "protrusion"}});
    scene.put_on(host, scene.add({{"sense", "hole"}}));
    const Labels expected = {"dormer", "window"};
    CHECK(labels(load(header + opening + window + dormer), scene) == expected);
    CHECK(labels(load(header + dormer + window + opening), scene) == expected);
    CHECK(labels(load(header + window + dormer + opening), scene) == expected);
  }

  TEST_CASE("predicates that need each other run to their least fixpoint") {
    const RuleBase base = load(kHeader +
                               "classes: {row: {abstract: true}, start: {abstract: true}, w: {}}\n"
                               "rules:\n"
                               "  - {id: r1, label: row, require: natural}\n"
                               "  - {id: r2, label: row, require: exists(beside where is row)}\n"
                               "  - {id: w, label: w, require: self is row}\n"
                               "  - {id: s, label: start, require: natural}\n");
    Scene scene;
    std::vector<FeatureId> chain;
    for (int i = 0; i < 6; ++i) chain.push_back(scene.add({{"natural", i == 0 ? 1.0 : 0.0}}));
    // 0 - 1 - 2 - 3 hang together, 4 and 5 only with each other: nothing makes them a row.
    for (int i = 0; i < 3; ++i)
      scene.relate_both("beside", chain[static_cast<std::size_t>(i)],
                        chain[static_cast<std::size_t>(i) + 1]);
    scene.relate_both("beside", chain[4], chain[5]);
    CHECK(labels(base, scene) == Labels{"w", "w", "w", "w", "-", "-"});
  }

  TEST_CASE("an abstract class without rules is the union of its subclasses") {
    const RuleBase base = load(kHeader +
                               "classes: {roof_part: {abstract: true}, chimney: {is: roof_part}, "
                               "vent: {is: roof_part}, house: {}}\n"
                               "rules:\n"
                               "  - {id: h, label: house, require: count(contains where is "
                               "roof_part) = 2}\n"
                               "  - {id: c, label: chimney, require: a > 2 m}\n"
                               "  - {id: v, label: vent, require: a < 1 m}\n");
    Scene scene;
    const FeatureId house = scene.add({{"a", 1.5}});
    scene.put_on(house, scene.add({{"a", 3.0}}));
    scene.put_on(house, scene.add({{"a", 0.5}}));
    scene.put_on(house, scene.add({{"a", 1.5}}));
    CHECK(labels(base, scene) == Labels{"house", "chimney", "vent", "-"});
  }

  TEST_CASE("a later stratum refines a label to a subclass and to nothing else") {
    const RuleBase base =
        load(kHeader +
             "classes: {window: {}, roof_window: {is: window}, hatch: {}}\n"
             "rules:\n"
             "  - {id: w, label: window, require: sense = hole}\n"
             "  - {id: r, label: roof_window, require: self is window and a > 1 m}\n"
             "  - {id: h, label: hatch, require: a > 0 m and none(beside where is "
             "window)}\n");
    Scene scene;
    scene.add({{"sense", "hole"}, {"a", 0.5}});
    scene.add({{"sense", "hole"}, {"a", 1.5}});
    scene.add({{"sense", "cavity"}, {"a", 1.5}});
    CHECK(labels(base, scene) == Labels{"window", "roof_window", "hatch"});
  }

  TEST_CASE("components are what reaches each other and edges lead to lower numbers") {
    rc::check("against reachability", [] {
      const int nodes = *rc::gen::inRange(1, 12);
      std::vector<std::pair<int, int>> edges;
      const int count = *rc::gen::inRange(0, 25);
      for (int i = 0; i < count; ++i)
        edges.emplace_back(*rc::gen::inRange(0, nodes), *rc::gen::inRange(0, nodes));
      const rules::Components found = rules::find_components(nodes, edges);
      const auto reaches = reach(nodes, edges);
      for (std::size_t i = 0; i < reaches.size(); ++i)
        for (std::size_t j = 0; j < reaches.size(); ++j) {
          const bool is_together = reaches[i][j] && reaches[j][i];
          RC_ASSERT((found.of_node[i] == found.of_node[j]) == is_together);
          if (reaches[i][j]) RC_ASSERT(found.of_node[i] >= found.of_node[j]);
        }
    });
  }
}
