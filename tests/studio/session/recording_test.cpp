#include "studio/session/recording.h"

#include "tests/studio/session/recorded_page.h"
#include "tests/studio/session/studio_bench.h"

#include <regex>

using namespace oriel;
using namespace oriel::test;

TEST_SUITE("studio") {
  TEST_CASE("a recording has the replies of a session") {
    studio::SessionOptions options;
    options.corrections.clear();
    options.files = {sample_file("house.stripped.city.json")};
    const RuleBase rules = *load_pack_file("residential").value;
    studio::Recording recording(rules);
    Reader reader(options.files[0], {});
    const auto record = reader.next();
    LabelOptions all;
    all.measures_surfaces = true;
    const Building& house = record->value->buildings.at(0);
    recording.add(house, label(house, rules, all));
    const json data = replies_of(recording.json());
    StudioBench bench(options);
    const json& building = data["buildings"][0];
    const json surfaces = bench.ask("surfaces", {{"building", 0}});
    CHECK(surfaces["types"] == building["surfaces"]["types"]);
    const std::string first = building["surfaces"]["why"].at(0);
    // The pack that the studio edits has no file.
    CHECK(surfaces["why"].at(0) ==
          std::regex_replace(first, std::regex("residential.yaml"), "residential"));
    CHECK(bench.ask("features", {{"buildings", {0}}})["buildings"][0]["features"] ==
          building["features"]);
    CHECK(shape_of(building["geometry"]).polygons.size() ==
          read_bytes(bench.bytes("geometry", {{"buildings", {0}}}))[0].ring_ends.size());
    const json labelled = bench.pack(bench.pack_text());
    for (const char* key : {"labels", "counts", "unknown"})
      CHECK(labelled[key] == data["pack"][key]);
    json state = bench.ask("state", json::object())["buildings"];
    state[0]["file"] = "";
    CHECK(state == data["state"]["buildings"]);
    REQUIRE(building["explain"].size() == building["features"].size());
    for (std::size_t feature = 0; feature < building["features"].size(); ++feature) {
      const json reply =
          bench.ask("explain", {{"building", 0}, {"feature", feature}, {"quick", true}});
      const json& recorded = building["explain"][feature];
      for (const char* key :
           {"sentence", "name", "label", "rule", "score", "head", "attributes", "correction"})
        CHECK(reply[key] == recorded[key]);
      CHECK(reply["why"].size() == recorded["why"].size());
    }
  }
}
