#include "model/description/feature_table.h"

#include "model/description/feature_graph.h"
#include "model/description/surface_table.h"

#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("model") {
  TEST_CASE("attribute names stand once in the schema") {
    std::set<std::string> names;
    for (const AttributeInfo& attribute : feature_schema())
      CHECK(names.insert(attribute.name).second);
    for (const RelationKind& relation : relation_schema())
      if (relation.name != "host") CHECK(names.insert(relation.name).second);
  }

  TEST_CASE("a value that was never set is missing and not zero") {
    FeatureTable table("house", 2);
    CHECK_FALSE(table.number(FeatureId{0}, Attribute::base_height));
    table.set(FeatureId{0}, Attribute::base_height, 0.0);
    CHECK(table.number(FeatureId{0}, Attribute::base_height) == 0.0);
    CHECK_FALSE(table.number(FeatureId{1}, Attribute::base_height));
    CHECK(table.text(FeatureId{1}, Attribute::sense).empty());
  }

  TEST_CASE("a text that stands in many rows is kept once") {
    FeatureTable table("house", 4);
    for (const int row : {0, 1, 3}) table.set(FeatureId{row}, Attribute::sense, "hole");
    table.set(FeatureId{1}, Attribute::sense, "protrusion");
    table.set(FeatureId{3}, Attribute::sense, "");
    const WordColumn& senses = table.texts(Attribute::sense);
    CHECK(senses.words() == std::vector<std::string>{"", "hole", "protrusion"});
    CHECK(senses.numbers() == std::vector<std::uint32_t>{1, 2, 0, 0});
    const FeatureTable copy = table;
    CHECK(copy.text(FeatureId{0}, Attribute::sense) == "hole");
    CHECK(copy.text(FeatureId{1}, Attribute::sense) == "protrusion");
    CHECK(copy.text(FeatureId{3}, Attribute::sense).empty());
  }

  TEST_CASE("columns of numbers stay apart in whatever order they are set") {
    FeatureTable table("house", 2);
    table.set(FeatureId{1}, Attribute::volume, 3.0);
    table.set(FeatureId{0}, Attribute::base_height, 1.0);
    table.set(FeatureId{0}, Attribute::volume, 2.0);
    CHECK(table.number(FeatureId{0}, Attribute::volume) == 2.0);
    CHECK(table.number(FeatureId{1}, Attribute::volume) == 3.0);
    CHECK(table.number(FeatureId{0}, Attribute::base_height) == 1.0);
    CHECK_FALSE(table.number(FeatureId{1}, Attribute::base_height));
    CHECK_FALSE(table.number(FeatureId{0}, Attribute::a));
  }

  TEST_CASE("each attribute is found by its name and stands in its row of the table") {
    CHECK(feature_schema().size() == kAttributes.size());
    for (const Attribute attribute : kAttributes)
      CHECK(find_attribute(info_of(attribute).name) == attribute);
    for (const SurfaceAttribute attribute : kSurfaceAttributes)
      CHECK(find_surface_attribute(info_of(attribute).name) == attribute);
    CHECK(info_of(Attribute::height).name == "height");
    CHECK(info_of(Attribute::sense).words.size() == 4);
    CHECK_FALSE(find_attribute("heigth"));
    CHECK_FALSE(find_surface_attribute("height"));
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
    CHECK(graph.links("beside").are_classes);
    CHECK(graph.pairs("above").empty());
  }

  TEST_CASE("pairs that are not all of some classes stay pairs") {
    using Pairs = std::vector<FeatureGraph::Pair>;
    const FeatureId p{0}, q{1}, r{2};
    FeatureGraph graph;
    for (const Pairs& pairs :
         {Pairs{{p, q}}, Pairs{{q, p}}, Pairs{{p, q}, {q, p}, {q, r}, {r, q}},
          Pairs{{p, q}, {q, r}, {r, p}}, Pairs{{p, q}, {p, r}, {q, p}, {q, r}, {r, p}},
          Pairs{{p, r}, {q, p}, {r, p}}}) {
      graph.set("above", pairs);
      CHECK(graph.pairs("above") == pairs);
      CHECK_FALSE(graph.links("above").are_classes);
    }
  }

  TEST_CASE("pairs that stand twice or lead from a feature to itself are dropped") {
    FeatureGraph graph;
    const FeatureId p{0}, q{1};
    graph.set("beside", {{q, p}, {p, p}, {p, q}, {q, p}});
    CHECK(graph.pairs("beside") == std::vector<FeatureGraph::Pair>{{p, q}, {q, p}});
    CHECK_THROWS_AS(graph.set("beside", {{p, FeatureId{}}}), std::invalid_argument);
  }

  TEST_CASE("records carry the unit in the name") {
    CHECK(record_name(info_of(Attribute::base_height)) == "base_height_m");
    CHECK(record_name(info_of(Attribute::inclination)) == "inclination_deg");
    CHECK(record_name(info_of(Attribute::quality)) == "quality");
  }
}

}  // namespace
}  // namespace oriel
