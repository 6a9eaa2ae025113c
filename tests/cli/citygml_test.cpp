#include "examples/generator/output/citygml.h"

#include "examples/generator/generate.h"
#include "io/reader.h"
#include "tests/cli/command.h"
#include "tests/support/citygml_samples.h"
#include "tests/support/shared.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;
namespace gen = oriel::generator;

namespace {

gen::Building house(int number) {
  gen::Options options;
  options.seed = 11;
  return {fmt::format("house_{}", number), gen::generate(options, number), {}};
}

/// Two houses in one CityGML file.
std::string two_houses() {
  return gen::citygml_head(gen::CityGml::v2) +
         gen::citygml_member(house(0), gen::Content::stripped, gen::CityGml::v2) +
         gen::citygml_member(house(1), gen::Content::stripped, gen::CityGml::v2) +
         gen::citygml_foot();
}

/// The building of a CityJSON file as the kernel reads it.
std::vector<oriel::Building> buildings_of(const std::string& path) {
  oriel::Reader reader(path);
  auto record = reader.next();
  REQUIRE(record);
  REQUIRE(record->value);
  return std::move(record->value->buildings);
}

TEST_SUITE("cli") {
  TEST_CASE("labels from CityGML are those from CityJSON of the same house") {
    const Folder folder;
    for (int i = 0; i < 4; ++i)
      for (const auto content : {gen::Content::labelled, gen::Content::stripped}) {
        CAPTURE(i);
        const auto label = [&](const std::string& name, const std::string& text) {
          CHECK(run({"label", folder.write(name, text), "--features", folder / "f.jsonl"}).exit ==
                0);
          return bytes_of(folder / "f.jsonl");
        };
        const gen::Building one = house(i);
        const std::string expected = label("a.city.json", gen::cityjson(one, content));
        CHECK(expected.find("\"window\"") != std::string::npos);
        CHECK(label("a.gml", gen::citygml(one, content, gen::CityGml::v2)) == expected);
        CHECK(label("a.xml", gen::citygml(one, content, gen::CityGml::v3)) == expected);
      }
  }

  TEST_CASE("labels of the shared data stay when they are turned into CityGML") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    std::vector<std::string> files;
    for (const std::string set : {"ingolstadt", "ogc-simple-house"})
      for (const auto& entry : std::filesystem::directory_iterator(shared / "data" / set))
        if (entry.path().string().ends_with(".stripped.city.json"))
          files.push_back(entry.path().string());
    std::ranges::sort(files);
    CHECK(files.size() == 20);
    std::vector<std::string> json_files{"label"}, gml_files{"label"};
    for (const std::string& file : files) {
      const std::string name = fmt::format("{}.gml", json_files.size());
      json_files.push_back(file);
      gml_files.push_back(folder.write(name, citygml_of(buildings_of(file), "3.0", '3')));
    }
    const auto features = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.end(), {"--features", folder / "f.jsonl"});
      run(arguments);
      return bytes_of(folder / "f.jsonl");
    };
    const std::string expected = features(json_files);
    CHECK_FALSE(expected.empty());
    CHECK(features(gml_files) == expected);
  }

  TEST_CASE("CityGML is written as CityJSON or as CityJSONSeq") {
    const Folder folder;
    const std::string gml = folder.write("two.gml", two_houses());
    CHECK(run({"label", gml, "-o", folder / "two.city.json"}).exit == 0);
    const json whole = json::parse(bytes_of(folder / "two.city.json"));
    CHECK(whole["type"] == "CityJSON");
    CHECK(whole["CityObjects"].contains("house_0"));
    CHECK(whole["CityObjects"].contains("house_1"));
    CHECK(whole["transform"]["scale"][0] == 0.001);

    CHECK(run({"label", gml, "-o", folder / "two.city.jsonl"}).exit == 0);
    const std::string lines = bytes_of(folder / "two.city.jsonl");
    CHECK(std::ranges::count(lines, '\n') == 3);

    CHECK(run({"label", gml, "-o", folder / "out/"}).exit == 0);
    CHECK(bytes_of(folder / "out/two.city.json") == bytes_of(folder / "two.city.json"));
    const Outcome piped = run({"label", "-", "--from", "citygml", "-o", "-"}, {.in = two_houses()});
    CHECK(piped.exit == 0);
    CHECK(piped.out == bytes_of(folder / "two.city.json"));

    // What was written has the same labels when it is read again.
    CHECK(run({"label", folder / "two.city.json", "-o", folder / "again.city.json"}).exit == 0);
    CHECK(bytes_of(folder / "again.city.json") == bytes_of(folder / "two.city.json"));
  }

  TEST_CASE("CityGML that was labelled is the same file once more") {
    const Folder folder;
    const std::string gml = folder.write("two.gml", two_houses());
    for (const std::string version : {"citygml2", "citygml3"}) {
      CHECK(run({"label", gml, "--to", version, "-o", folder / "a.gml"}).exit == 0);
      CHECK(run({"label", folder / "a.gml", "--to", version, "-o", folder / "b.gml"}).exit == 0);
      CHECK(bytes_of(folder / "a.gml") == bytes_of(folder / "b.gml"));
    }
  }

  TEST_CASE("of a CityGML file the good buildings are written and the bad ones told") {
    const Folder folder;
    const std::string text = replaced(two_houses(), "<gml:posList srsDimension=\"3\">",
                                      "<gml:posList srsDimension=\"3\">1 ");
    for (const std::string name : {"out.city.json", "out.city.jsonl"}) {
      const Outcome outcome = run({"label", folder.write("a.gml", text), "-o", folder / name});
      CHECK(outcome.exit == 3);
      CHECK(outcome.says("house_0: E210"));
      CHECK(outcome.says("1 of 2 buildings labelled"));
      const std::string out = bytes_of(folder / name);
      CHECK(out.find("\"house_1\"") != std::string::npos);
      CHECK(out.find("\"house_0\"") == std::string::npos);
    }
  }

  TEST_CASE("a CityGML file that breaks off leaves no output") {
    const Folder folder;
    const std::string text = two_houses();
    const Outcome outcome = run({"label", folder.write("a.gml", text.substr(0, text.size() - 50)),
                                 "-o", folder / "out.city.json"});
    CHECK(outcome.exit == 5);
    CHECK(outcome.says("E105"));
    CHECK(folder.names() == std::vector<std::string>{"a.gml"});
  }
}

}  // namespace
