#include "io/records/feature_records.h"

#include "tests/io/files.h"
#include "tests/io/segmentations.h"

#include <algorithm>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel {
namespace {

using test::codes_of;

std::vector<FeatureRecord> sample(bool with_verdicts) {
  const test::SmallSegmentation small;
  Interpretation interpretation;
  interpretation.verdicts = {{FeatureId{0}, "bay, \"big\"", 0.9, 0.3, "bay-rule", "balcony"},
                             {FeatureId{1}, "", 0, 0, "", ""}};
  interpretation.groups = {{"row.b1", "row", {FeatureId{0}}}, {"pair.b1", "pair", {FeatureId{0}}}};
  return feature_records(small.building, small.segmentation, small.table, small.graph,
                         with_verdicts ? &interpretation : nullptr);
}

std::string written(const std::vector<FeatureRecord>& records, const std::string& name) {
  const test::TemporaryFolder folder;
  FeatureRecordWriter writer(folder.file(name));
  for (const FeatureRecord& record : records) writer.append({record});
  writer.commit();
  return test::text_of(folder.file(name));
}

Checked<std::vector<FeatureRecord>> read_back(const std::string& text, const std::string& name) {
  const test::TemporaryFolder folder;
  return read_feature_records(folder.write(name, text));
}

std::size_t field_index(const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(record_fields(), name) -
                                  record_fields().begin());
}

TEST_SUITE("io") {
  TEST_CASE("a record says where a feature is and what it is related to") {
    const auto records = sample(false);
    REQUIRE(records.size() == 2);
    CHECK(records[0].host.empty());
    CHECK(records[1].host == "b1");
    CHECK(records[1].parent == "b1");
    CHECK(records[1].aabb_m ==
          std::array{678114.25, 5403766.5, 415.0, 678114.75, 5403766.625, 416.0});
    CHECK_FALSE(records[1].score);
    CHECK(records[0].attributes.size() == feature_schema().size());
    CHECK(records[0].relations.size() == relation_schema().size() - 1);
    CHECK(records[0].relations[0] == std::vector<std::string>{"w1"});
    CHECK(records[1].part_of.empty());
  }

  TEST_CASE("what has no label is a part of the labelled feature that it stands on") {
    const auto records = sample(true);
    CHECK(records[0].part_of.empty());
    CHECK(records[1].part_of == "b1");
    for (const char* name : {"r.csv", "r.json", "r.jsonl"}) {
      const auto back = read_back(written(records, name), name);
      REQUIRE(back.value);
      CHECK(back.value->at(1).part_of == "b1");
    }
  }

  TEST_CASE("fields are those of the schema in its order") {
    const auto& fields = record_fields();
    CHECK(fields[0] == "building");
    CHECK(fields[11] == "source_polygons");
    CHECK(fields[12] == record_name(feature_schema()[0]));
    CHECK(field_index("volume_m3") < fields.size());
    CHECK(field_index("rel_contains") == 12 + feature_schema().size());
    CHECK(field_index("rel_host") == fields.size());
  }

  TEST_CASE("CSV is quoted and lists are joined") {
    const std::string text = written(sample(true), "f.csv");
    std::istringstream lines(text);
    std::string header, first;
    std::getline(lines, header);
    std::getline(lines, first);
    CHECK(header.starts_with(
        "building,id,name,label,score,margin,rule,runner_up,parent,host,aabb_m,"));
    CHECK(first.starts_with(
        R"(house,b1,"bay, ""big"" 1 of the inside","bay, ""big""",0.9,0.3,bay-rule,balcony,,,)"
        "678114;5403766;414;678115;5403768;417,1;2;5,"));
    CHECK(std::ranges::count(header, ',') + 1 == std::ssize(record_fields()));
  }

  TEST_CASE("records come back from every format as they were") {
    for (const bool with_verdicts : {false, true})
      for (const char* name : {"f.csv", "f.json", "f.jsonl"}) {
        const auto records = sample(with_verdicts);
        const auto again = read_back(written(records, name), name);
        CAPTURE(name);
        CHECK(again.issues.empty());
        REQUIRE(again.value);
        REQUIRE(again.value->size() == records.size());
        for (std::size_t i = 0; i < records.size(); ++i) {
          const FeatureRecord& a = records[i];
          const FeatureRecord& b = (*again.value)[i];
          CHECK(std::tie(a.building, a.id, a.name, a.label, a.score, a.margin, a.rule, a.runner_up,
                         a.parent, a.host, a.aabb_m, a.source_polygons) ==
                std::tie(b.building, b.id, b.name, b.label, b.score, b.margin, b.rule, b.runner_up,
                         b.parent, b.host, b.aabb_m, b.source_polygons));
          CHECK(a.attributes == b.attributes);
          CHECK(a.relations == b.relations);
          CHECK(a.groups == b.groups);
          CHECK(a.groups.size() == (with_verdicts && i == 0 ? 2 : 0));
        }
      }
  }

  TEST_CASE("JSON says null for what is missing") {
    const auto root = nlohmann::json::parse(written(sample(false), "f.json"));
    REQUIRE(root.size() == 2);
    CHECK(root[0].size() == record_fields().size());
    CHECK(root[0]["score"].is_null());
    CHECK(root[0]["sense"].is_null());
    CHECK(root[0]["volume_m3"] == 1.0 / 3);
    CHECK(root[1]["natural"] == 1);
    CHECK(root[1]["rel_alike"] == nlohmann::json::parse(R"(["#1/2"])"));
    CHECK(nlohmann::json::parse(written({}, "f.json")).empty());
  }

  TEST_CASE("a table has the columns that are asked for in the order of the fields") {
    const RecordColumns columns = columns_named({"rel_alike", "label", "volume_m3", "no such"});
    CHECK(names_of_columns(columns) ==
          std::vector<std::string>{"building", "id", "label", "volume_m3", "rel_alike"});
    CHECK(names_of_columns({}) == record_fields());
    CHECK_FALSE(has_columns_of_names(columns));
    CHECK(has_columns_of_names({}));
    for (const char* name : {"f.csv", "f.json", "f.jsonl"}) {
      CAPTURE(name);
      const test::TemporaryFolder folder;
      FeatureRecordWriter writer(folder.file(name), columns);
      writer.append(sample(true));
      writer.commit();
      RecordColumns found;
      const auto back = read_feature_records(folder.file(name), &found);
      CHECK(back.issues.empty());
      CHECK(found == columns);
      REQUIRE(back.value->size() == 2);
      CHECK(back.value->at(1).relations == sample(true)[1].relations);
      CHECK(back.value->at(0).rule.empty());
    }
  }

  TEST_CASE("features that are all related share a class and others have lists") {
    const test::SmallSegmentation small;
    FeatureGraph graph;
    const std::vector<int> classes = {4, 4};
    graph.set_classes("same_storey", classes);
    graph.set("alike", {{FeatureId{0}, FeatureId{1}}, {FeatureId{1}, FeatureId{0}}});
    graph.set("beside", {{FeatureId{0}, FeatureId{1}}, {FeatureId{1}, FeatureId{0}}});
    const auto records =
        feature_records(small.building, small.segmentation, small.table, graph, nullptr);
    const auto related = [&](const std::string& name, std::size_t row) {
      const std::size_t first = field_index("rel_contains");
      return records[row].relations[field_index(name) - first];
    };
    for (const std::size_t row : {0U, 1U}) {
      CHECK(related("rel_same_storey", row) == std::vector<std::string>{"#1/2"});
      CHECK(related("rel_alike", row) == std::vector<std::string>{"#1/2"});
      CHECK(related("rel_same_facade", row).empty());
    }
    CHECK(related("rel_beside", 0) == std::vector<std::string>{"w1"});
  }

  TEST_CASE("columns of JSON are those that every record has") {
    const test::TemporaryFolder folder;
    const std::string file =
        folder.write("f.jsonl",
                     "{\"id\":\"a\",\"building\":\"h\",\"label\":\"x\",\"rule\":null}\n"
                     "{\"id\":\"b\",\"building\":\"h\",\"rule\":\"r\"}\n");
    RecordColumns found;
    CHECK(read_feature_records(file, &found).issues.empty());
    CHECK(names_of_columns(found) == std::vector<std::string>{"building", "id", "rule"});
  }

  TEST_CASE("fields may come in any order and be few") {
    const auto csv = read_back("id,x,building,host\r\nw1,?,house,\"b\n1\"\r\n", "f.csv");
    CHECK(csv.issues.empty());
    REQUIRE(csv.value->size() == 1);
    CHECK((*csv.value)[0].host == "b\n1");
    const auto open = read_back("id,building,host\nw1,house,\"b,1\"", "f.csv");
    REQUIRE(open.value);
    CHECK(open.value->at(0).host == "b,1");
    const auto json = read_back(R"({"id":"w1","building":"h","new":{"a":1}})", "f.jsonl");
    CHECK(json.issues.empty());
    CHECK(json.value->size() == 1);
  }

  TEST_CASE("a record that cannot be read is left out and named") {
    const auto csv = read_back(
        "building,id,score,aabb_m\nh,a,1,0;0;0;1;1;1\nh,b,one,\nh,c,1\n,d,1,\nh,e,1,1;2\nh,f,,\n",
        "f.csv");
    CHECK(codes_of(csv.issues) == "E111 E111 E111 E111");
    CHECK(csv.issues[0].place.line == 3);
    CHECK(csv.issues[3].place.line == 6);
    CHECK(csv.value->size() == 2);
    const auto lines = read_back(
        "{\"id\":\"a\",\"building\":\"h\"}\n{]\n3\n{\"id\":\"a\"}\n"
        "{\"id\":\"a\",\"building\":\"h\",\"source_polygons\":[0.5]}\n",
        "f.jsonl");
    CHECK(codes_of(lines.issues) == "E104 E111 E111 E111");
    CHECK(lines.issues[0].place.line == 2);
    CHECK(lines.value->size() == 1);
    const auto array =
        read_back(R"([{"id":"a","building":"h"},{"id":"a","building":"h","host":{}}])", "f.json");
    CHECK(codes_of(array.issues) == "E111");
    CHECK(array.value->size() == 1);
  }

  TEST_CASE("a file of records that is none is refused") {
    CHECK(codes_of(read_back("", "f.csv").issues) == "E102");
    CHECK(codes_of(read_back("", "f.json").issues) == "E102");
    CHECK(codes_of(read_back("a,b\n", "f.csv").issues) == "E111");
    CHECK(codes_of(read_back("building,id\nh,\"a\n", "f.csv").issues) == "E111");
    CHECK(codes_of(read_back("{}", "f.json").issues) == "E111");
    CHECK(codes_of(read_back("[{", "f.json").issues) == "E105");
    CHECK(codes_of(read_back(std::string(100000, '['), "f.json").issues) == "E503");
    CHECK_THROWS_AS(read_feature_records("f.txt"), InputError);
    CHECK_THROWS_AS(read_feature_records("/nowhere/f.csv"), InputError);
  }
}

}  // namespace
}  // namespace oriel
