#include "tests/studio/session/studio_bench.h"

#include <doctest/doctest.h>

namespace oriel::test {

TEST_SUITE("studio/session") {
  TEST_CASE("a search finds labels and rules and ids and names") {
    StudioBench bench;
    const json pack = bench.pack(bench.pack_text());
    std::size_t windows = 0;
    for (const json& row : pack["counts"])
      if (row["class"] == "window") windows = row["count"];
    const json by_label = bench.ask("search", {{"text", " window "}});
    CHECK(by_label["parts"].size() == windows);
    const json by_class_above = bench.ask("search", {{"text", "opening"}});
    CHECK(by_class_above["parts"].size() >= windows);
    CHECK(bench.ask("search", {{"text", "unknown"}})["parts"].size() == pack["unknown"]);
    const json part = by_label["parts"][0];
    const json explained = bench.ask("explain", {{"building", part[0]}, {"feature", part[1]}});
    const json by_rule = bench.ask("search", {{"text", explained["rule"]}});
    CHECK(std::find(by_rule["parts"].begin(), by_rule["parts"].end(), part) !=
          by_rule["parts"].end());
    const json by_name = bench.ask("search", {{"text", explained["name"]}});
    CHECK(std::find(by_name["parts"].begin(), by_name["parts"].end(), part) !=
          by_name["parts"].end());
    const json named = bench.ask("features", {{"buildings", {0}}})["buildings"][0];
    const json by_id = bench.ask("search", {{"text", named["features"][1]["id"]}});
    CHECK(by_id["parts"] == json::array({json::array({0, 1})}));
    const json state = bench.ask("state", json::object());
    CHECK(bench.ask("search", {{"text", state["buildings"][0]["id"]}})["buildings"][0] == 0);
  }

  TEST_CASE("a search by a condition finds the features of which it holds") {
    StudioBench bench;
    bench.pack(bench.pack_text());
    const json wide = bench.ask("search", {{"text", "width > 1 m and self is window"}});
    CHECK(wide["findings"].empty());
    REQUIRE_FALSE(wide["parts"].empty());
    for (const json& part : wide["parts"]) {
      const json answer = bench.ask("explain", {{"building", part[0]}, {"feature", part[1]}});
      CHECK(answer["label"] == "window");
      for (const json& attribute : answer["attributes"])
        if (attribute["name"] == "width")
          CHECK(std::stod(attribute["value"].get<std::string>()) >= 1);
    }
    const json none = bench.ask("search", {{"text", "width > 1 km2"}});
    CHECK(none["parts"].empty());
    CHECK_FALSE(none["findings"].empty());
    const json unknown = bench.ask("search", {{"text", "width > 1 m and heigth < 2 m"}});
    REQUIRE(unknown["findings"].size() == 1);
    CHECK(unknown["findings"][0]["code"] == "R204");
    CHECK(unknown["findings"][0]["column"] == 17);
    for (const char* text :
         {"", "__proto__", "<img onerror=x>", "a' b", "}", "]}", "a: b", "# x", "\\"})
      CHECK(bench.ask("search", {{"text", text}})["parts"].empty());
  }
}

}  // namespace oriel::test
