#include "examples/generator/generate.h"
#include "examples/generator/output/cityjson.h"
#include "tests/cli/command.h"
#include "tests/support/level_faces.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::vector<int> kLevelScales{500, 2500, 10'000, 25'000};
constexpr const char* kLevels = "1:500,1:2500,1:10000,1:25000";

/// A level of a series, of a file or a stream.
LevelFaces level_of(const std::string& stem) {
  LevelFaces level;
  if (fs::exists(stem + ".city.json")) {
    const json city = json::parse(bytes_of(stem + ".city.json"));
    level.add(city, city["transform"]);
    return level;
  }
  const std::vector<std::string> lines = lines_of(bytes_of(stem + ".city.jsonl"));
  const json header = json::parse(lines.at(0));
  for (std::size_t i = 1; i < lines.size(); ++i)
    level.add(json::parse(lines[i]), header["transform"]);
  return level;
}

/// The first face of each that the other does not have, or nothing.
std::string difference(const FaceTexts& drawn, const FaceTexts& written) {
  std::string text;
  for (const auto& [some, others] : {std::pair(&drawn, &written), std::pair(&written, &drawn)}) {
    FaceTexts only;
    std::ranges::set_difference(*some, *others, std::back_inserter(only));
    if (!only.empty()) text += fmt::format("{} of {}: {}\n", only.size(), some->size(), only[0]);
  }
  return text;
}

template <class Visit>
void visit_tiles(const json& tile, const Visit& visit) {
  visit(tile);
  for (const json& child : tile.value("children", json::array())) visit_tiles(child, visit);
}

/// Compares the tiles and the series of some inputs, face by face.
class LevelComparison {
 public:
  explicit LevelComparison(const std::vector<std::string>& inputs,
                           const std::vector<std::string>& more = {}) {
    std::vector<std::string> tiles{"tiles"}, series{"generalise"};
    for (std::vector<std::string>* call : {&tiles, &series}) {
      call->insert(call->end(), inputs.begin(), inputs.end());
      call->insert(call->end(), more.begin(), more.end());
    }
    for (const std::string option : {"--crs", "local", "--most-triangles", "4000", "--scales"})
      tiles.push_back(option);
    tiles.insert(tiles.end(), {kLevels, "-o", folder_ / "tiles"});
    series.insert(series.end(), {"--series", kLevels, "-o", folder_ / "series"});
    for (const auto& call : {tiles, series}) {
      const Outcome made = run(call);
      INFO(made.err);
      REQUIRE((made.exit == 0 || made.exit == 3));
    }
    CHECK(run({"generalise", "--from", folder_ / "series", "--check"}).exit == 0);
  }

  /// How many buildings there are; each is the same at all levels.
  std::size_t check() {
    const json tileset = json::parse(bytes_of(folder_ / "tiles/tileset.json"));
    for (const int scale : kLevelScales)
      levels_[scale] = level_of(fmt::format("{}.1-{}", folder_ / "series", scale));
    visit_tiles(tileset["root"], [&](const json& tile) {
      if (tile.contains("content")) compare(tile, tileset["root"]["transform"]);
    });
    for (const auto& [scale, level] : levels_)
      for (const auto& [id, faces] : level.faces()) {
        INFO(id << " at 1:" << scale);
        CHECK(seen_[scale][id] == 1);
      }
    return levels_.begin()->second.faces().size();
  }

 private:
  void compare(const json& tile, const json& transform) {
    const GlbReader glb(bytes_of(folder_ / ("tiles/" + tile["content"]["uri"].get<std::string>())));
    const std::array<double, 3> shift{transform[12], transform[13], transform[14]};
    const json& known = tile["metadata"]["properties"];
    for (const auto& [scale, level] : levels_) {
      if (scale < known["scale"] || scale > known["coarsest"]) continue;
      const TileFaces drawn(glb, shift, level);
      for (const auto& [building, faces] : drawn.faces()) {
        INFO(building << " at 1:" << scale);
        CHECK(difference(faces, level.faces().at(building)) == "");
        ++seen_[scale][building];
      }
    }
  }

  Folder folder_;
  std::map<int, LevelFaces> levels_;
  std::map<int, std::map<std::string, int>> seen_;
};

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("every sample in a tileset is the solid of the series at each level") {
    std::vector<std::string> inputs;
    for (const char* name : {"block", "hip", "house", "house-noisy", "l-house", "row"})
      inputs.push_back(sample(name));
    CHECK(LevelComparison(inputs).check() == inputs.size());
  }

  TEST_CASE("every generated house in a tileset is the solid of the series at each level") {
    const Folder folder;
    std::vector<std::string> inputs;
    for (int i = 0; i < 3; ++i) {
      const std::string id = fmt::format("house-{}", i);
      inputs.push_back(folder.write(
          id + ".city.json", oriel::generator::cityjson({id, oriel::generator::generate({}, i), {}},
                                                        oriel::generator::Content::stripped)));
    }
    CHECK(LevelComparison(inputs).check() == inputs.size());
  }

  TEST_CASE("buildings of shared data in a tileset are the solids of the series at each level") {
    ORIEL_NEEDS_SHARED(shared);
    std::vector<std::string> inputs;
    std::size_t number = 0;
    for (const std::string& file : city_files(shared))
      if (file.find("random3dcity") != std::string::npos && file.ends_with(".stripped.city.json") &&
          number++ % 19 == 0)
        inputs.push_back(file);
    CHECK(LevelComparison(inputs).check() == inputs.size());
    CHECK(
        LevelComparison({shared / "data/3dbag/tile_5910.city.jsonl"}, {"--random", "8"}).check() >=
        6);
  }
}
