#include "io/records/feature_tables.h"

#include "io/records/feature_records.h"
#include "tests/io/files.h"
#include "tests/io/segmentations.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::codes_of;

Checked<std::vector<DescribedBuilding>> tables_of(const std::string& text,
                                                  const std::string& name) {
  const test::TemporaryFolder folder;
  return read_feature_tables(folder.write(name, text));
}

TEST_SUITE("io") {
  TEST_CASE("attributes and relations come back from every format as they were") {
    const test::SmallSegmentation small;
    for (const char* name : {"f.csv", "f.json", "f.jsonl"}) {
      CAPTURE(name);
      const test::TemporaryFolder folder;
      FeatureRecordWriter writer(folder.file(name));
      writer.append(
          feature_records(small.building, small.segmentation, small.table, small.graph, nullptr));
      writer.commit();
      std::vector<std::vector<Box>> boxes;
      const auto read = read_feature_tables(folder.file(name), nullptr, &boxes);
      CHECK(read.issues.empty());
      REQUIRE(read.value);
      REQUIRE(read.value->size() == 1);
      REQUIRE(boxes.size() == 1);
      const auto records = read_feature_records(folder.file(name)).value.value();
      REQUIRE(boxes.front().size() == records.size());
      for (std::size_t i = 0; i < records.size(); ++i)
        CHECK(boxes.front()[i].max.z == records[i].aabb_m[5]);
      const auto& [table, graph] = read.value->front();
      CHECK(table.building() == "house");
      REQUIRE(table.rows() == small.table.rows());
      for (int i = 0; i < static_cast<int>(table.rows()); ++i) {
        const FeatureId row{i};
        CHECK(table.id(row) == small.table.id(row));
        for (const Attribute attribute : kAttributes) {
          if (info_of(attribute).unit == Unit::text)
            CHECK(table.text(row, attribute) == small.table.text(row, attribute));
          else
            CHECK(table.number(row, attribute) == small.table.number(row, attribute));
        }
      }
      std::size_t pairs = 0;
      for (const RelationKind& relation : relation_schema()) {
        const auto p = graph.pairs(relation.name), q = small.graph.pairs(relation.name);
        CHECK(std::vector(p.begin(), p.end()) == std::vector(q.begin(), q.end()));
        pairs += p.size();
      }
      CHECK(pairs == 4);
    }
  }

  TEST_CASE("a record whose box is none is left out where boxes are read") {
    const test::TemporaryFolder folder;
    const std::string path =
        folder.write("f.csv", "building,id,aabb_m\nh,a,0;0;0;1;1\nh,b,0;0;0;1;1;2\n");
    std::vector<std::vector<Box>> boxes;
    const auto read = read_feature_tables(path, nullptr, &boxes);
    CHECK(codes_of(read.issues) == "E111");
    REQUIRE(read.value);
    CHECK(read.value->front().table.rows() == 1);
    REQUIRE(boxes.size() == 1);
    REQUIRE(boxes.front().size() == 1);
    CHECK(boxes.front()[0].max.z == 2);
  }

  TEST_CASE("features of a class are related as those of lists are") {
    const std::string head = "building,id,rel_same_storey\n";
    const auto classes =
        tables_of(head + "h,a,#1/3\nh,b,#2/2\nh,c,#1/3\nh,d,\nh,e,#2/2\nh,f,#1/3\n", "f.csv");
    const auto lists = tables_of(head + "h,a,c;f\nh,b,e\nh,c,a;f\nh,d,\nh,e,b\nh,f,a;c\n", "f.csv");
    const auto mixed =
        tables_of(head + "h,a,c;f\nh,b,#2/2\nh,c,a;f\nh,d,\nh,e,#2/2\nh,f,a;c\n", "f.csv");
    REQUIRE((classes.value && lists.value && mixed.value));
    CHECK((classes.issues.empty() && lists.issues.empty() && mixed.issues.empty()));
    const auto pairs = lists.value->front().graph.pairs("same_storey");
    CHECK(pairs.size() == 8);
    CHECK(classes.value->front().graph.pairs("same_storey") == pairs);
    CHECK(mixed.value->front().graph.pairs("same_storey") == pairs);
  }

  TEST_CASE(
      "a class with fewer features than it says is reported and one that is none costs its "
      "record") {
    const auto fewer = tables_of("building,id,rel_same_storey\nh,a,#1/4\nh,b,#1/4\n", "f.csv");
    CHECK(codes_of(fewer.issues) == "E121");
    CHECK(fewer.issues[0].sentence.find("4 relations") != std::string::npos);
    CHECK(fewer.value->front().graph.pairs("same_storey").size() == 2);
    for (const char* text : {"#", "#1", "#x/2", "#0/2", "#1/0", "#1/2;b", "#1/99999999999"}) {
      CAPTURE(text);
      const auto bad =
          tables_of("building,id,rel_same_storey\nh,a,\nh,b," + std::string(text) + "\n", "f.csv");
      CHECK(codes_of(bad.issues) == "E111");
      CHECK(bad.value->front().table.rows() == 1);
    }
  }

  TEST_CASE("each building has a table of its own") {
    const auto read = tables_of("building,id,a_m,rel_beside\nh,f,1,g\nh,g,2,\nk,f,3,\n", "f.csv");
    CHECK(read.issues.empty());
    REQUIRE(read.value->size() == 2);
    CHECK((*read.value)[0].table.rows() == 2);
    CHECK((*read.value)[0].graph.pairs("beside").size() == 1);
    CHECK((*read.value)[1].table.number(FeatureId{0}, Attribute::a) == 3);
    CHECK((*read.value)[1].graph.pairs("beside").empty());
  }

  TEST_CASE("a relation to what is not in the file is reported") {
    const auto read = tables_of("building,id,host,rel_beside\nh,f,x,g;y\nh,g,,f\nk,f,,\n", "f.csv");
    REQUIRE(codes_of(read.issues) == "E121");
    CHECK(read.issues[0].severity == Severity::warning);
    CHECK(read.issues[0].place.building == "h");
    CHECK(read.issues[0].sentence.starts_with("2 relations lead to features"));
    REQUIRE(read.value->size() == 2);
    CHECK((*read.value)[0].graph.pairs("beside").size() == 2);
    CHECK((*read.value)[0].graph.pairs("host").empty());
  }

  TEST_CASE("a host is an id whatever it begins with") {
    const auto read = tables_of("building,id,host\nh,#1,\nh,g,#1\nh,i,#2/3\n", "f.csv");
    CHECK(codes_of(read.issues) == "E121");
    CHECK(read.issues[0].sentence.find("'#2/3'") != std::string::npos);
    const auto pairs = read.value->front().graph.pairs("host");
    REQUIRE(pairs.size() == 1);
    CHECK(pairs[0] == FeatureGraph::Pair(FeatureId{1}, FeatureId{0}));
  }

  TEST_CASE("a second record of a feature is left out and so is one that cannot be read") {
    const auto read = tables_of("building,id,a_m\nh,f,1\nh,f,2\nh,g,wide\nh,i,3\n", "f.csv");
    CHECK(codes_of(read.issues) == "E111 E111");
    CHECK(read.issues[0].place.line == 3);
    CHECK(read.issues[1].place.line == 4);
    REQUIRE(read.value->size() == 1);
    const FeatureTable& table = read.value->front().table;
    REQUIRE(table.rows() == 2);
    CHECK(table.number(FeatureId{0}, Attribute::a) == 1);
    CHECK(table.number(FeatureId{1}, Attribute::a) == 3);
    CHECK(table.id(FeatureId{1}) == "i");
  }

  TEST_CASE("what is no table of records has no tables") {
    CHECK_FALSE(tables_of("a,b\n", "f.csv").value);
    CHECK_FALSE(tables_of("{}", "f.json").value);
    CHECK(tables_of("building,id\n", "f.csv").value->empty());
  }
}

}  // namespace
}  // namespace oriel
