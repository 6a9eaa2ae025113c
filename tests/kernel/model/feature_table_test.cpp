#include "kernel/model/feature_table.h"

#include "kernel/model/feature_graph.h"

#include <set>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("kernel/model") {
  TEST_CASE("attribute names stand once in the schema") {
    std::set<std::string> names;
    for (const Attribute& attribute : feature_schema()) CHECK(names.insert(attribute.name).second);
    for (const RelationKind& relation : relation_schema())
      if (relation.name != "host") CHECK(names.insert(relation.name).second);
  }

  TEST_CASE("a value that was never set is missing and not zero") {
    FeatureTable table("house", 2);
    CHECK_FALSE(table.number(FeatureId{0}, "height"));
    table.set(FeatureId{0}, "height", 0.0);
    CHECK(table.number(FeatureId{0}, "height") == 0.0);
    CHECK_FALSE(table.number(FeatureId{1}, "height"));
    CHECK(table.text(FeatureId{1}, "sense").empty());
  }

  TEST_CASE("setting an attribute that the schema does not have is refused") {
    FeatureTable table("house", 1);
    CHECK_THROWS_AS(table.set(FeatureId{0}, "heigth", 1.0), std::logic_error);
    CHECK_THROWS_AS(table.set(FeatureId{0}, "sense", 1.0), std::logic_error);
  }

  TEST_CASE("features of a class are each other's others, and none is its own") {
    FeatureGraph graph;
    graph.set_classes("same_facade", std::vector<int>{1, -1, 0, 1, 0, 1});
    const std::vector<FeatureId> others{FeatureId{3}, FeatureId{5}};
    CHECK(graph.others("same_facade", FeatureId{0}) == others);
    CHECK(graph.others("same_facade", FeatureId{1}).empty());
    CHECK(graph.others("same_facade", FeatureId{9}).empty());
    CHECK(graph.pairs("same_facade").size() == 8);
    graph.set("beside", graph.pairs("same_facade"));
    CHECK(graph.pairs("beside") == graph.pairs("same_facade"));
    CHECK(graph.pairs("above").empty());
  }

  TEST_CASE(
      "a relation drops pairs that stand twice or lead to themselves and refuses no feature") {
    FeatureGraph graph;
    const FeatureId p{0}, q{1};
    graph.set("beside", {{q, p}, {p, p}, {p, q}, {q, p}});
    CHECK(graph.pairs("beside") == std::vector<FeatureGraph::Pair>{{p, q}, {q, p}});
    CHECK_THROWS_AS(graph.set("beside", {{p, FeatureId{}}}), std::invalid_argument);
  }

  TEST_CASE("records carry the unit in the name") {
    CHECK(record_name(feature_schema()[*column_of("height")]) == "height_m");
    CHECK(record_name(feature_schema()[*column_of("inclination")]) == "inclination_deg");
    CHECK(record_name(feature_schema()[*column_of("quality")]) == "quality");
  }
}

}  // namespace
}  // namespace oriel
