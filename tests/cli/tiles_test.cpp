#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/glb_reader.h"
#include "tests/support/gunzip.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::vector<int> kScales{500, 2000, 20'000};

json tileset_of(const std::string& folder) {
  return json::parse(bytes_of(fs::path(folder) / "tileset.json"));
}

template <class Visit>
void for_each_tile(const json& tile, const Visit& visit) {
  visit(tile);
  for (const json& child : tile.value("children", json::array())) for_each_tile(child, visit);
}

GlbReader content_of(const std::string& folder, const json& tile) {
  return GlbReader(bytes_of(fs::path(folder) / tile["content"]["uri"].get<std::string>()));
}

/// All files below a folder with their bytes.
std::map<std::string, std::string> files_in(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = bytes_of(entry.path());
  return files;
}

/// The labels of the features of a building in a file of a series, by id.
std::map<std::string, int> labels_in(const json& city) {
  std::map<std::string, std::string> of_id;
  for (const auto& [id, object] : city["CityObjects"].items()) {
    const json& attributes = object.value("attributes", json::object());
    if (object["type"] == "BuildingInstallation") of_id[id] = attributes["oriel_label"];
    for (const json& geometry : object["geometry"])
      for (const json& surface :
           geometry.value("semantics", json::object()).value("surfaces", json::array()))
        if (surface.contains("oriel_id") && object["type"] != "BuildingInstallation")
          of_id.try_emplace(surface["oriel_id"], surface.value("oriel_label", ""));
  }
  std::map<std::string, int> counts;
  for (const auto& [id, label] : of_id) ++counts[label];
  return counts;
}

using Place = std::array<double, 3>;

std::set<Place> places_in(const json& city) {
  std::set<Place> places;
  const json &scale = city["transform"]["scale"], &translate = city["transform"]["translate"];
  const auto add = [&](const auto& self, const json& boundaries) -> void {
    for (const json& part : boundaries) {
      if (part.is_array()) {
        self(self, part);
        continue;
      }
      Place place{};
      for (std::size_t i = 0; i < 3; ++i)
        place[i] =
            city["vertices"][part.get<std::size_t>()][i].get<double>() * scale[i].get<double>() +
            translate[i].get<double>();
      places.insert(place);
    }
  };
  for (const auto& [id, object] : city["CityObjects"].items())
    if (object["type"] == "Building")
      for (const json& geometry : object["geometry"]) add(add, geometry["boundaries"]);
  return places;
}

std::set<Place> places_in(const GlbReader& glb, const json& transform) {
  std::set<Place> places;
  for (Place place : glb.points()) {
    for (std::size_t i = 0; i < 3; ++i) place[i] += transform[12 + i].get<double>();
    places.insert(place);
  }
  return places;
}

/// Each of some places is one of others, but for the rounding of single numbers.
bool are_among(const std::set<Place>& some, const std::set<Place>& others) {
  constexpr double kRounding_m = 1e-5;
  return std::ranges::all_of(some, [&](const Place& p) {
    return std::ranges::any_of(others, [&](const Place& q) {
      return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) < kRounding_m;
    });
  });
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("tiles are the levels of a series, feature by feature and point by point") {
    const Folder folder;
    const std::string tiles = folder / "tiles", series = folder / "series";
    const std::string house = sample("house");
    const Outcome made = run({"tiles", house, "-o", tiles, "--scales", "1:500,1:2000,1:20000"});
    CHECK(made.exit == 0);
    CHECK(made.says("E161"));
    REQUIRE(run({"generalise", house, "--series", "1:500,1:2000,1:20000", "-o", series}).exit == 0);
    const json tileset = tileset_of(tiles);
    CHECK(tileset["asset"]["version"] == "1.1");
    std::vector<int> scales;
    double finer = 0;
    std::vector<json> chain;
    for_each_tile(tileset["root"], [&](const json& tile) { chain.push_back(tile); });
    std::ranges::reverse(chain);
    for (const json& tile : chain) {
      const int scale = tile["metadata"]["properties"]["scale"];
      scales.push_back(scale);
      CHECK(tile["geometricError"].get<double>() >= finer);
      finer = tile["geometricError"];
      const json level = json::parse(bytes_of(fmt::format("{}.1-{}.city.json", series, scale)));
      const GlbReader glb = content_of(tiles, tile);
      CHECK(glb.labels()["house"] == labels_in(level));
      const auto drawn = places_in(glb, tileset["root"]["transform"]), written = places_in(level);
      CHECK(are_among(drawn, written));
      CHECK(are_among(written, drawn));
    }
    CHECK(scales == kScales);
    CHECK(chain[0]["geometricError"] == 0);
    CHECK(tileset["geometricError"].get<double>() >= finer);
    CHECK(folder.names() ==
          std::vector<std::string>{"series.1-2000.city.json", "series.1-20000.city.json",
                                   "series.1-500.city.json", "series.oplog.jsonl", "tiles"});
  }

  TEST_CASE("a tileset on the earth has the bytes of any number of jobs") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    const std::string tile = shared / "data/3dbag/tile_5910.city.jsonl";
    const auto call = [&](const std::string& jobs) {
      const Outcome made =
          run({"tiles", tile, "-o", folder / ("of" + jobs), "--random", "9", "--scales",
               "1:1000,1:10000", "--most-triangles", "500", "-j", jobs});
      CHECK((made.exit == 0 || made.exit == 3));
      return files_in(folder / ("of" + jobs));
    };
    const auto files = call("1");
    CHECK(files == call("4"));
    CHECK(files.size() > 4);
    const json root = tileset_of(folder / "of1")["root"];
    const json& m = root["transform"];
    CHECK(std::hypot(m[12].get<double>(), m[13].get<double>(), m[14].get<double>()) ==
          doctest::Approx(6'365'000).epsilon(0.001));
    for (const int scale : {1000, 10'000}) {
      std::map<std::string, int> seen;
      for_each_tile(root, [&](const json& one) {
        if (!one.contains("content") || one["metadata"]["properties"]["scale"] != scale) return;
        std::set<std::string> ids;
        for (const GlbRow& row : content_of(folder / "of1", one).rows()) ids.insert(row.building);
        CHECK(ids.size() == one["metadata"]["properties"]["buildings"]);
        for (const std::string& id : ids) ++seen[id];
      });
      CHECK(std::ranges::all_of(seen, [](const auto& one) { return one.second == 1; }));
    }
  }

  TEST_CASE("a folder with other files, and systems that cannot be, are refused") {
    const Folder folder;
    const std::string house = sample("house");
    folder.write("notes.txt", "mine");
    const Outcome full = run({"tiles", house, "-o", folder.path().string()});
    CHECK(full.exit == 2);
    CHECK(full.says("E164"));
    CHECK(folder.names() == std::vector<std::string>{"notes.txt"});
    CHECK(run({"tiles", house, "-o", folder / "notes.txt"}).says("E164"));
    const Outcome unknown = run({"tiles", house, "-o", folder / "a", "--crs", "EPSG:1"});
    CHECK(unknown.exit == 5);
    CHECK(unknown.says("E160"));
    CHECK_FALSE(std::filesystem::exists(folder / "a"));
    CHECK(run({"tiles", house, "-o", folder / "a", "--crs", "local"}).err.find("E16") ==
          std::string::npos);
  }

  TEST_CASE("of a file without buildings no folder is left") {
    const Folder folder;
    for (const std::string text : {"", "{", "[]"}) {
      const std::string input = folder.write("in.city.json", text);
      CHECK(run({"tiles", input, "-o", folder / "tiles"}).exit == 5);
      CHECK(folder.names() == std::vector<std::string>{"in.city.json"});
    }
    // One that was there stays.
    std::filesystem::create_directory(folder / "mine");
    CHECK(run({"tiles", folder / "in.city.json", "-o", folder / "mine"}).exit == 5);
    CHECK(std::filesystem::is_empty(folder / "mine"));
  }

  TEST_CASE("buildings 1,000 km apart, and ids that occur twice, are told") {
    const Folder folder;
    json city = cubes({"a", "b"});
    const std::string first = folder.write("a.city.json", city.dump());
    city["transform"]["translate"] = {2e6, 0, 0};
    json renamed = json::parse(replaced(replaced(city.dump(), "\"a\"", "\"c\""), "\"b\"", "\"d\""));
    const Outcome apart =
        run({"tiles", first, folder.write("b.city.json", renamed.dump()), "-o", folder / "far"});
    CHECK(apart.exit == 5);
    CHECK(apart.says("E163"));
    const Outcome twice =
        run({"tiles", first, folder.write("c.city.json", cubes({"a", "e"}).dump()), "-o",
             folder / "twice"});
    CHECK(twice.exit == 3);
    CHECK(twice.says("E207"));
    const json root = tileset_of(folder / "twice")["root"];
    CHECK(root["metadata"]["properties"]["buildings"] == 3);
  }

  TEST_CASE("buildings of a file that are not selected are in no tile") {
    const Folder folder;
    const std::string file = folder.write("in.city.json", cubes({"a", "b", "c"}).dump());
    const Outcome made =
        run({"tiles", file, "-o", folder / "tiles", "--crs", "local", "--id", "b"});
    CHECK(made.exit == 0);
    for_each_tile(tileset_of(folder / "tiles")["root"], [&](const json& tile) {
      for (const GlbRow& row : content_of(folder / "tiles", tile).rows())
        CHECK(row.building == "b");
    });
  }

  TEST_CASE("on a full disk a tileset is an error, and nothing of it is left") {
    const Folder folder;
    const std::string file = folder.write("in.city.json", cubes({"a", "b"}).dump());
    // The buildings, a tile, and the page do not fit.
    for (const unsigned limit : {1000U, 4000U, 100'000U}) {
      CAPTURE(limit);
      const std::vector<std::string> call{"tiles", file, "-o", folder / "tiles", "--viewer"};
      const Outcome full = run(call, {.file_limit = limit});
      CHECK(full.exit == 6);
      CHECK(full.says("E601"));
      CHECK(folder.names() == std::vector<std::string>{"in.city.json"});
    }
    fs::create_directory(folder / "tiles");
    run({"tiles", file, "-o", folder / "tiles"}, {.file_limit = 4000U});
    CHECK(fs::is_empty(folder / "tiles"));
  }

  TEST_CASE("a page that a run left which was killed is no obstacle, another one is") {
    const Folder folder;
    const std::vector<std::string> call{"tiles", sample("house"), "-o", folder / "tiles",
                                        "--viewer"};
    REQUIRE(run(call).exit == 0);
    fs::remove(folder / "tiles/tileset.json");
    CHECK(run(call).exit == 0);
    fs::remove(folder / "tiles/tileset.json");
    folder.write("tiles/index.html", "mine");
    CHECK(run(call).says("E164"));
    CHECK(bytes_of(folder / "tiles/index.html") == "mine");
  }

  TEST_CASE("a run that was killed is no obstacle, and --resume goes on with it") {
    const Folder folder;
    const std::vector<std::string> houses{sample("house"), sample("block"), sample("row"),
                                          sample("hip"), sample("l-house")};
    /// The same call until it was killed with buildings.part there: it may end before.
    const auto kill = [&](const std::vector<std::string>& call, const std::string& tiles) {
      for (int i = 0; i < 50; ++i) {
        fs::remove_all(tiles);
        fs::create_directories(tiles);
        for (const std::string& name : folder.names())
          if (name.starts_with("run")) fs::remove(folder / name);
        const Outcome outcome =
            run(call, {.signal = SIGKILL, .watched = tiles, .watched_name = "buildings.part"});
        if (outcome.exit == 128 + SIGKILL) return true;
      }
      return false;
    };
    const auto call_to = [&](const std::string& tiles, std::vector<std::string> more) {
      more.insert(more.begin(), {"tiles", "-o", tiles});
      more.insert(more.end(), houses.begin(), houses.end());
      return more;
    };
    const std::string tiles = folder / "tiles", again = folder / "again";
    REQUIRE(kill(call_to(tiles, {}), tiles));
    CHECK_FALSE(fs::exists(fs::path(tiles) / "tileset.json"));
    CHECK(run(call_to(tiles, {})).exit == 0);
    const auto whole = files_in(tiles);
    const auto call = call_to(again, {"--resume", "--status", folder / "run"});
    REQUIRE(kill(call, again));
    CHECK(run(call).exit == 0);
    CHECK(files_in(again) == whole);
    CHECK(run(call).says("nothing left to do"));
  }

  TEST_CASE("gzip and compression change nothing that is read from a tileset") {
    const Folder folder;
    const std::string house = sample("house");
    const auto files_of = [&](const std::string& name, const std::vector<std::string>& options) {
      std::vector<std::string> call{"tiles", house, "-o", folder / name, "--crs", "local"};
      call.insert(call.end(), options.begin(), options.end());
      REQUIRE(run(call).exit == 0);
      return files_in(folder / name);
    };
    const auto plain = files_of("plain", {}), archives = files_of("gzip", {"--gzip", "--viewer"}),
               packed = files_of("packed", {"--compress", "meshopt"});
    CHECK(files_of("again", {"--gzip", "--viewer"}) == archives);
    CHECK(archives.size() == plain.size() + 1);
    CHECK(packed.size() == plain.size());
    for (const auto& [name, bytes] : plain) {
      CHECK(gunzip(archives.at(name)) == bytes);
      if (!name.ends_with(".glb")) continue;
      const GlbReader before(bytes), after(packed.at(name));
      CHECK(packed.at(name).size() <= bytes.size());
      CHECK(after.local_numbers() == before.local_numbers());
      CHECK(after.indices() == before.indices());
      CHECK(after.labels() == before.labels());
    }
    CHECK(packed.at("tiles/1-500/r.glb").size() < plain.at("tiles/1-500/r.glb").size() / 2);
    // The page is for all servers.
    CHECK(archives.at("index.html").starts_with("<!DOCTYPE html>"));
  }

  TEST_CASE("by material, faces have the colours of the input at all levels") {
    const Folder folder;
    json city = json::parse(bytes_of(sample("house")));
    const Outcome none = run({"tiles", sample("house"), "-o", folder / "none", "--colours",
                              "material", "--crs", "local"});
    CHECK(none.exit == 0);
    CHECK(none.says("E169"));
    city["appearance"]["materials"] = {{{"name", "brick"}, {"diffuseColor", {1, 0, 0}}}};
    for (auto& [id, object] : city["CityObjects"].items())
      for (json& geometry : object["geometry"]) geometry["material"]["visual"]["value"] = 0;
    const Outcome made = run({"tiles", folder.write("a.city.json", city.dump()), "-o",
                              folder / "tiles", "--colours", "material", "--crs", "local"});
    CHECK(made.exit == 0);
    CHECK_FALSE(made.says("E169"));
    std::size_t levels = 0;
    for_each_tile(tileset_of(folder / "tiles")["root"], [&](const json& tile) {
      const auto colours = content_of(folder / "tiles", tile).colours();
      const auto is_brick = [](const auto& one) {
        return one == std::array<unsigned char, 4>{255, 0, 0, 255};
      };
      CHECK(std::ranges::all_of(colours, is_brick));
      ++levels;
    });
    CHECK(levels == 4);
  }

  TEST_CASE("levels between two scales are in equal ratios") {
    const Folder folder;
    const Outcome made = run({"tiles", sample("house"), "-o", folder / "tiles", "--scales",
                              "1:500,1:50000", "--levels", "5"});
    CHECK(made.exit == 0);
    for (const char* scale : {"1:500:", "1:1580:", "1:5000:", "1:15800:", "1:50000:"})
      CHECK(made.says(scale));
    CHECK(run({"tiles", sample("house"), "-o", folder / "b", "--scales", "1:500", "--levels", "5"})
              .exit == 2);
  }

  TEST_CASE("a house with its labels goes to a GLB") {
    const Folder folder;
    REQUIRE(run({"label", sample("house"), "-o", folder / "house.glb"}).exit == 0);
    REQUIRE(run({"label", sample("house"), "-o", folder / "house.city.json"}).exit == 0);
    const GlbReader glb(bytes_of(folder / "house.glb"));
    CHECK(glb.labels()["house"] == labels_in(json::parse(bytes_of(folder / "house.city.json"))));
    CHECK(run({"label", folder / "house.glb", "-o", folder / "b.obj"}).says("E106"));
  }
}
