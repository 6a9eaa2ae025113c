#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <csignal>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace oriel::test;
using nlohmann::json;

namespace {

std::string piped(const std::vector<std::string>& arguments, const std::string& in, int exit = 0) {
  const Outcome outcome = run(arguments, {.in = in});
  CAPTURE(arguments[0]);
  CAPTURE(outcome.err);
  CHECK(outcome.exit == exit);
  return outcome.out;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("cat label generalise and collect work as one pipe") {
    const Folder folder;
    const std::string out = folder / "out.city.json";
    const std::string oriel = std::string("'") + ORIEL_COMMAND + "'";
    const std::string pipe = fmt::format(
        "set -o pipefail; {0} cat '{1}' | {0} label - | {0} generalise - --scale 1:5000 | "
        "{0} collect - -o '{2}'",
        oriel, sample("house"), out);
    CHECK(std::system(("bash -c \"" + pipe + "\" 2>/dev/null").c_str()) == 0);
    const json city = json::parse(bytes_of(out));
    CHECK(city["type"] == "CityJSON");
    CHECK(city["CityObjects"]["house"]["attributes"].contains("oriel_pack"));
    CHECK(!city["vertices"].empty());
  }

  TEST_CASE("a file is taken apart by cat and put together by collect") {
    const std::string file = cubes({"a", "b", "c"}).dump();
    const std::string lines = piped({"cat", "-", "--from", "cityjson"}, file);
    REQUIRE(lines_of(lines).size() == 4);
    const std::string together = piped({"collect", "-"}, lines);
    CHECK(json::parse(together)["CityObjects"].size() == 3);
    CHECK(piped({"cat", "-", "--from", "cityjson"}, together) == lines);
    const std::vector<std::string> volumes{"segment", "-", "--from", "cityjson"};
    CHECK(piped(volumes, together, 3) == piped(volumes, file, 3));  // cubes have no features
  }

  TEST_CASE("a stream comes out of cat as it came") {
    const std::string lines = cube_lines({"a", "b"});
    CHECK(piped({"cat", "-"}, lines) == lines);
  }

  TEST_CASE("cat passes on what is selected") {
    const std::string lines = cube_lines({"a", "b", "c"}), file = cubes({"a", "b", "c"}).dump();
    const std::string of_lines = piped({"cat", "-", "--id", "b"}, lines),
                      of_file = piped({"cat", "-", "--from", "cityjson", "--id", "b"}, file);
    REQUIRE(lines_of(of_file).size() == 2);
    CHECK(json::parse(lines_of(of_file)[1])["id"] == "b");
    CHECK(lines_of(of_lines)[1] == lines_of(lines)[2]);
  }

  TEST_CASE("OBJ becomes a stream") {
    const Folder folder;
    REQUIRE(run({"label", sample("hip"), "-o", folder / "hip.obj"}).exit == 0);
    const auto lines = lines_of(run({"cat", folder / "hip.obj"}).out);
    REQUIRE(lines.size() == 2);
    CHECK(json::parse(lines[1])["CityObjects"].contains("hip"));
  }

  TEST_CASE("streams that were put together have one header if they had the same") {
    const std::string a = cube_lines({"a"}), b = cube_lines({"b"});
    CHECK(piped({"cat", "-"}, a + b) == cube_lines({"a", "b"}));
    const Folder folder;
    CHECK(run({"cat", folder.write("a.city.jsonl", a), folder.write("b.city.jsonl", b)}).out ==
          cube_lines({"a", "b"}));
  }

  TEST_CASE("features behind a header of another version or transform are set aside") {
    const std::string a = cube_lines({"a"}), b = cube_lines({"b"}), c = cube_lines({"c"});
    for (const auto& [from, to] :
         {std::pair{"\"2.0\"", "\"1.1\""}, std::pair{"[0,0,0]", "[5,0,0]"}}) {
      CAPTURE(to);
      const std::string in = a + replaced(b, from, to) + c;
      const Outcome outcome = run({"cat", "-"}, {.in = in});
      CHECK(outcome.exit == 3);
      CHECK(outcome.says("stdin:3: E116 is a header"));
      CHECK(outcome.says("b: E116 follows a header"));
      CHECK(outcome.out == cube_lines({"a", "c"}));
      const Folder folder;
      const Outcome files = run({"cat", folder.write("a.city.jsonl", a),
                                 folder.write("b.city.jsonl", replaced(b, from, to))});
      CHECK(files.exit == 5);
      CHECK(files.says("E116"));
    }
  }

  TEST_CASE("of features with one id the first is read") {
    const std::string lines = cube_lines({"a", "b", "a"});
    const Outcome outcome = run({"label", "-"}, {.in = lines});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("a: E207 an earlier line of the stream has this id"));
    CHECK(outcome.says("2 of 3 buildings labelled"));
    CHECK(lines_of(outcome.out).size() == 3);
  }

  TEST_CASE("a feature of another version than its header is set aside") {
    const std::string lines = replaced(cube_lines({"a"}), "\"CityJSONFeature\"",
                                       "\"CityJSONFeature\",\"version\":\"1.1\"");
    const Outcome outcome = run({"cat", "-"}, {.in = lines});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("a: E108 its 'version' is '1.1'; the header says \"2.0\""));
  }

  TEST_CASE("a stream without anything or without a header is no input") {
    for (const std::string command : {"cat", "collect", "label"}) {
      CHECK(run({command, "-"}, {.in = ""}).says("E102"));
      const std::string lines = cube_lines({"a"});
      const Outcome headless = run({command, "-"}, {.in = lines.substr(lines.find('\n') + 1)});
      CHECK(headless.exit == 5);
      CHECK(headless.says("E107"));
      CHECK(headless.out.empty());
    }
  }

  TEST_CASE("cat and collect end quietly when nobody reads any more") {
    std::vector<std::string> ids;
    for (int i = 0; i < 3000; ++i) ids.push_back(fmt::format("b{}", i));
    const std::string lines = cube_lines(ids);
    for (const std::string command : {"cat", "collect"}) {
      const Outcome outcome = run({command, "-"}, {.in = lines, .has_broken_pipe = true});
      CHECK(outcome.exit == 128 + SIGPIPE);
      CHECK(outcome.err.empty());
    }
  }

  TEST_CASE("generalise of a file needs an output") {
    CHECK(run({"generalise", sample("hip"), "--scale", "1:5000"}).exit == 2);
  }
}
