#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/corpus.h"
#include "tests/support/shared.h"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

using Words = std::vector<std::string>;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
constexpr unsigned kMostSeconds = 0;  // any: what checks itself is slower
#else
constexpr unsigned kMostSeconds = 10;  // twice what a building may take
#endif

/// A building with that geometry as a stream.
std::string stream_of(const std::string& type, const std::string& boundaries,
                      const std::string& vertices) {
  const json header = {{"type", "CityJSON"},
                       {"version", "2.0"},
                       {"transform", {{"scale", {0.001, 0.001, 0.001}}, {"translate", {0, 0, 0}}}},
                       {"CityObjects", json::object()},
                       {"vertices", json::array()}};
  json geometry = {{"type", type}, {"lod", "2"}};
  geometry["boundaries"] = json::parse(boundaries);
  json feature = {{"type", "CityJSONFeature"}, {"id", "b"}};
  feature["CityObjects"]["b"] = {{"type", "Building"}, {"geometry", json::array({geometry})}};
  feature["vertices"] = json::parse(vertices);
  return header.dump() + "\n" + feature.dump() + "\n";
}

const std::string kCube =
    "[[0,0,0],[4000,0,0],[0,4000,0],[4000,4000,0],"
    "[0,0,4000],[4000,0,4000],[0,4000,4000],[4000,4000,4000]]";
const std::string kShell =
    "[[[0,2,3,1]],[[4,5,7,6]],[[0,1,5,4]],[[1,3,7,5]],[[3,2,6,7]],[[2,0,4,6]]]";

/// Two sheets in one upright plane: one polygon from behind, and before it strips that do not reach
/// its ends. What they enclose is nothing but what rounding leaves.
std::string flat_sheets() {
  const std::vector<int> along{0, 137, 204, 987, 1661, 2317, 2760, 3000};
  json vertices = json::array(), polygons = json::array();
  for (const int sheet : {0, 1}) {
    const int first = static_cast<int>(vertices.size());
    for (const int y : along)
      for (const int z : {-432, 2805})
        vertices.push_back({15022, y - 229579 + sheet * 8322, z + sheet * 4816});
    const auto strip = [&](int from, int to) {
      polygons.push_back(
          {{first + 2 * from + 1, first + 2 * from, first + 2 * to, first + 2 * to + 1}});
    };
    strip(5, 2);
    strip(2, 3);
    strip(3, 4);
    strip(7, 0);
    strip(4, 6);
    strip(1, 5);
  }
  return stream_of("Solid", json::array({polygons}).dump(), vertices.dump());
}

/// Bodies of the kinds that once crashed a command, made it run for ever, or were called a fault of
/// oriel's own, by what is wrong with them.
const std::map<std::string, std::string>& hard_bodies() {
  static const std::map<std::string, std::string> bodies{
      {"a sheet given from both sides",
       stream_of("MultiSurface", "[[[0,1,3,2]],[[0,2,3,1]],[[4,5,7,6]],[[0,1,5,4]]]", kCube)},
      {"polygons upon each other",
       stream_of("MultiSurface", "[[[0,1,5,4]],[[0,1,5,4]],[[0,1,5,4]],[[4,5,7,6]]]", kCube)},
      {"a solid given twice",
       stream_of("CompositeSolid", "[[" + kShell + "],[" + kShell + "]]", kCube)},
      {"a wedge given twice, once with a corner too many",
       stream_of("CompositeSolid",
                 "[[[[[0,1,2,3]],[[4,5,6,7]],[[0,3,5,4]],[[3,3,2,6,5]],[[1,0,4,7]]]],"
                 "[[[[0,1,2,3]],[[4,5,6,7]],[[0,3,5,4]],[[3,2,6,5]],[[1,0,4,7]]]]]",
                 "[[0,0,0],[0,4000,0],[4000,4000,0],[4000,0,0],[0,0,4000],[4000,0,4000],"
                 "[0,2000,0],[0,4000,4000]]")},
      {"walls in one plane",
       stream_of("Solid", "[[[[0,1,3,2]],[[2,3,5,4]],[[4,5,7,6]]]]",
                 "[[0,0,0],[0,0,4000],[0,1000,0],[0,1000,4000],[0,2000,0],[0,2000,4000],"
                 "[0,3000,0],[0,3000,4000]]")},
      {"sheets that enclose what rounding leaves", flat_sheets()},
      {"polygons of millimetres that fold when they are welded",
       stream_of("MultiSurface", "[[[0,1,5,4]],[[3,2,6,7]],[[0,7,3,1]],[[3,7,5,2]]]",
                 "[[1,1,1],[4,1,1],[1,2,1],[4,2,1],[1,1,5],[4,1,5],[1,2,5],[4,2,4]]")},
      {"a polygon without corners",
       stream_of("Solid", "[[[[0,2,3,1]],[[]],[[0,1,5,4]],[[1,3,7,5]],[[3,2,6,7]],[[2,0,4,6]]]]",
                 kCube)},
      {"a hole in nothing",
       stream_of("Solid",
                 "[[[[0,2,3,1]],[[],[4,5,7,6]],[[0,1,5,4]],[[1,3,7,5]],[[3,2,6,7]],[[2,0,4,6]]]]",
                 kCube)},
      {"a cavity in nothing", stream_of("Solid", "[[]," + kShell + "]", kCube)},
      {"a roof below its ground",
       stream_of("MultiSurface", "[[[2,5,4,1]],[[4,6,7,5]],[[7,3,0,6]],[[3,2,5,7]],[[3,2,5,7]]]",
                 "[[0,0,0],[0,-900,0],[-120,-900,0],[0,-900,0],[0,-900,60],[-120,-900,60],"
                 "[0,0,60],[-120,0,60]]")},
      {"a vertex beyond all numbers",
       stream_of("MultiSurface", "[[[0,1,9223372036854775807]]]", kCube)},
      {"nothing but points in one place",
       stream_of("Solid", "[" + kShell + "]",
                 "[[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]]")}};
  return bodies;
}

/// Every command that works on buildings.
std::vector<Words> commands_on(const std::string& input, const Folder& folder) {
  std::vector<Words> commands{
      {"label"},
      {"label", "--repaired", "-o", folder / "repaired.city.jsonl"},
      {"label", "--existing", "audit"},
      {"segment"},
      {"segment", "--tree", "--json"},
      {"segment", "--json", "--faces"},
      {"segment", "--json", "--order", "paper"},
      {"explain", "--surface", "0"},
      {"view", "-o", folder / "page.html"},
      {"generalise", "--scale", "1:2500", "-o", folder / "scale.city.jsonl"},
      {"generalise", "--to-lod", "2.0,1.3,1.2,1.0", "-o", folder / "lods.city.jsonl"},
      {"generalise", "--series", "1:500,1:2500,1:10000", "-o", folder / "series"},
      {"generalise", "--profile", "cfd", "-o", folder / "cfd.city.jsonl"},
      {"repair", "-o", folder / "solids.city.jsonl"},
      {"repair", "--close", "any", "-o", folder / "closed.city.jsonl"},
      {"validate"},
      {"validate", "--lod", "all", "--json"},
      {"score", "--surfaces"},
      {"cat", "-o", folder / "cat.city.jsonl"},
      {"collect", "-o", folder / "collected.city.json"}};
  for (Words& command : commands) command.push_back(input);
  return commands;
}

/// It comes to an end of its own, and says what it did.
void check_end(const Words& command, const Surroundings& around) {
  const Outcome outcome = run(command, around);
  CAPTURE(command);
  CAPTURE(outcome.err);
  CHECK((outcome.exit == 0 || outcome.exit == 2 || outcome.exit == 3 ||
         (outcome.exit == 5 && command[0] == "view")));
  CHECK(!outcome.says("E901"));
  CHECK((!outcome.err.empty() || !outcome.out.empty()));
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("no command crashes or runs on for a body that is hard") {
    Surroundings around;
    around.cpu_limit_s = kMostSeconds;
    for (const auto& [name, text] : hard_bodies()) {
      CAPTURE(name);
      const Folder folder;
      for (const Words& command : commands_on(folder.write("in.city.jsonl", text), folder))
        check_end(command, around);
    }
  }

  TEST_CASE("a body that is hard costs itself only in a stream") {
    for (const auto& [name, text] : hard_bodies()) {
      CAPTURE(name);
      std::string lines = text;
      lines += lines_of(cube_lines({"good"})).at(1) + "\n";
      for (const Words& command : std::vector<Words>{{"label", "-"},
                                                     {"generalise", "--scale", "1:1000", "-"},
                                                     {"repair", "-o", "-", "-"},
                                                     {"segment", "--json", "-"}}) {
        CAPTURE(command);
        Surroundings around;
        around.in = lines;
        around.cpu_limit_s = kMostSeconds;
        const Outcome outcome = run(command, around);
        CAPTURE(outcome.err);
        CHECK((outcome.exit == 0 || outcome.exit == 3));
        CHECK(outcome.out.find("\"good\"") != std::string::npos);
      }
    }
  }

  TEST_CASE("slow: no command crashes or runs on for the inputs that show faults" *
            doctest::skip(std::getenv("ORIEL_SLOW") == nullptr)) {
    ORIEL_NEEDS_SHARED(shared);
    // ORIEL_SLOW=2: all commands on all files; CI takes every twelfth, of each file others.
    const std::size_t step = std::atoi(std::getenv("ORIEL_SLOW")) > 1 ? 1 : 12;
    Surroundings around;
    around.cpu_limit_s = kMostSeconds;
    std::size_t files = 0;
    for (const char* ending : {".json", ".jsonl", ".obj"})
      for (const std::string& file : files_in(shared / "data" / "faults", ending)) {
        CAPTURE(file);
        const Folder folder;
        const std::string lines = folder / "in.city.jsonl";
        const int exit = run({"cat", file, "-o", lines}).exit;
        CHECK((exit == 0 || exit == 3));
        const std::vector<Words> commands = commands_on(lines, folder);
        for (std::size_t i = files++ % step; i < commands.size(); i += step)
          check_end(commands[i], around);
      }
    CHECK(files > 0);
  }
}
