#include "tests/studio/session/studio_bench.h"

#include <set>

#include <doctest/doctest.h>

namespace oriel::test {

TEST_SUITE("studio/session") {
  TEST_CASE("the state lists buildings and the pack") {
    StudioBench bench;
    const json state = bench.ask("state", json::object());
    CHECK(state["pack"]["name"] == "residential");
    CHECK(state["pack"]["path"].is_null());
    CHECK(state["has_truth"] == true);
    CHECK(state["lods"].size() >= 4);
    CHECK(state["scales"][0] == 1);
    REQUIRE(state["buildings"].size() == 2);
    for (const json& building : state["buildings"]) {
      CHECK(building["is_loaded"] == true);
      CHECK(building["features"].get<int>() > 0);
      for (const json& size : building["size_m"]) CHECK(size.get<double>() > 0);
    }
  }

  TEST_CASE("geometry refers to vertices and features that are there") {
    StudioBench bench;
    const json answer = bench.ask("geometry", {{"buildings", {0, 1}}});
    REQUIRE(answer["buildings"].size() == 2);
    for (const json& building : answer["buildings"]) {
      const std::size_t vertices = building["vertices_mm"].size() / 3;
      const std::size_t features = building["features"].size();
      std::set<std::string> names;
      for (const json& polygon : building["polygons"]) {
        for (const json& ring : polygon["rings"])
          for (const json& v : ring) CHECK(v.get<std::size_t>() < vertices);
        for (const json& owner : polygon["owners"]) CHECK(owner.get<std::size_t>() < features);
      }
      for (const json& feature : building["features"]) {
        names.insert(feature["name"]);
        CHECK(feature["box_mm"].size() == 6);
        for (int axis = 0; axis < 3; ++axis)
          CHECK(feature["box_mm"][axis] <= feature["box_mm"][axis + 3]);
      }
      CHECK(names.size() == features);
      CHECK(std::is_sorted(building["storeys_mm"].begin(), building["storeys_mm"].end()));
      CHECK_FALSE(building["storeys_mm"].empty());
    }
  }

  TEST_CASE("surfaces have a type and a reason for every polygon") {
    StudioBench bench;
    const json geometry = bench.ask("geometry", {{"buildings", {0}}});
    const json surfaces = bench.ask("surfaces", {{"building", 0}});
    CHECK(surfaces["types"].size() == geometry["buildings"][0]["polygons"].size());
    CHECK(surfaces["why"].size() == surfaces["types"].size());
    for (const json& type : surfaces["types"]) CHECK_FALSE(type.get<std::string>().empty());
  }

  TEST_CASE("an explanation begins with a plain sentence") {
    StudioBench bench;
    const json pack = bench.pack(bench.pack_text());
    bool has_row = false;
    for (std::size_t f = 0; f < pack["labels"]["0"].size(); ++f) {
      const json answer = bench.ask("explain", {{"building", 0}, {"feature", f}});
      const std::string sentence = answer["sentence"];
      const std::string label = answer["label"].is_null() ? "unknown" : answer["label"];
      CHECK(sentence.starts_with(label + ": a"));
      for (const char* raw : {"sense", "=", "_", "nan"})
        CHECK_MESSAGE(sentence.find(raw) == std::string::npos, sentence);
      has_row = has_row || sentence.find("one of a row of") != std::string::npos;
      CHECK_FALSE(answer["attributes"].empty());
      if (!answer["rule"].is_null()) {
        CHECK(answer["why"][0]["rule"] == answer["rule"]);
        CHECK(answer["why"][0]["holds"] == true);
        CHECK(answer["rule_line"] == answer["why"][0]["line"]);
      }
      for (const json& near : answer["why_not"])
        CHECK_FALSE(near["sentence"].get<std::string>().empty());
    }
    CHECK(has_row);
  }

  TEST_CASE("requests that make no sense are refused with a sentence") {
    StudioBench bench;
    for (const auto& [verb, body, status] : std::vector<std::tuple<const char*, std::string, int>>{
             {"nothing", "{}", 404},
             {"state", "[]", 400},
             {"state", "{", 400},
             {"state", "\"__proto__\"", 400},
             {"geometry", "{}", 400},
             {"geometry", R"({"buildings": 3})", 400},
             {"geometry", R"({"buildings": [99]})", 400},
             {"geometry", R"({"buildings": [-1]})", 400},
             {"geometry", R"({"buildings": [0.5]})", 400},
             {"geometry", R"({"buildings": ["__proto__"]})", 400},
             {"geometry", R"({"buildings": [1e300]})", 400},
             {"explain", R"({"building": 0})", 400},
             {"explain", R"({"building": 0, "feature": 100000})", 400},
             {"explain", R"({"building": null, "feature": 0})", 400},
             {"surfaces", R"({"building": "<img onerror=x>"})", 400},
             {"pack", R"({"text": 3, "version": 1})", 400},
             {"pack", R"({"text": ""})", 400},
             {"pack", R"({"text": "", "version": 1, "params": {"a": 1}})", 400},
             {"pack", R"({"text": "", "version": 1, "since": "yes"})", 400},
             {"search", R"({"text": ["x"]})", 400},
             {"truth", R"({"buildings": {}})", 400},
             {"correct", R"({"building": 0, "feature": 0})", 400},
             {"correct", R"({"building": 0, "feature": 0, "class": 5})", 400},
             {"correct", R"({"building": 0, "feature": 0, "class": ""})", 400},
             {"save", R"({"text": "x"})", 400}}) {
      CAPTURE(verb);
      CAPTURE(body);
      const auto [found, sentence] = bench.refusal(verb, body);
      CHECK(found == status);
      CHECK(sentence.size() > 10);
    }
  }

  TEST_CASE("files that cannot be read are named and the others open") {
    studio::SessionOptions options = sample_options();
    options.files.insert(options.files.begin(), "/nowhere/x.city.json");
    options.truth.emplace_back("/nowhere/x.truth.json");
    StudioBench bench(options);
    const json state = bench.ask("state", json::object());
    CHECK(state["buildings"].size() == 2);
    CHECK(state["issues"].size() == 2);
  }
}

}  // namespace oriel::test
