#include "examples/generator/generate.h"
#include "examples/generator/output/cityjson.h"
#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/cli/json_lines.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <doctest/doctest.h>

using namespace oriel::test;
using nlohmann::json;

namespace {

/// A sample with all that a file may have beside what is labelled: attributes, an extension,
/// appearance, another lod, another object.
json furnished(const std::string& name) {
  json city = json::parse(bytes_of(sample(name)));
  city["extensions"] = {{"Noise", {{"url", "https://example.org/noise.json"}, {"version", "1.0"}}}};
  city["+noise"] = {{"day", 55.5}};
  city["appearance"] = {{"materials", {{{"name", "brick"}}}}};
  json& building = city["CityObjects"][name];
  building["attributes"] = {{"roofType", "gable"}, {"nested", {{"a", {1, 2.50, nullptr}}}}};
  building["+energy"] = {{"class", "A"}};
  json footprint = {{"type", "MultiSurface"}, {"lod", "0"}};
  footprint["boundaries"] = json::array({building["geometry"][0]["boundaries"][0][0]});
  building["geometry"].push_back(footprint);
  json& geometry = building["geometry"][0];
  json values = json::array();
  for (std::size_t i = 0; i < geometry["boundaries"][0].size(); ++i) values.push_back(0);
  geometry["material"]["day"]["values"] = json::array({values});
  city["CityObjects"]["tree"] = {{"type", "SolitaryVegetationObject"},
                                 {"attributes", {{"species", "Acer"}}}};
  return city;
}

json labelled(const json& city) {
  const Outcome outcome = run({"label", "-", "--from", "cityjson", "-o", "-"}, {.in = city.dump()});
  CHECK(outcome.exit == 0);
  return json::parse(outcome.out);
}

/// Takes away all that labelling may add.
void strip(json& city) {
  json& objects = city["CityObjects"];
  for (auto it = objects.begin(); it != objects.end();) {
    json& object = it.value();
    if (object["type"] == "BuildingInstallation") {
      it = objects.erase(it);
      continue;
    }
    object.erase("children");
    if (object.contains("attributes"))
      for (auto a = object["attributes"].begin(); a != object["attributes"].end();)
        a = a.key().starts_with("oriel_") ? object["attributes"].erase(a) : std::next(a);
    if (object.contains("geometry"))
      for (json& geometry : object["geometry"]) geometry.erase("semantics");
    ++it;
  }
}

/// The records of the features, without the numbers that a label does not need.
std::string verdicts_of(const json& city) {
  const Folder folder;
  const std::string parts = folder / "parts.jsonl";
  CHECK(run({"label", "-", "--from", "cityjson", "--features", parts}, {.in = city.dump()}).exit ==
        0);
  return bytes_of(parts);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("labelling keeps everything else in the file") {
    const json before = furnished("house");
    json after = labelled(before);
    CHECK(after != before);
    strip(after);
    CHECK(after == before);
  }

  TEST_CASE("labelling twice gives the same bytes") {
    const std::string text = furnished("house").dump();
    const std::vector<std::string> arguments{"label", "-", "--from", "cityjson", "-o", "-"};
    const Outcome once = run(arguments, {.in = text});
    const Outcome twice = run(arguments, {.in = once.out});
    CHECK(twice.exit == 0);
    CHECK(twice.out == once.out);
    CHECK(twice.err == once.err);
  }

  TEST_CASE("the labels of a labelled file are those of the file without") {
    const json before = furnished("house");
    CHECK(verdicts_of(labelled(before)) == verdicts_of(before));
  }

  TEST_CASE("openings have a wall and installations a building") {
    const json city = labelled(furnished("house"));
    const json& surfaces = city["CityObjects"]["house"]["geometry"][0]["semantics"]["surfaces"];
    int openings = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const json& surface = surfaces[i];
      if (surface["type"] != "Window" && surface["type"] != "Door") continue;
      ++openings;
      REQUIRE(surface.contains("parent"));
      const json& children = surfaces[surface["parent"].get<std::size_t>()]["children"];
      CHECK(std::ranges::find(children, json(i)) != children.end());
      CHECK(surface["oriel_score"].get<double>() > 0);
    }
    CHECK(openings == 18);
    const json& children = city["CityObjects"]["house"]["children"];
    CHECK(children.size() == 6);
    for (const json& id : children) {
      const json& part = city["CityObjects"][id.get<std::string>()];
      CHECK(part["type"] == "BuildingInstallation");
      CHECK(part["parents"] == json::array({"house"}));
    }
  }

  TEST_CASE("generalising takes openings and small installations out of the file") {
    const Outcome outcome =
        run({"generalise", "-", "--from", "cityjson", "--scale", "1:20000", "-o", "-"},
            {.in = furnished("house").dump()});
    CHECK(outcome.exit == 0);
    CHECK(!outcome.says("warning"));
    const json city = json::parse(outcome.out);
    for (const auto& [id, object] : city["CityObjects"].items())
      CHECK(object["type"] != "BuildingInstallation");
    const json& house = city["CityObjects"]["house"];
    CHECK(!house.contains("children"));
    CHECK(house["attributes"]["oriel_removed_window"] == 16);
    CHECK(house["attributes"]["oriel_removed_chimney"] == 1);
    CHECK(house["attributes"]["roofType"] == "gable");
    CHECK(house["geometry"].size() == 2);
    for (const json& surface : house["geometry"][0]["semantics"]["surfaces"]) {
      CHECK(surface["type"] != "Window");
      CHECK(surface["type"] != "Door");
    }
    CHECK(house["geometry"][0]["boundaries"][0].size() < 40);
  }

  TEST_CASE("a noisy building is cut within its noise, and -v says so") {
    const Folder folder;
    oriel::generator::Options options;
    options.seed = 2722;
    options.flush = 0.5;
    options.noise = 5000;  // micrometres
    std::vector<std::string> houses;
    double expected = 0;
    for (int i = 0; i < 4; ++i) {
      const std::string id = "noisy" + std::to_string(i);
      const oriel::generator::Building house{id, oriel::generator::generate(options, i), {}};
      houses.push_back(
          folder.write(id + ".city.json",
                       oriel::generator::cityjson(house, oriel::generator::Content::stripped)));
      for (const auto& object : house.body.objects)
        expected += object.kind == oriel::generator::Class::window ? 1 : 0;
    }
    const auto windows = [&](const std::vector<std::string>& more) {
      std::vector<std::string> arguments{"label", "-v", "--features", folder / "noisy.jsonl"};
      arguments.insert(arguments.end(), houses.begin(), houses.end());
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = run(arguments);
      CHECK(outcome.exit == 0);
      const bool is_told = outcome.err.find("note: noisy0: E126") != std::string::npos;
      CHECK(is_told == more.empty());
      int count = 0;
      for (const json& feature : json_lines(bytes_of(folder / "noisy.jsonl")))
        count += feature.value("label", "") == "window" ? 1 : 0;
      return count;
    };
    CHECK(expected > 40);
    CHECK(std::abs(windows({}) - expected) < 0.03 * expected);
    CHECK(std::abs(windows({"--plane-offset", "0.008"}) - expected) < 0.03 * expected);
    CHECK(std::abs(windows({"--plane-offset", "0.002"}) - expected) > 0.1 * expected);
  }

  TEST_CASE("provenance has no clock and no path") {
    const Folder folder;
    const std::string twin = folder.write("twin.city.json", bytes_of(sample("hip")));
    CHECK(run({"label", sample("hip"), "-o", "-"}).out == run({"label", twin, "-o", "-"}).out);
  }
}
