#include "examples/generator/generate.h"
#include "examples/generator/output/cityjson.h"
#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel::test;

namespace {

using Names = std::vector<std::string>;

const std::vector<Names> kTargets{
    {"--scale", "1:500"},   {"--scale", "1:1000"}, {"--scale", "1:2500"}, {"--scale", "1:5000"},
    {"--scale", "1:10000"}, {"--to-lod", "2.0"},   {"--to-lod", "1.2"},   {"--to-lod", "1.0"}};

Names joined(Names arguments, const Names& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// The buildings that `validate` calls valid solids.
std::set<std::string> valid_in(const Names& files, const Names& options = {}) {
  std::set<std::string> ids;
  std::istringstream lines(run(joined(joined({"validate"}, files), options)).out);
  const std::string ending = ": valid";
  for (std::string line; std::getline(lines, line);)
    if (line.ends_with(ending)) ids.insert(line.substr(0, line.size() - ending.size()));
  return ids;
}

/// The buildings that messages name: those set aside, those with something refused, and those
/// that it calls invalid as they were read.
struct NamedBuildings {
  std::set<std::string> set_aside, refused, invalid_before;
};

NamedBuildings said_in(const std::string& text) {
  NamedBuildings said;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind, id;
    words >> kind >> id;
    while (id.ends_with(':')) id.pop_back();
    if (kind == "error:") said.set_aside.insert(id);
    const bool is_refusal = std::ranges::any_of(
        Names{"G401", "G403", "G405", "G408", "G410", "G411", "G412", "G418"},
        [&](const std::string& code) { return line.find(code) != std::string::npos; });
    if (kind == "warning:" && is_refusal) said.refused.insert(id);
    if (line.find("G413") != std::string::npos) said.invalid_before.insert(id);
  }
  return said;
}

/// Every building that is valid as it was read is valid in what is written of it, or set aside with
/// its reason told. Returns how many solids were judged, over all targets.
std::size_t check_valid(const std::string& data, const Names& files) {
  const std::set<std::string> before = valid_in(files);
  CHECK_FALSE(before.empty());
  std::size_t judged = 0;
  for (const Names& target : kTargets) {
    const Folder folder;
    const std::string& level = target[1];
    CAPTURE(data);
    CAPTURE(level);
    const Outcome made = run(joined(joined({"generalise"}, files),
                                    {target[0], level, "-j", "2", "-o", folder.path() / ""}));
    REQUIRE((made.exit == 0 || made.exit == 3));
    const NamedBuildings said = said_in(made.err);
    for (const std::string& id : said.invalid_before) CHECK_FALSE_MESSAGE(before.contains(id), id);
    Names written;
    for (const std::string& name : folder.names()) written.push_back(folder / name);
    const bool is_lod = target[0] == "--to-lod";
    const std::set<std::string> after = valid_in(written, is_lod ? Names{"--lod", level} : Names{});
    for (const std::string& id : before) {
      if (said.set_aside.contains(id)) continue;
      CAPTURE(id);
      CHECK(after.contains(id));
      ++judged;
    }
    MESSAGE(data << " at " << level << ": " << before.size() << " valid as read, " << after.size()
                 << " valid as written, " << said.set_aside.size() << " set aside, "
                 << said.refused.size() << " with something refused");
  }
  return judged;
}

/// A block of 10 x 8 x 6 m with a chimney that is cut out of its top and stands half beyond its
/// edge: closed, but the ring of the hole crosses the outer one.
std::string crossing_house() {
  return R"({"type": "CityJSON", "version": "2.0",
  "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]},
  "CityObjects": {"b": {"type": "Building", "geometry": [{"type": "Solid", "lod": "3", "boundaries": [[
    [[0, 3, 2, 1]], [[0, 1, 5, 4]], [[1, 2, 6, 5]], [[2, 3, 7, 6]], [[3, 0, 4, 7]],
    [[4, 5, 6, 7], [8, 11, 10, 9]],
    [[8, 9, 13, 12]], [[9, 10, 14, 13]], [[10, 11, 15, 14]], [[11, 8, 12, 15]], [[12, 13, 14, 15]]]]}]}},
  "vertices": [[0, 0, 0], [10, 0, 0], [10, 8, 0], [0, 8, 0], [0, 0, 6], [10, 0, 6], [10, 8, 6], [0, 8, 6],
    [9, 3, 6], [11, 3, 6], [11, 5, 6], [9, 5, 6], [9, 3, 8], [11, 3, 8], [11, 5, 8], [9, 5, 8]]})";
}

/// A block with a chimney whose corners are twisted at its top; without it all is well.
std::string twisted_chimney() {
  return R"({"type": "CityJSON", "version": "2.0",
  "transform": {"scale": [0.5, 0.5, 1], "translate": [0, 0, 0]},
  "CityObjects": {"b": {"type": "Building", "geometry": [{"type": "Solid", "lod": "3", "boundaries": [[
    [[0, 3, 2, 1]], [[0, 1, 5, 4]], [[1, 2, 6, 5]], [[2, 3, 7, 6]], [[3, 0, 4, 7]],
    [[4, 5, 6, 7], [8, 11, 10, 9]],
    [[8, 9, 13, 12]], [[9, 10, 14, 13]], [[10, 11, 15, 14]], [[11, 8, 12, 15]], [[12, 13, 14, 15]]]]}]}},
  "vertices": [[0, 0, 0], [16, 0, 0], [16, 16, 0], [0, 16, 0], [0, 0, 6], [16, 0, 6], [16, 16, 6], [0, 16, 6],
    [4, 4, 6], [5, 4, 6], [5, 5, 6], [4, 5, 6], [5, 4, 7], [4, 4, 7], [5, 5, 7], [4, 5, 7]]})";
}

/// The same with a chimney that stands askew, as a stream of whole metres.
std::string slanting_stream() {
  return R"({"type": "CityJSON", "version": "2.0", "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]}, "CityObjects": {}, "vertices": []}
{"type": "CityJSONFeature", "id": "b", "CityObjects": {"b": {"type": "Building", "geometry": [{"type": "Solid", "lod": "3", "boundaries": [[ [[0, 3, 2, 1]], [[0, 1, 5, 4]], [[1, 2, 6, 5]], [[2, 3, 7, 6]], [[3, 0, 4, 7]], [[4, 5, 6, 7], [8, 11, 10, 9]], [[8, 9, 13, 12]], [[9, 10, 14, 13]], [[10, 11, 15, 14]], [[11, 8, 12, 15]], [[12, 13, 14, 15]]]]}]}}, "vertices": [[0, 0, 0], [10, 0, 0], [10, 8, 0], [0, 8, 0], [0, 0, 6], [10, 0, 6], [10, 8, 6], [0, 8, 6], [8, 3, 6], [13, 4, 6], [12, 6, 6], [7, 5, 6], [8, 3, 8], [13, 4, 8], [12, 6, 8], [7, 5, 8]]}
)";
}

/// The same with a small chimney that stands well.
std::string slanting_stream_with_chimney() {
  return replaced(
      replaced(replaced(slanting_stream(), "[8, 11, 10, 9]]", "[8, 11, 10, 9], [16, 19, 18, 17]]"),
               "[[12, 13, 14, 15]]]]",
               "[[12, 13, 14, 15]], [[16, 17, 21, 20]], [[17, 18, 22, 21]], [[18, 19, 23, 22]], "
               "[[19, 16, 20, 23]], [[20, 21, 22, 23]]]]"),
      "[7, 5, 8]]",
      "[7, 5, 8], [2, 3, 6], [3, 3, 6], [3, 4, 6], [2, 4, 6], [2, 3, 7], [3, 3, 7], [3, 4, 7], [2, "
      "4, 7]]");
}

/// The first line of a stream, and every step-th record after it.
std::string every_record(int step, const std::string& file) {
  std::ifstream in(file);
  std::string text;
  int number = 0;
  for (std::string line; std::getline(in, line); ++number)
    if (number == 0 || number % step == 0) text += line + "\n";
  return text;
}

/// Houses of the generator, with noise of 0, 1 and 2 mm in turn.
Names generated(int count, const Folder& folder) {
  oriel::generator::Options options;
  Names files;
  for (int i = 0; i < count; ++i) {
    options.noise = 1000 * (i % 3);
    const std::string id = "house-" + std::to_string(i);
    files.push_back(
        folder.write(id + ".city.json",
                     oriel::generator::cityjson({id, oriel::generator::generate(options, i), {}},
                                                oriel::generator::Content::stripped)));
  }
  return files;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("what is generalised of valid buildings is valid in the file at every target") {
    const Folder folder;
    Names files = generated(6, folder);
    for (const char* name : {"house", "row", "l-house", "block"}) files.push_back(sample(name));
    CHECK(check_valid("samples", files) > 60);
  }

  TEST_CASE("what came invalid is written as a valid solid where nothing changes, and once only") {
    const Folder folder;
    const Names files = generated(30, folder);
    const std::set<std::string> before = valid_in(files);
    CHECK(before.size() < files.size());  // noise moves corners out of their planes
    Names last = files;
    for (const bool is_first : {true, false}) {
      const Folder out;
      const Outcome made = run(
          joined(joined({"generalise"}, last), {"--scale", "1:10", "-v", "-o", out.path() / ""}));
      CHECK(made.exit == 0);
      CHECK((made.err.find("G419") != std::string::npos) == is_first);
      Names written;
      for (const std::string& name : out.names()) written.push_back(out / name);
      CHECK(valid_in(written).size() == files.size());
      last.clear();
      for (const std::string& name : out.names())
        last.push_back(folder.write("again-" + name, bytes_of(out / name)));
    }
  }

  TEST_CASE("what runs through itself is drawn from the boundary of its inside and told") {
    const Folder folder;
    const std::string file = folder.write("b.city.json", crossing_house());
    CHECK(valid_in({file}).empty());
    const std::string out = folder / "out.city.json";
    const Outcome made = run({"generalise", file, "--scale", "1:10", "-o", out});
    CHECK(made.exit == 0);
    CHECK(made.err.find("warning: b: G417") != std::string::npos);
    CHECK(made.err.find("G413") == std::string::npos);
    CHECK(valid_in({out}).size() == 1);
    const Outcome again = run({"generalise", out, "--scale", "1:10", "-o", folder / "2.city.json"});
    CHECK(again.err.find("G417") == std::string::npos);
  }

  TEST_CASE("levels of a series are drawn from the boundary of its inside, too, changed or not") {
    const Folder folder;
    const std::string file = folder.write("b.city.json", crossing_house());
    const Outcome made =
        run({"generalise", file, "--series", "1:10,1:2500", "-o", folder / "series"});
    CHECK(made.exit == 0);
    CHECK(made.err.find("warning: b: G417") != std::string::npos);
    CHECK(made.err.find("G413") == std::string::npos);
    const Names levels{folder / "series.1-10.city.json", folder / "series.1-2500.city.json"};
    CHECK(valid_in({levels[0]}).size() == 1);
    CHECK(valid_in({levels[1]}).size() == 1);
  }

  TEST_CASE("a series says if only the building as it came is not valid") {
    const Folder folder;
    const std::string file = folder.write("b.city.json", twisted_chimney());
    const Outcome made =
        run({"generalise", file, "--series", "1:5000,1:10000", "-o", folder / "series"});
    CHECK(made.exit == 0);
    CHECK(made.err.find("warning: b: G413") != std::string::npos);
    CHECK(made.err.find("its levels from 1:5000 on are") != std::string::npos);
    for (const char* level : {"series.1-5000.city.json", "series.1-10000.city.json"})
      CHECK(valid_in({folder / level}).size() == 1);
  }

  TEST_CASE("repair makes a solid of what runs through itself unless crossings are left") {
    const Folder folder;
    const std::string file = folder.write("b.city.json", crossing_house());
    const std::string out = folder / "out.city.json";
    CHECK(run({"repair", file, "-o", out, "--crossings", "leave"}).exit == 3);
    const Outcome made = run({"repair", file, "-o", out, "-v"});
    CHECK(made.exit == 0);
    CHECK(made.err.find("1 polygon cut") != std::string::npos);
    CHECK(valid_in({out}).size() == 1);
  }

  TEST_CASE("what came invalid and cannot be valid is rejected and stays as it came") {
    // Its chimney meets the edge of the top between the whole metres of the stream's grid.
    const Folder folder;
    const std::string file = folder.write("b.city.jsonl", slanting_stream());
    CHECK(valid_in({file}).empty());
    const Outcome made =
        run({"generalise", file, "--scale", "1:10", "-o", folder / "out.city.jsonl"});
    CHECK(made.exit == 3);
    CHECK(made.err.find("error: b: G413") != std::string::npos);
    CHECK(made.err.find("1 rejected (G413 1)") != std::string::npos);
    CHECK(made.err.find("G417") == std::string::npos);
  }

  TEST_CASE("what cannot be valid stays as it came and has no levels") {
    const Folder folder;
    const std::string file = folder.write("b.city.jsonl", slanting_stream_with_chimney());
    const std::string out = folder / "out.city.jsonl";
    const Outcome made = run({"generalise", file, "--scale", "1:2500", "-o", out});
    CHECK(made.exit == 3);
    CHECK(made.err.find("error: b: G413") != std::string::npos);
    CHECK(bytes_of(out).find("[[19, 16, 20, 23]], [[20, 21, 22, 23]]]]") != std::string::npos);
    const Outcome series =
        run({"generalise", file, "--series", "1:1000,1:2500", "-o", folder / "series"});
    CHECK(series.exit == 3);
    CHECK(series.err.find("error: b: G413") != std::string::npos);
  }

  TEST_CASE("published buildings that run through themselves are valid at every target") {
    ORIEL_NEEDS_SHARED(shared);
    Names files;
    for (const std::string& file : city_files(shared))
      for (const char* name :
           {"2bea227d", "5f4e5b1c", "cf0c8ee0", "e4e43c1b", "GML_7b1a5a6f", "4018154.stripped"})
        if (file.find(name) != std::string::npos && file.ends_with(".stripped.city.json"))
          files.push_back(file);
    CHECK(files.size() == 6);
    CHECK(valid_in(files).empty());
    for (const Names& target : kTargets) {
      CAPTURE(target[1]);
      const Folder folder;
      const Outcome made = run(
          joined(joined({"generalise"}, files), {target[0], target[1], "-o", folder.path() / ""}));
      CHECK(made.exit == 0);
      CHECK(made.err.find("G413") == std::string::npos);
      Names written;
      for (const std::string& name : folder.names()) written.push_back(folder / name);
      const bool is_lod = target[0] == "--to-lod";
      CHECK(valid_in(written, is_lod ? Names{"--lod", target[1]} : Names{}).size() == 6);
    }
  }

  TEST_CASE("shared data: a building whose cuts meet is drawn from the boundary of its inside") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    const std::string out = folder / "out.city.jsonl";
    const Outcome made =
        run({"generalise", shared / "data/3dbag/tile_5910.city.jsonl", "--lod", "2.2", "--id",
             "NL.IMBAG.Pand.0503100000033695-0", "--scale", "1:500", "-o", out});
    CHECK(made.exit == 0);
    CHECK(made.err.find("G417") != std::string::npos);
    CHECK(made.err.find("G410") == std::string::npos);
    CHECK(valid_in({out}, {"--lod", "2.2"}).size() == 1);
  }

  TEST_CASE("a valid block of what came invalid is not called invalid") {
    const Folder folder;
    const std::string file = folder.write("b.city.json", crossing_house());
    const std::string block = folder / "block.city.json";
    const Outcome made = run({"generalise", file, "--to-lod", "1.2", "-v", "-o", block});
    CHECK(made.exit == 0);
    CHECK(valid_in({block}, {"--lod", "1.2"}).size() == 1);
    CHECK(made.err.find("G413") == std::string::npos);
    CHECK(made.err.find("G419") == std::string::npos);
  }

  TEST_CASE("blocks of noisy houses are valid") {
    // Houses whose plan had spikes of 2 mm.
    oriel::generator::Options options;
    options.seed = 3;
    options.noise = 2000;
    const Folder folder;
    Names files;
    for (const int i : {110, 114, 149, 175, 179, 333}) {
      const std::string id = "house-" + std::to_string(i);
      files.push_back(
          folder.write(id + ".city.json",
                       oriel::generator::cityjson({id, oriel::generator::generate(options, i), {}},
                                                  oriel::generator::Content::stripped)));
    }
    for (const char* level : {"1.3", "1.2", "1.0"}) {
      const Folder out;
      const Outcome made =
          run(joined(joined({"generalise"}, files), {"--to-lod", level, "-o", out.path() / ""}));
      CHECK(made.exit == 0);
      Names written;
      for (const std::string& name : out.names()) written.push_back(out / name);
      CHECK(valid_in(written, {"--lod", level}).size() == files.size());
    }
  }

  TEST_CASE("a solid that is there twice makes no series and is no fault of ours") {
    auto city = cubes({"twice", "once"});
    auto& geometry = city["CityObjects"]["twice"]["geometry"][0];
    geometry["type"] = "CompositeSolid";
    const auto shells = geometry["boundaries"];
    geometry["boundaries"] = {shells, shells};
    const Folder folder;
    const Outcome made = run({"generalise", folder.write("cubes.city.json", city.dump()),
                              "--series", "1:500,1:2500", "-o", folder / "s"});
    CHECK(made.exit == 3);
    CHECK(made.says("G410 is not a series: two facets have the same outer ring"));
    CHECK(!made.says("E901"));
    CHECK(made.says("1 of 2 buildings drawn at 2 scales"));
  }

  TEST_CASE("slow: levels of a series are valid where the file folds facets and makes corners one" *
            doctest::skip(std::getenv("ORIEL_SLOW") == nullptr)) {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    const std::string id = "NL.IMBAG.Pand.0503100000019275-0";
    const Outcome made =
        run({"generalise", shared / "data/3dbag/tile_5910.city.jsonl", "--lod", "2.2", "--id", id,
             "--series", "1:500,1:1000,1:10000", "-o", folder / "s"});
    CHECK(made.exit == 0);
    CHECK(made.err.find("G413") == std::string::npos);
    CHECK(made.err.find("G410") == std::string::npos);
    for (const char* scale : {"1:1", "1:500", "1:700", "1:10000"}) {
      CAPTURE(scale);
      const std::string at = folder / "at.city.jsonl";
      CHECK(run({"generalise", "--at", scale, "--from", folder / "s", "-o", at}).exit == 0);
      CHECK(valid_in({at}, {"--lod", "2.2", "--id", id}).size() == 1);
    }
  }

  TEST_CASE("slow: what is generalised of the data and of generated houses is valid in the file" *
            doctest::skip(std::getenv("ORIEL_SLOW") == nullptr)) {
    // ORIEL_SLOW=1000 for as many houses, all of the tile and all other files; CI takes fewer
    // houses, one in 48 buildings of the tile and every sixteenth file.
    const int asked = std::atoi(std::getenv("ORIEL_SLOW"));
    const int houses = std::max(10, asked);
    const Folder folder;
    CHECK(check_valid("generated", generated(houses, folder)) >
          static_cast<std::size_t>(6 * houses));
    ORIEL_NEEDS_SHARED(shared);
    const std::string tile = shared / "data/3dbag/tile_5910.city.jsonl";
    std::map<std::string, Names> data{
        {"3dbag", {folder.write("tile.city.jsonl", every_record(asked > 1 ? 1 : 48, tile))}}};
    std::size_t number = 0;
    for (const std::string& file : city_files(shared))
      if (file.ends_with(".stripped.city.json") && (asked > 1 || number++ % 16 == 0))
        data[std::filesystem::path(file).parent_path().filename()].push_back(file);
    data.erase("ogc-simple-house");  // not valid as it comes
    CHECK(data.size() == 3);
    for (const auto& [name, files] : data) CHECK(check_valid(name, files) > (asked > 1 ? 40 : 5));
  }
}
