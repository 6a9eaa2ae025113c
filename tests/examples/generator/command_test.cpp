#include "examples/generator/command.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel::generator {
namespace {

namespace fs = std::filesystem;

struct Result {
  int code = 0;
  std::string out, err;
};

Result run(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "oriel-generate");
  std::ostringstream out, err;
  const int code = run_command(static_cast<int>(arguments.size()), arguments.data(), out, err);
  return {code, out.str(), err.str()};
}

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// An empty folder that is removed at the end of the test.
struct Scratch {
  // Tests may run at the same time.
  fs::path path = fs::path(ORIEL_BINARY_DIR) / ("scratch-generator-" + std::to_string(::getpid()));
  Scratch() {
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Scratch() { fs::remove_all(path); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] std::string at(const char* name) const { return (path / name).string(); }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_SUITE("examples/generator") {
  TEST_CASE("wrong arguments end with 2 and say what is wrong") {
    struct Case {
      std::vector<const char*> arguments;
      const char* message;
    };
    const std::vector<Case> cases{
        {{}, "--output"},
        {{"-o", "x", "--sed", "1"}, "--sed"},
        {{"-o", "x", "--seed", "one"}, "--seed"},
        {{"-o", "x", "--count", "0"}, "--count"},
        {{"-o", "x", "--roof", "round"}, "--roof"},
        {{"-o", "x", "--storeys", "9"}, "'9' is not a range within 1 .. 8"},
        {{"-o", "x", "--storeys", "3..2"}, "--storeys"},
        {{"-o", "x", "--width", "5"}, "--width"},
        {{"-o", "x", "--width", "wide"}, "'wide' is not a number"},
        {{"-o", "x", "--depth", "8..nan"}, "--depth"},
        {{"-o", "x", "--features", "window,dor"}, "there is no feature 'dor'"},
        {{"-o", "x", "--chimney", "wall"}, "--chimney"},
        {{"-o", "x", "--flush", "1.5"}, "--flush"},
        {{"-o", "x", "--noise", "11"}, "--noise"},
        {{"-o", "x", "--origin", "1,2"}, "X,Y,Z"},
        {{"-o", "x", "--windows", "100000"}, "--windows"},
        {{"-o", "x", "--name", "1st"}, "--name"},
        {{"-o", "x", "--labelled"}, "CityJSONSeq"},
        {{"-o", "x", "--format", "gml"}, "--format"},
        {{"-o", "x.city.jsonl", "--format", "citygml"}, "--format"},
        {{"-o", "-", "--format", "citygml3"}, "--format"},
        {{"-o", "x", "--style", "dutch"}, "--style"},
    };
    for (const Case& wrong : cases) {
      const Result result = run(wrong.arguments);
      INFO(result.err);
      CHECK(result.code == 2);
      CHECK(result.err.find(wrong.message) != std::string::npos);
      CHECK(result.out.empty());
    }
  }

  TEST_CASE("help goes to the output and ends with 0") {
    const Result result = run({"--help"});
    CHECK(result.code == 0);
    CHECK(result.out.find("--triangulate") != std::string::npos);
    CHECK(result.out.find("roof_window") != std::string::npos);
  }

  TEST_CASE("a folder gets three files for each house") {
    const Scratch scratch;
    const std::string folder = scratch.at("made/here");
    REQUIRE(run({"--count", "2", "--name", "h", "-o", folder.c_str()}).code == 0);
    for (const char* name : {"h-000001", "h-000002"})
      for (const char* kind : {".labelled.city.json", ".stripped.city.json", ".truth.json"})
        CHECK(fs::file_size(fs::path(folder) / (std::string(name) + kind)) > 1000);
    CHECK(std::distance(fs::directory_iterator(folder), {}) == 6);
  }

  TEST_CASE("a stream holds a header and a feature a line and does not depend on the count") {
    const Scratch scratch;
    const std::string file = scratch.at("town.city.jsonl"), truth = scratch.at("truth.jsonl");
    REQUIRE(run({"--count", "3", "-o", file.c_str(), "--truth", truth.c_str()}).code == 0);
    const std::vector<std::string> lines = lines_of(read(file)), truths = lines_of(read(truth));
    REQUIRE(lines.size() == 4);
    REQUIRE(truths.size() == 3);
    CHECK(nlohmann::json::parse(lines[0])["type"] == "CityJSON");
    for (std::size_t i = 1; i < 4; ++i) {
      const auto feature = nlohmann::json::parse(lines[i]);
      CHECK(feature["type"] == "CityJSONFeature");
      CHECK(feature["CityObjects"].contains(feature["id"].get<std::string>()));
      CHECK(nlohmann::json::parse(truths[i - 1])["building"] == feature["id"]);
    }
    const std::vector<std::string> longer = lines_of(run({"--count", "5", "-o", "-"}).out);
    REQUIRE(longer.size() == 6);
    for (std::size_t i = 0; i < 4; ++i) CHECK(longer[i] == lines[i]);
  }

  TEST_CASE("a labelled stream carries labels and its truth counts its own polygons") {
    const Scratch scratch;
    const std::string truth = scratch.at("truth");
    const Result result = run({"--count", "2", "--labelled", "-o", "-", "--truth", truth.c_str()});
    REQUIRE(result.code == 0);
    CHECK(result.out.find("\"Window\"") != std::string::npos);
    const auto first = nlohmann::json::parse(read(fs::path(truth) / "house-000001.truth.json"));
    CHECK(first["objects"][0]["class"] == "other");
    CHECK(first["objects"][0]["faces"][0] == 0);
  }

  TEST_CASE("houses are written as CityGML of both versions beside the same truths") {
    const Scratch scratch;
    const std::string json = scratch.at("json");
    REQUIRE(run({"--count", "2", "-o", json.c_str()}).code == 0);
    for (const auto& [format, space] :
         {std::pair("citygml", "\"http://www.opengis.net/citygml/2.0\""),
          std::pair("citygml3", "\"http://www.opengis.net/citygml/3.0\"")}) {
      const std::string folder = scratch.at(format);
      REQUIRE(run({"--count", "2", "--format", format, "-o", folder.c_str()}).code == 0);
      CHECK(std::distance(fs::directory_iterator(folder), {}) == 6);
      const std::string labelled = read(fs::path(folder) / "house-000001.labelled.gml");
      CHECK(labelled.find(space) != std::string::npos);
      CHECK(labelled.find("WallSurface") != std::string::npos);
      const std::string stripped = read(fs::path(folder) / "house-000001.stripped.gml");
      CHECK(stripped.find("WallSurface") == std::string::npos);
      const char* truth = "house-000002.truth.json";
      CHECK(read(fs::path(folder) / truth) == read(fs::path(json) / truth));
    }
  }

  TEST_CASE("all houses go into one CityGML file and their truths beside it") {
    const Scratch scratch;
    const std::string file = scratch.at("town.gml"), truth = scratch.at("truth.jsonl");
    REQUIRE(run({"--count", "3", "-o", file.c_str(), "--truth", truth.c_str()}).code == 0);
    const std::string text = read(file);
    CHECK(text.find("gml:id=\"house-000003\"") != std::string::npos);
    CHECK(text.ends_with("</CityModel>\n"));
    CHECK(lines_of(read(truth)).size() == 3);
  }

  TEST_CASE("an unwritable output ends with 6 and leaves nothing behind") {
    const Scratch scratch;
    std::ofstream(scratch.path / "file") << "in the way";
    const std::string folder = scratch.at("file/folder"), stream = scratch.at("no/x.city.jsonl");
    for (const std::string& output : {folder, stream}) {
      const Result result = run({"-o", output.c_str()});
      CHECK(result.code == 6);
      CHECK(result.err.find("cannot") != std::string::npos);
    }
    CHECK(std::distance(fs::directory_iterator(scratch.path), {}) == 1);
  }

  TEST_CASE("options change what they name") {
    const std::string plain = run({"-o", "-"}).out;
    for (const char* option : {"--jitter=0.2", "--noise=1", "--triangulate", "--rotate=10",
                               "--origin=604000,5403766,370", "--roof=hip", "--storeys=7",
                               "--width=20", "--windows=50", "--flush=1", "--seed=2"}) {
      const Result result = run({"-o", "-", option});
      CHECK(result.code == 0);
      CHECK_MESSAGE(result.out != plain, option);
    }
  }

  TEST_CASE("English houses refuse the options that describe a continental one") {
    for (const char* option : {"--roof=hip", "--storeys=2", "--width=10", "--depth=10",
                               "--features=window", "--chimney=ridge", "--windows=50"}) {
      const Result result = run({"-o", "-", "--style", "english", option});
      INFO(result.err);
      CHECK(result.code == 2);
      CHECK(result.err.find("is for --style continental") != std::string::npos);
      CHECK(result.out.empty());
    }
  }

  TEST_CASE("options change English houses as they change others") {
    const std::string plain = run({"-o", "-", "--style", "english"}).out;
    CHECK(run({"-o", "-", "--style", "english"}).out == plain);
    CHECK(run({"-o", "-", "--style", "continental"}).out == run({"-o", "-"}).out);
    for (const char* option : {"--jitter=0.2", "--noise=1", "--triangulate", "--rotate=10",
                               "--origin=604000,5403766,370", "--flush=1", "--seed=2"}) {
      const Result result = run({"-o", "-", "--style", "english", option});
      CHECK(result.code == 0);
      CHECK_MESSAGE(result.out != plain, option);
    }
  }

  TEST_CASE("each place for chimneys makes another house") {
    std::set<std::string> houses;
    for (const char* place : {"slope", "ridge", "apex"})
      houses.insert(run({"-o", "-", "--roof", "hip", "--width", "14", "--depth", "8", "--features",
                         "window,chimney", "--chimney", place})
                        .out);
    CHECK(houses.size() == 3);
  }
}

}  // namespace
}  // namespace oriel::generator
