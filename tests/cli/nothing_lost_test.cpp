#include "examples/generator/generate.h"
#include "examples/generator/output/citygml.h"
#include "io/cityjson/cityjson_collector.h"
#include "io/reader.h"
#include "io/writer.h"
#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace fs = std::filesystem;
namespace gen = oriel::generator;

namespace {

/// A list of nothing but null is null, as CityJSON has it.
void collapse(json& values) {
  if (!values.is_array()) return;
  for (json& value : values) collapse(value);
  if (std::ranges::all_of(values, [](const json& v) { return v.is_null(); })) values = nullptr;
}

void take_numbers_from(json& values, std::size_t first) {
  if (values.is_array())
    for (json& value : values) take_numbers_from(value, first);
  else if (values.is_number() && values.get<std::size_t>() >= first)
    values = nullptr;
}

/// Takes from `list` what `is_ours` says; a list that gets empty and was not there goes.
template <class IsOurs>
void take_from(json& owner, const json& before, const char* key, IsOurs is_ours) {
  if (!owner.contains(key)) return;
  json left = json::array();
  for (const json& element : owner[key])
    if (!is_ours(element)) left.push_back(element);
  if (left.empty() && !before.contains(key))
    owner.erase(key);
  else
    owner[key] = left;
}

void strip_semantics(json& geometry, json& before) {
  if (!geometry.contains("semantics")) return;
  if (!before.contains("semantics")) {
    geometry.erase("semantics");
    return;
  }
  json& semantics = geometry["semantics"];
  const json& surfaces = before["semantics"]["surfaces"];
  const std::size_t count = surfaces.size();
  json left = json::array();
  for (std::size_t i = 0; i < count; ++i) {
    json surface = semantics["surfaces"].at(i);
    take_from(surface, surfaces[i], "children",
              [&](const json& child) { return child.get<std::size_t>() >= count; });
    left.push_back(surface);
  }
  semantics["surfaces"] = left;
  take_numbers_from(semantics["values"], count);
  collapse(semantics["values"]);
  collapse(before["semantics"]["values"]);
}

void strip_object(json& object, json& before, const std::set<std::string>& added) {
  take_from(object, before, "children",
            [&](const json& id) { return added.contains(id.get<std::string>()); });
  if (object.contains("attributes")) {
    json& attributes = object["attributes"];
    const json had = before.value("attributes", json::object());
    json left = json::object();
    for (const auto& [name, value] : attributes.items())
      if (!name.starts_with("oriel_") || had.contains(name)) left[name] = value;
    attributes = left;
    if (left.empty() && !before.contains("attributes")) object.erase("attributes");
  }
  if (!object.contains("geometry")) return;
  for (std::size_t g = 0; g < object["geometry"].size(); ++g)
    strip_semantics(object["geometry"][g], before["geometry"].at(g));
}

/// `after` without what label adds; `before` with lists of null as null.
void strip(json& after, json& before) {
  std::set<std::string> added;
  for (const auto& [id, object] : after["CityObjects"].items())
    if (!before["CityObjects"].contains(id) && object["type"] == "BuildingInstallation" &&
        object["attributes"]["oriel_geometry"] == "shared")
      added.insert(id);
  for (const std::string& id : added) after["CityObjects"].erase(id);
  for (const auto& [id, object] : after["CityObjects"].items())
    if (before["CityObjects"].contains(id)) strip_object(object, before["CityObjects"][id], added);
}

/// True if labels were added and nothing else was changed.
void check_kept(const std::string& before_text, const std::string& after_text, int& added) {
  json before = json::parse(before_text), after = json::parse(after_text);
  if (before != after) ++added;
  strip(after, before);
  CHECK(json::diff(before, after) == json::array());
}

std::string name_of(const std::string& path) { return fs::path(path).filename().string(); }

/// Labels files into a folder and looks at each.
void check_all_kept(const std::vector<std::string>& files, const std::string& mode) {
  const Folder folder;
  std::vector<std::string> arguments{"label", "--existing", mode, "-o", folder / "out/"};
  arguments.insert(arguments.end(), files.begin(), files.end());
  const Outcome outcome = run(arguments);
  CHECK((outcome.exit == 0 || outcome.exit == 3));
  int added = 0;
  for (const std::string& file : files) {
    CAPTURE(file);
    check_kept(bytes_of(file), bytes_of(folder / ("out/" + name_of(file))), added);
  }
  CHECK(added == static_cast<int>(files.size()));
}

/// A cube among things that are no concern of ours.
json crowded() {
  json city = cubes({"c", "d"});
  city["extensions"] = {{"Noise", {{"url", "https://example.com/noise.json"}, {"version", "1"}}}};
  city["metadata"] = {{"title", "crowded"},
                      {"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/7415"}};
  city["appearance"] = {{"materials", {{{"name", "red"}}}},
                        {"textures", {{{"type", "PNG"}, {"image", "a.png"}}}},
                        {"vertices-texture", {{0.0, 0.5}, {1.0, 1.0}, {1.0, 0.0}}}};
  city["CityObjects"]["tree"] = {{"type", "SolitaryVegetationObject"},
                                 {"attributes", {{"species", "oak"}, {"oriel", 1}}}};
  json& c = city["CityObjects"]["c"];
  c["attributes"] = {{"yearOfConstruction", 1900}, {"+noise", {{"day", 55.5}}}};
  c["address"] = {{{"Country", "DE"}}};
  json& solid = c["geometry"][0];
  solid["material"] = {{"", {{"value", 0}}}};
  solid["texture"] = {
      {"winter", {{"values", {{{{0, 0, 1, 2, 0}}, nullptr, nullptr, nullptr, nullptr, nullptr}}}}}};
  json other = solid;
  other["lod"] = "1";
  other["semantics"] = {{"surfaces", {{{"type", "+RedSurface"}, {"why", {1, 2}}}}},
                        {"values", nullptr}};
  c["geometry"].push_back(other);
  return city;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("label takes nothing away and changes nothing in the samples") {
    std::vector<std::string> files;
    for (const char* name :
         {"block", "hip", "house", "house-flush", "house-noisy", "house-utm", "row"})
      files.push_back(sample(name));
    check_all_kept(files, "fill");
    check_all_kept(files, "keep");
  }

  TEST_CASE("label takes nothing away and changes nothing in shared data") {
    ORIEL_NEEDS_SHARED(shared);
    std::vector<std::string> files = city_files(shared);
    REQUIRE(files.size() > 180);
    check_all_kept(files, "fill");
  }

  TEST_CASE("label takes nothing away and changes nothing in a stream") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    // The tile has names for all its surfaces; here they are taken away.
    std::ifstream tile(shared / "data/3dbag/tile_5910.city.jsonl");
    std::string lines;
    int count = 0;
    for (std::string line; std::getline(tile, line) && count < 60; ++count) {
      json feature = json::parse(line);
      for (auto& [id, object] : feature["CityObjects"].items())
        if (object.contains("geometry") && count % 2 == 1)
          for (json& geometry : object["geometry"]) geometry.erase("semantics");
      lines += feature.dump() + "\n";
    }
    const std::string input = folder.write("in.city.jsonl", lines);
    const std::string output = folder / "out.city.jsonl";
    const Outcome outcome = run({"label", input, "-o", output, "--budget", "2000000"});
    CHECK((outcome.exit == 0 || outcome.exit == 3));
    std::istringstream before(lines), after(bytes_of(output));
    int added = 0;
    for (std::string was, is; std::getline(before, was);) {
      REQUIRE(std::getline(after, is));
      check_kept(was, is, added);
    }
    CHECK(added >= count / 2 - 1);
  }

  TEST_CASE("textures and appearance and extensions and other objects stay beside the labels") {
    const Folder folder;
    check_all_kept({folder.write("in.city.json", crowded().dump())}, "fill");
    check_all_kept({folder.write("in.city.json", crowded().dump())}, "keep");
  }

  TEST_CASE("from CityGML comes what it says and beside it the labels") {
    const Folder folder;
    gen::Options options;
    options.seed = 5;
    for (const auto content : {gen::Content::labelled, gen::Content::stripped}) {
      const gen::Building house{"h", gen::generate(options, 0), {}};
      const std::string input =
          folder.write("in.gml", gen::citygml(house, content, gen::CityGml::v2));
      oriel::Reader reader(input);
      oriel::CityJsonCollector collector;
      while (const auto record = reader.next())
        collector.add(oriel::write_cityjson(record->value.value(), {}));
      const std::string output = folder / "out.city.json";
      CHECK(run({"label", input, "-o", output}).exit == 0);
      int added = 0;
      check_kept(collector.text(), bytes_of(output), added);
      CHECK(added == 1);
    }
  }
}
