#include "tests/studio/session/building_of_bytes.h"
#include "tests/studio/session/studio_bench.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <fstream>
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

  TEST_CASE("files on one spot stand side by side in state and geometry") {
    StudioBench bench;
    const json buildings = bench.ask("state", json::object())["buildings"];
    for (const json& building : buildings) CHECK(building["is_moved"] == true);
    const double end =
        buildings[0]["at_m"][0].get<double>() + buildings[0]["size_m"][0].get<double>();
    CHECK(buildings[1]["at_m"][0].get<double>() > end);
  }

  TEST_CASE("files of different reference systems stand side by side however a system is written") {
    const StudioFolder folder("systems");
    std::ifstream in(sample_file("house.stripped.city.json"));
    json model = json::parse(in);
    studio::SessionOptions options;
    options.corrections.clear();
    const std::string systems[] = {"https://www.opengis.net/def/crs/EPSG/0/25832",
                                   "urn:ogc:def:crs:EPSG::25832",
                                   "https://www.opengis.net/def/crs/EPSG/0/25833"};
    for (const std::string& system : systems) {
      model["metadata"]["referenceSystem"] = system;
      const json& x = model["transform"]["translate"][0];
      model["transform"]["translate"][0] = x.get<double>() + 40;
      options.files.push_back(folder.file(std::to_string(options.files.size()) + ".city.json"));
      std::ofstream(options.files.back()) << model;
    }
    StudioBench bench(options);
    const json buildings = bench.ask("state", json::object())["buildings"];
    REQUIRE(buildings.size() == 3);
    CHECK_FALSE(buildings[0].contains("is_moved"));
    CHECK_FALSE(buildings[1].contains("is_moved"));
    CHECK(buildings[2]["is_moved"] == true);
  }

  TEST_CASE("what is more than a studio keeps is passed over and said") {
    studio::SessionOptions options = sample_options();
    options.most_corners = 1;
    StudioBench bench(std::move(options));
    const json state = bench.ask("state", json::object());
    REQUIRE(state["buildings"].size() == 1);
    CHECK(state["buildings"][0]["features"] > 0);
    REQUIRE(state["issues"].size() == 1);
    CHECK(state["issues"][0]["code"] == "E123");
    CHECK(state["issues"][0]["file"] == sample_file("l-house.stripped.city.json"));
  }

  TEST_CASE("a studio without files writes and opens its samples when it is asked") {
    const StudioFolder folder("samples");
    std::ifstream in(sample_file("house.stripped.city.json"));
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    studio::SessionOptions options;
    options.corrections.clear();
    options.samples = {{"house.city.json", text}, {"experiment.yaml", "x"}};
    options.samples_folder = folder.file("new");
    {
      StudioBench bench(options);
      CHECK(bench.ask("state", json::object())["offers_samples"] == true);
      CHECK(bench.ask("samples", json::object())["folder"] == folder.file("new"));
      CHECK(bench.refusal("samples", "{}").first == 409);
    }
    StudioBench again(options);
    const json state = again.ask("state", json::object());
    CHECK(state["offers_samples"] == false);
    CHECK(state["buildings"].size() == 1);
  }

  TEST_CASE("geometry refers to vertices and features that are there") {
    StudioBench bench;
    const auto buildings = read_bytes(bench.bytes("geometry", {{"buildings", {0, 1}}}));
    const json named = bench.ask("features", {{"buildings", {0, 1}}})["buildings"];
    REQUIRE(buildings.size() == 2);
    for (std::size_t i = 0; i < buildings.size(); ++i) {
      const BuildingOfBytes& building = buildings[i];
      CHECK(building.head["number"] == i);
      CHECK(named[i]["number"] == i);
      for (const auto v : building.corners) CHECK(3 * v < building.vertices.size());
      const json& features = named[i]["features"];
      for (const auto owner : building.owners) CHECK(owner < features.size());
      CHECK(building.ring_ends.back() == building.corner_ends.size());
      CHECK(building.corner_ends.back() == building.corners.size());
      CHECK(building.owner_ends.back() == building.owners.size());
      for (const auto* ends : {&building.ring_ends, &building.corner_ends, &building.owner_ends})
        CHECK(std::is_sorted(ends->begin(), ends->end()));
      std::set<std::string> names;
      for (const json& feature : features) names.insert(feature["name"]);
      CHECK(names.size() == features.size());
      const json& storeys = building.head["storeys_mm"];
      CHECK(std::is_sorted(storeys.begin(), storeys.end()));
      CHECK_FALSE(storeys.empty());
    }
  }

  TEST_CASE("geometry has the vertices of the file to the millimetre") {
    StudioBench bench;
    const json state = bench.ask("state", json::object());
    for (const BuildingOfBytes& building :
         read_bytes(bench.bytes("geometry", {{"buildings", {1, 0}}}))) {
      const json& entry = state["buildings"][building.head["number"].get<std::size_t>()];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::uint32_t least = UINT32_MAX, most = 0;
        for (std::size_t i = axis; i < building.vertices.size(); i += 3) {
          least = std::min(least, building.vertices[i]);
          most = std::max(most, building.vertices[i]);
        }
        CHECK(least == 0);
        CHECK(building.head["base_mm"][axis].get<double>() / 1000 ==
              doctest::Approx(entry["at_m"][axis].get<double>()).epsilon(1e-9));
        CHECK(most / 1000.0 == doctest::Approx(entry["size_m"][axis].get<double>()).epsilon(1e-9));
      }
    }
  }

  TEST_CASE("a building longer than two bytes of millimetres has four bytes a number") {
    const StudioFolder folder("long");
    std::ifstream in(sample_file("house.stripped.city.json"));
    json model = json::parse(in);
    for (json& vertex : model["vertices"]) vertex[0] = 20 * vertex[0].get<int>();
    folder.write("long.city.json", model.dump());
    studio::SessionOptions options = sample_options();
    options.files = {folder.file("long.city.json"), options.files[0]};
    options.truth.clear();
    StudioBench bench(options);
    const auto buildings = read_bytes(bench.bytes("geometry", {{"buildings", {0, 1}}}));
    CHECK(buildings[0].head["is_short"] == false);
    CHECK(buildings[1].head["is_short"] == true);
    CHECK(buildings[0].corners.size() == buildings[1].corners.size());
    CHECK(*std::ranges::max_element(buildings[0].vertices) > UINT16_MAX);
  }

  TEST_CASE("surfaces have a type and a reason for every polygon") {
    StudioBench bench;
    const auto geometry = read_bytes(bench.bytes("geometry", {{"buildings", {0}}}));
    const json surfaces = bench.ask("surfaces", {{"building", 0}});
    CHECK(surfaces["types"].size() == geometry[0].ring_ends.size());
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

  TEST_CASE("relations of the pack are among those of a part") {
    StudioBench bench;
    const json pack = bench.pack(
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}}\n"
        "relations:\n  level: {within: same facade, where: top ~ other.top by 1 %}\n"
        "rules:\n  - {id: w, label: window, require: sense = hole}\n");
    REQUIRE(pack["is_good"] == true);
    std::size_t found = 0;
    for (std::size_t f = 0; f < pack["labels"]["0"].size(); ++f) {
      const json answer = bench.ask("explain", {{"building", 0}, {"feature", f}, {"quick", true}});
      for (const json& relation : answer["relations"]) {
        if (relation["name"] != "level") continue;
        ++found;
        CHECK(relation["line"] == 5);
        CHECK(relation["meaning"] == "same facade where top ~ other.top by 1 %");
        CHECK_FALSE(relation["features"].empty());
      }
    }
    CHECK(found > 2);
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
             {"features", "{}", 400},
             {"features", R"({"buildings": [99]})", 400},
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

  TEST_CASE("an explanation that something newer overtakes ends") {
    StudioBench bench;
    const std::string text = bench.pack_text();
    bench.pack(text);
    std::atomic<bool> is_over = false;
    std::atomic<int> answered = 0, overtaken = 0;
    const auto ask = [&](int first) {
      for (int f = first; !is_over; f = (f + 1) % 20) {
        const auto reply = bench.reply("explain", json{{"building", 1}, {"feature", f}}.dump());
        if (reply.status == 200) ++answered;
        if (reply.status != 409) continue;
        CHECK(json::parse(reply.json)["superseded"] == true);
        ++overtaken;
      }
    };
    std::thread one(ask, 0), other(ask, 7);
    while (overtaken < 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    is_over = true;
    one.join();
    other.join();
    const json last = bench.ask("explain", {{"building", 1}, {"feature", 0}});
    CHECK(last.contains("flip"));
    // A quick one ends none.
    CHECK(bench.ask("explain", {{"building", 1}, {"feature", 0}, {"quick", true}})["flip"] ==
          nullptr);
  }
}

}  // namespace oriel::test
