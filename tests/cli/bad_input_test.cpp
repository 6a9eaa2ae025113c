#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace oriel::test;

namespace {

using Names = std::vector<std::string>;

/// Labels one bad file and expects that it costs the whole input: exit 5, the place and code, and
/// nothing beside the input.
void check_unreadable(const std::string& name, const std::string& bytes,
                      const std::string& message) {
  const Folder folder;
  const std::string input = folder.write(name, bytes);
  const Outcome outcome =
      run({"label", input, "-o", folder / "out.city.json", "--features", folder / "parts.csv"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit == 5);
  CHECK(outcome.says("error: " + input + message));
  CHECK(outcome.out.empty());
  CHECK(folder.names() == Names{name});
}

/// Labels a file with one bad building "b" among good ones: exit 3, the building and code, and the
/// good ones in a whole output.
void check_set_aside(const std::string& bytes, const std::string& message) {
  const Folder folder;
  const std::string input = folder.write("in.city.json", bytes);
  const Outcome outcome = run({"label", input, "-o", folder / "out.city.json"});
  CAPTURE(outcome.err);
  CHECK(outcome.exit == 3);
  CHECK(outcome.says(message));
  CHECK(outcome.says("2 of 3 buildings labelled; 1 rejected"));
  CHECK(folder.names() == Names{"in.city.json", "out.city.json"});
  const auto city = nlohmann::json::parse(bytes_of(folder / "out.city.json"));
  CHECK(city["CityObjects"]["a"]["attributes"].contains("oriel_pack"));
  CHECK(!city["CityObjects"]["b"].contains("attributes"));
  CHECK(city["CityObjects"]["c"]["attributes"].contains("oriel_pack"));
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a missing file is an unreadable input") {
    const Folder folder;
    const Outcome outcome = run({"label", folder / "no.city.json", "-o", folder / "out.city.json"});
    CHECK(outcome.exit == 5);
    CHECK(outcome.says("no.city.json: E101 cannot be read: No such file"));
    CHECK(folder.names().empty());
  }

  TEST_CASE("an empty file is an unreadable input") {
    check_unreadable("in.city.json", "", ": E102 ");
  }

  TEST_CASE("truncated JSON is an unreadable input and its end is the place") {
    const std::string text = cubes({"a", "b"}).dump();
    const std::string half = text.substr(0, text.size() / 2);
    check_unreadable("in.city.json", half, fmt::format(":1:{}: E105 ", half.size() + 1));
  }

  TEST_CASE("a byte that is not UTF-8 is an unreadable input and the byte is the place") {
    const std::string text = replaced(cubes({"a"}).dump(), "\"a\"", "\"\x80\"");
    const auto column = text.find('\x80') + 1;
    check_unreadable("in.city.json", text,
                     fmt::format(":1:{}: E103 byte 0x80 is not UTF-8", column));
  }

  TEST_CASE("an image named CityJSON is an unreadable input") {
    check_unreadable("in.city.json", "\x89PNG\r\n\x1a\nIHDR", ":1:1: E107 looks like a PNG image");
  }

  TEST_CASE("an OBJ file named CityJSON is an unreadable input") {
    check_unreadable("in.city.json", "v 0 0 0\nv 1 0 0\n", ":1:1: E107 starts with 'v 0 0 0");
  }

  TEST_CASE("a name without a known extension is an unreadable input") {
    check_unreadable("in.xyz", cubes({"a"}).dump(), ": E106 the format is unknown");
  }

  TEST_CASE("NaN and Infinity are no JSON and they are the place") {
    for (const std::string value : {"NaN", "Infinity"}) {
      const std::string text = replaced(cubes({"a"}).dump(), "[4000,", "[" + value + ",");
      const auto column = text.find(value) + 1;
      check_unreadable("in.city.json", text, fmt::format(":1:{}: E104 not valid JSON", column));
    }
  }

  TEST_CASE("a number beyond a double is an unreadable input") {
    check_unreadable("in.city.json", replaced(cubes({"a"}).dump(), "[4000,", "[1e999,"), ":1:");
  }

  TEST_CASE("a building with huge coordinates is set aside") {
    auto city = cubes({"a", "b", "c"});
    city["vertices"][8][0] = 4'000'000'000'000'000;
    check_set_aside(city.dump(), "in.city.json: b: E506 a vertex has the coordinate 40000000");
  }

  TEST_CASE("a building with a vertex number out of range is set aside") {
    auto city = cubes({"a", "b", "c"});
    city["CityObjects"]["b"]["geometry"][0]["boundaries"][0][2][0][1] = 99;
    check_set_aside(city.dump(), "in.city.json: b: E203 polygon 2 uses vertex 99; there are 24");
  }

  TEST_CASE("a building larger than the exact range is set aside") {
    auto city = cubes({"a", "b", "c"});
    city["vertices"][8][0] = 9'000'000;
    check_set_aside(city.dump(), "b: E501 the building is ");
  }

  TEST_CASE("a building that is not closed is labelled as open and not generalised") {
    auto city = cubes({"a", "b", "c"});
    city["CityObjects"]["b"]["geometry"][0]["boundaries"][0].erase(1);
    const Folder folder;
    const std::string input = folder.write("in.city.json", city.dump());
    const Outcome labelled = run({"label", input, "-o", folder / "out.city.json"});
    CHECK(labelled.exit == 0);
    CHECK(labelled.says("warning: b: E302 not closed: 4 open edges"));
    CHECK(labelled.says("3 of 3 buildings labelled; 1 open"));
    const auto out = nlohmann::json::parse(bytes_of(folder / "out.city.json"));
    CHECK(out["CityObjects"]["b"]["attributes"].contains("oriel_pack"));
    const Outcome redrawn =
        run({"generalise", input, "--scale", "1:1000", "-o", folder / "small.city.json"});
    CHECK(redrawn.exit == 3);
    CHECK(redrawn.says("error: b: G404 "));
    CHECK(redrawn.says("2 of 3 buildings generalised to 1:1000"));
    const auto small = nlohmann::json::parse(bytes_of(folder / "small.city.json"));
    CHECK(small["CityObjects"]["b"] == nlohmann::json::parse(city.dump())["CityObjects"]["b"]);
  }

  TEST_CASE("a broken line of a CityJSONSeq costs that line") {
    const Folder folder;
    const std::string text = cube_lines({"a", "b", "c"});
    const auto at = text.find("\"id\":\"b\"");
    const std::string broken = text.substr(0, at) + text.substr(text.find('\n', at));
    const std::string input = folder.write("in.city.jsonl", broken);
    const Outcome outcome = run({"label", input, "-o", folder / "out.city.jsonl"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("error: " + input + ":3:"));
    CHECK(outcome.says("1 rejected"));
    const std::string out = bytes_of(folder / "out.city.jsonl");
    CHECK(std::ranges::count(out, '\n') == 3);
    CHECK(out.find("\"id\":\"a\"") != std::string::npos);
    CHECK(out.find("\"id\":\"c\"") != std::string::npos);
    CHECK(folder.names() == Names{"in.city.jsonl", "out.city.jsonl"});
  }

  TEST_CASE("a CityJSONSeq without a header is an unreadable input") {
    const std::string text = cube_lines({"a"});
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", text.substr(text.find('\n') + 1));
    const Outcome outcome = run({"label", input, "-o", folder / "out.city.jsonl"});
    CHECK(outcome.exit == 5);
    CHECK(outcome.says(input + ":1:"));
    CHECK(outcome.says("E107"));
    CHECK(folder.names() == Names{"in.city.jsonl"});
  }

  TEST_CASE("one unreadable file among several costs only itself") {
    const Folder folder;
    const std::string bad = folder.write("bad.city.json", "{");
    const std::string good = folder.write("good.city.json", cubes({"a"}).dump());
    for (const Names& inputs : {Names{folder / "no.city.json", bad, good}, Names{good, bad}}) {
      Names arguments{"label", "-o", folder / "out/", "--features", folder / "parts.jsonl"};
      arguments.insert(arguments.end(), inputs.begin(), inputs.end());
      const Outcome outcome = run(arguments);
      CHECK(outcome.exit == 5);
      CHECK(outcome.says(bad + ":1:2: E105"));
      CHECK(outcome.says("1 of 1 building labelled"));
      CHECK(bytes_of(folder / "out/good.city.json").find("oriel_pack") != std::string::npos);
      CHECK(!std::filesystem::exists(folder / "out/bad.city.json"));
      CHECK(std::filesystem::exists(folder / "parts.jsonl"));
      std::filesystem::remove_all(folder / "out");
    }
    const Outcome segmented = run({"segment", "--json", folder / "no.city.json", good});
    CHECK(segmented.exit == 5);
    CHECK(nlohmann::json::parse(segmented.out)["id"] == "a");
  }
}
