#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

const std::string kHouse =
    std::string(ORIEL_SOURCE_DIR) + "/examples/samples/house.stripped.city.json";

std::vector<json> objects_of(const std::string& text) {
  std::vector<json> objects;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) objects.push_back(json::parse(line));
  return objects;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("stages of a run are logged at level info and the result is the same") {
    const Outcome quiet = run({"label", kHouse}),
                  info = run({"label", kHouse, "--log-level", "info"});
    CHECK(quiet.out == info.out);
    CHECK_FALSE(quiet.says("stage"));
    CHECK(info.says("[info] oriel: stage segment: buildings=1 set_aside=0 ms="));
    CHECK(info.says("1 of 1 building labelled"));
  }

  TEST_CASE("at level debug there is a line for each stage of a building") {
    const auto has_lines = [](const Outcome& outcome, const std::vector<std::string>& starts) {
      for (const std::string& start : starts)
        CHECK_MESSAGE(outcome.says("[debug] oriel: " + start), start);
    };
    const Folder folder;
    has_lines(run({"generalise", kHouse, "--scale", "1:5000", "-o", folder / "coarse.city.json",
                   "--log-level", "debug"}),
              {"solidified: building=", "segmented: building=", "described: building=",
               "interpreted: building=", "named surfaces: building=", "generalised: building=",
               "written: record="});
    has_lines(run({"repair", kHouse, "-o", folder / "solid.city.json", "--log-level", "debug"}),
              {"solidified: building=", "repaired: building=", "written: record="});
    has_lines(run({"generalise", kHouse, "--series", "1:500,1:2000", "-o", folder / "house",
                   "--log-level", "debug"}),
              {"drawn at all scales: building=", "written: record="});
  }

  TEST_CASE("with level off stderr is empty and the exit code says what happened") {
    const Outcome missing = run({"label", "no-such-file.city.json", "--log-level", "off"});
    CHECK(missing.exit == 5);
    CHECK(missing.err.empty());
  }

  TEST_CASE("with level error summaries and warnings are not logged") {
    const Outcome missing = run({"label", "no-such-file.city.json", "--log-level", "error"});
    CHECK(missing.err ==
          "error: no-such-file.city.json: E101 cannot be read: No such file or directory; "
          "expected an existing file or folder\n");
  }

  TEST_CASE("with log-json every line of stderr is an object with time and level and logger") {
    const Outcome missing =
        run({"label", "no-such-file.city.json", kHouse, "-o", "/dev/null/", "--log-json"});
    for (const json& line : objects_of(missing.err))
      for (const char* name : {"time", "level", "logger", "message"}) CHECK(line.contains(name));
    const std::vector<json> lines =
        objects_of(run({"label", "no-such-file.city.json", "--log-json"}).err);
    REQUIRE(lines.size() == 2);
    CHECK(lines[0]["level"] == "error");
    CHECK(lines[0]["code"] == "E101");
    CHECK(lines[0]["file"] == "no-such-file.city.json");
    CHECK(lines[1]["logger"] == "run");
    CHECK(lines[1]["message"] == "0 of 0 buildings labelled");
  }

  TEST_CASE("progress as JSON goes through the same log") {
    const std::vector<json> lines =
        objects_of(run({"label", kHouse, "--progress", "json", "--log-json"}).err);
    REQUIRE(lines.size() == 2);
    CHECK(lines[0]["logger"] == "progress");
    CHECK(lines[0]["is_done"] == true);
  }

  TEST_CASE("every command takes the options of logging") {
    CHECK(run({"rules", "check", "residential", "--log-level", "debug"}).exit == 0);
    CHECK(run({"validate", kHouse, "--log-json"}).exit == 0);
    const Folder folder;
    CHECK(run({"split", kHouse, "--count", "1", "-o", folder / "shards", "--log-json"}).exit == 0);
    CHECK(run({"label", kHouse, "--log-level", "loud"}).exit == 2);
  }
}
