#include "examples/generator/generate.h"
#include "examples/generator/output/cityjson.h"
#include "tests/cli/command.h"
#include "tests/cli/json_lines.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

std::vector<std::string> files_of(const std::filesystem::path& folder, const std::string& end) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().string().ends_with(end)) files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

/// Repairs, and judges what was written; returns how many became solids. All of those are valid.
int solids_of(const std::vector<std::string>& inputs, const std::vector<std::string>& options) {
  const Folder folder;
  std::vector<std::string> arguments{"repair", "-o", folder / "out/", "--report", folder / "r"};
  arguments.insert(arguments.end(), inputs.begin(), inputs.end());
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome repaired = run(arguments);
  std::map<std::string, bool> is_solid;
  for (const json& report : json_lines(bytes_of(folder / "r")))
    is_solid[report["id"].get<std::string>()] = report["is_solid"].get<bool>();
  const auto solids = std::ranges::count(is_solid, true, [](const auto& e) { return e.second; });
  if (solids < std::ssize(is_solid)) CHECK(repaired.exit == 3);

  std::vector<std::string> judge{"validate", "--json"};
  for (const std::string& file : files_of(folder / "out", "")) judge.push_back(file);
  if (std::ranges::find(options, "--lod") != options.end())
    judge.insert(judge.end(), std::ranges::find(options, "--lod"), options.end());
  for (const json& line : json_lines(run(judge).out)) {
    const std::string id = line["id"].get<std::string>();
    CAPTURE(id);
    if (is_solid.contains(id) && is_solid[id]) CHECK(line["findings"] == json::array());
  }
  return static_cast<int>(solids);
}

TEST_SUITE("cli") {
  TEST_CASE("what repair says is a solid is valid when it is read again: published buildings") {
    ORIEL_NEEDS_SHARED(shared);
    const std::filesystem::path data = shared / "data";
    const auto ingolstadt = files_of(data / "ingolstadt", ".labelled.city.json");
    CHECK(solids_of(ingolstadt, {"--ignore-semantics"}) >= 17);
    CHECK(solids_of(ingolstadt, {"--ignore-semantics", "--close", "any"}) >= 17);
    const auto houses = files_of(data / "random3dcity", ".labelled.city.json");
    CHECK(solids_of(houses, {"--ignore-semantics"}) == std::ssize(houses));
    const std::string tile = data / "3dbag/tile_5910.city.jsonl";
    for (const char* lod : {"1.2", "1.3", "2.2"}) CHECK(solids_of({tile}, {"--lod", lod}) >= 208);
  }

  TEST_CASE("what repair says is a solid is valid when it is read again: houses of the generator") {
    // With ORIEL_SLOW a thousand; CI takes fewer.
    const int count = std::getenv("ORIEL_SLOW") != nullptr ? 500 : 150;
    for (const double noise_mm : {0.0, 2.0}) {
      const Folder folder;
      oriel::generator::Options options;
      options.seed = 21;
      options.flush = 0.3;
      options.noise = std::lround(1000 * noise_mm);
      std::vector<std::string> houses;
      for (int i = 0; i < count; ++i) {
        const std::string name = fmt::format("h{}", i);
        const oriel::generator::Building house{name, oriel::generator::generate(options, i), {}};
        houses.push_back(
            folder.write(name + ".city.json",
                         oriel::generator::cityjson(house, oriel::generator::Content::stripped)));
      }
      // With noise a facet of one in twenty is folded where it is narrow (E345): no solid then.
      CHECK(solids_of(houses, {}) >= (noise_mm > 0 ? count * 19 / 20 : count));
      CHECK(solids_of({houses.begin(), houses.begin() + 60}, {}) >= 59);
    }
  }

  TEST_CASE("label --repaired writes the solid with the labels of the polygons") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    const auto files = files_of(shared / "data/random3dcity", ".stripped.city.json");
    std::string said;
    const auto label = [&](const std::string& out, std::vector<std::string> arguments) {
      arguments.insert(arguments.begin(), {"label", "-o", folder / out + "/", "--features"});
      arguments.insert(arguments.begin() + 4, folder / out + ".jsonl");
      arguments.insert(arguments.end(), files.begin(), files.end());
      said = run(arguments).err;
      std::map<std::string, int> openings;
      for (const std::string& file : files_of(folder / out, "")) {
        const json city = json::parse(bytes_of(file));
        for (const auto& [id, object] : city["CityObjects"].items())
          for (const json& geometry : object.value("geometry", json::array()))
            for (const json& surface : geometry["semantics"]["surfaces"])
              ++openings[surface["type"].get<std::string>()];
      }
      return openings;
    };
    const auto plain = label("plain", {}), repaired = label("repaired", {"--repaired"});
    CHECK(bytes_of(folder / "plain.jsonl") == bytes_of(folder / "repaired.jsonl"));
    CHECK(repaired.at("Window") == plain.at("Window"));
    CHECK(repaired.at("Door") == plain.at("Door"));
    std::vector<std::string> judge{"validate"};
    for (const std::string& file : files_of(folder / "repaired", "")) judge.push_back(file);
    // Of four the foot of a chimney reaches over a hip.
    CHECK(said.find("72 of 76 buildings labelled") != std::string::npos);
    // Their 66 installations have geometries of their own, which are all valid.
    CHECK(run(judge).says("138 of 142 geometries are valid; 4 E342"));
  }

  TEST_CASE("holes that are closed across other walls make no solid unless what crosses is cut") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    const std::string house = shared / "data/ingolstadt/ingolstadt__4018154.labelled.city.json";
    const std::vector<std::string> repair{"repair",    house, "--ignore-semantics",     "--close",
                                          "any",       "-o",  folder / "out.city.json", "--report",
                                          folder / "r"};
    auto leaving = repair;
    leaving.insert(leaving.end(), {"--crossings", "leave"});
    const Outcome outcome = run(leaving);
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("E318 the repaired solid is not valid: E352 "));
    CHECK(json::parse(bytes_of(folder / "r"))["is_solid"] == false);
    // Its installations have geometries of their own, which stay.
    const Outcome cutting = run(repair);
    CHECK(cutting.exit == 3);
    CHECK(cutting.says("E321 its installation "));
    CHECK_FALSE(cutting.says("E318"));
    CHECK(json::parse(bytes_of(folder / "r"))["is_solid"] == true);
  }
}

}  // namespace
