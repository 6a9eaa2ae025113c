#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

using Words = std::vector<std::string>;

/// Every command that works on buildings, with its outputs in the folder.
std::vector<Words> commands_on_buildings(const Folder& folder) {
  return {{"segment"},
          {"label"},
          {"label", "-o", folder / "labelled.city.json"},
          {"generalise", "--scale", "1:1000", "-o", folder / "small.city.json"},
          {"generalise", "--series", "1:500,1:2000", "-o", folder / "series"},
          {"repair", "-o", folder / "repaired.city.json"},
          {"validate"},
          {"cat", "-o", folder / "cat.city.jsonl"},
          {"split", "--count", "1", "-o", folder / "shards"},
          {"view", "-o", folder / "page.html"}};
}

/// `code` on stderr and the exit code; the page of `view` needs a building.
void check_empty(Words command, const Words& more, const std::string& code, int exit) {
  command.insert(command.end(), more.begin(), more.end());
  const Outcome outcome = run(command);
  CAPTURE(command);
  CAPTURE(outcome.err);
  CHECK(outcome.says(code));
  CHECK(outcome.exit == (command[0] == "view" ? 5 : exit));
}

TEST_SUITE("cli") {
  TEST_CASE("every command says that an input is empty") {
    const Folder folder;
    const std::string empty = folder.write("empty.city.json", "");
    for (const Words& command : commands_on_buildings(folder))
      check_empty(command, {empty}, "E102", 5);
  }

  TEST_CASE("every command says that there is no building to work on") {
    const Folder folder;
    const std::string none = folder.write("none.city.json", cubes({}).dump());
    for (const Words& command : commands_on_buildings(folder))
      check_empty(command, {none}, "E134", 3);
    check_empty({"score", "--surfaces"}, {none}, "E134", 3);
    check_empty({"collect"}, {folder.write("none.city.jsonl", cube_lines({}))}, "E134", 3);
    CHECK(run({"explain", none, "f"}).exit == 3);
  }

  TEST_CASE("segment --tree says of an open building that it has no tree") {
    const Folder folder;
    auto city = cubes({"a", "b"});
    city["CityObjects"]["a"]["geometry"][0]["boundaries"][0].erase(1);  // its roof
    const std::string in = folder.write("open.city.json", city.dump());
    CHECK(run({"segment", in, "--json"}).exit == 0);
    for (const Words& more : std::vector<Words>{{}, {"--json"}}) {
      Words arguments{"segment", in, "--tree"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = run(arguments);
      CAPTURE(outcome.err);
      CHECK(outcome.exit == 3);
      CHECK(outcome.says("error: a: E302 has no tree"));
      CHECK(outcome.says("1 rejected (E302 1)"));
      CHECK(outcome.out.find("b") != std::string::npos);
    }
    CHECK(run({"segment", in, "--tree", "--close", "any"}).exit == 0);
  }

  TEST_CASE("buildings without any feature are reported with their number") {
    const Folder folder;
    const std::string in = folder.write("in.city.jsonl", cube_lines({"a", "b"}));
    const std::string said = "warning: " + in +
                             ": E134 no feature was found in 2 buildings: nothing stands out of "
                             "their walls and roofs or is cut into them\n";
    // Surfaces, cells and trees are a result, too; a list without features is none.
    const std::vector<std::pair<Words, int>> calls{
        {{"label", in}, 3},
        {{"label", in, "--features", folder / "parts.csv"}, 3},
        {{"label", in, "-o", folder / "out.city.jsonl"}, 0},
        {{"label", in, "-o", folder / "out.city.jsonl", "-j", "2"}, 0},
        {{"label", in, "-o", folder / "out.city.jsonl", "--isolate"}, 0},
        {{"segment", in}, 3},
        {{"segment", in, "--features", folder / "parts.csv"}, 3},
        {{"segment", in, "--json"}, 0},
        {{"segment", in, "--tree"}, 0}};
    for (const auto& [call, code] : calls) {
      const Outcome outcome = run(call);
      CAPTURE(call);
      CAPTURE(outcome.err);
      CHECK(outcome.exit == code);
      CHECK(outcome.says(said));
    }
    CHECK(run({"label", in, "--allow-bad", "100%"}).exit == 3);
    CHECK_FALSE(run({"label", in, "--rules", "surfaces-only"}).says("E134"));
    CHECK_FALSE(run({"generalise", in, "--scale", "1:1000", "-o", folder / "small.city.jsonl"})
                    .says("E134"));
  }

  TEST_CASE("of buildings with and without features the summary says how many have none") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    for (const std::string command : {"label", "segment"}) {
      const Outcome outcome = run({command, in, sample("house")});
      CAPTURE(outcome.err);
      CHECK(outcome.exit == 0);
      CHECK_FALSE(outcome.says("E134"));
      CHECK(outcome.says("; 1 without features\n"));
      CHECK_FALSE(run({command, sample("house")}).says("without features"));
    }
  }

  TEST_CASE("every command says that an id or a place selects nothing") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a", "b"}).dump());
    for (const Words& command : commands_on_buildings(folder)) {
      check_empty(command, {in, "--id", "nosuch"}, "nosuch: E130", 3);
      check_empty(command, {in, "--bbox", "900,900,901,901"}, "E130", 3);
      check_empty(command, {in, "--cotype", "Road"}, "E130", 3);
    }
    check_empty({"collect"}, {in, "--id", "nosuch"}, "E130", 3);
  }

  TEST_CASE("of several ids those that are not there are named and the others are done") {
    const Folder folder;
    const std::string in = folder.write("in.city.jsonl", cube_lines({"a", "b", "c"}));
    for (const Words& how : std::vector<Words>{{}, {"-j", "2"}, {"--isolate"}}) {
      Words command{"label", in,     "--id", "a",  "--id",
                    "x",     "--id", "c",    "-o", folder / "out.city.jsonl"};
      command.insert(command.end(), how.begin(), how.end());
      const Outcome outcome = run(command);
      CAPTURE(outcome.err);
      CHECK(outcome.exit == 3);
      CHECK(outcome.says("x: E130"));
      CHECK_FALSE(outcome.says("a: E130"));
      CHECK_FALSE(outcome.says("c: E130"));
      CHECK(lines_of(bytes_of(folder / "out.city.jsonl")).size() == 3);
    }
    CHECK(run({"validate", in, "--id", "a", "--id", "x"}).says("x: E130"));
  }

  TEST_CASE("buildings that may be rejected do not excuse an empty result") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    CHECK(run({"label", in, "--id", "x", "--allow-bad", "100%"}).exit == 3);
  }

  TEST_CASE("a selection that takes what is there is clean") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a", "b"}).dump());
    const std::string out = folder / "out.city.json";
    CHECK(run({"label", in, "--id", "a", "-o", out}).exit == 0);
    CHECK(run({"label", in, "--id", "a", "--exclude", "-o", out}).exit == 0);
    CHECK(run({"label", in, "--id", "x", "--exclude", "-o", out}).exit == 3);
    auto roads = cubes({"a", "r"});
    roads["CityObjects"]["r"]["type"] = "Road";
    const std::string city = folder.write("roads.city.json", roads.dump());
    CHECK(run({"cat", city, "--cotype", "Road"}).exit == 0);
  }

  TEST_CASE("surfaces without names are not taken for surfaces that agree") {
    const std::string said =
        "E131 no polygon of 1 building has a name (semantics) in the input: nothing is compared\n";
    check_empty({"score", "--surfaces"}, {sample("house")}, said, 3);
    check_empty({"label", "--existing", "audit"}, {sample("house")}, said, 3);
    const std::string named = replaced(sample("house"), ".stripped.", ".labelled.");
    CHECK(run({"score", "--surfaces", named}).exit == 0);
  }

  TEST_CASE("records and truth without matches are no clean result") {
    const Folder folder;
    const std::string head = folder.write("head.csv", "building,id\n");
    check_empty({"interpret"}, {head}, "E134", 3);
    check_empty({"diff"}, {head, head}, "E134", 3);
    const std::string in = sample("house"), parts = folder / "parts.jsonl";
    REQUIRE(run({"label", in, "--features", parts}).exit == 0);
    const std::string truth = in.substr(0, in.find(".stripped")) + ".truth.json";
    CHECK(run({"score", parts, "--truth", truth}).exit == 0);
    const std::string other = sample("block");
    check_empty({"score", parts, "--truth"},
                {other.substr(0, other.find(".stripped")) + ".truth.json"},
                "E131 no building of the truth has a record: block", 3);
    check_empty({"score", folder.write("empty.csv", "building,id\n"), "--truth"}, {truth},
                "E131 no building of the truth has a record: house; there are no records\n", 3);
    const Outcome areas = run({"score", parts, "--truth", truth, "--models", other});
    CHECK(areas.says("E131 no building of the models is in the truth: no area is compared\n"));
    CHECK(areas.exit == 3);
    const Outcome some = run({"score", parts, "--truth", truth, "--truth",
                              other.substr(0, other.find(".stripped")) + ".truth.json"});
    CHECK(some.says("1 of 2 buildings of the truth has no record"));
    CHECK(some.exit == 3);
  }
}

}  // namespace
