#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

using Ids = std::vector<std::string>;

/// Cubes whose first ring begins with a vertex twice: E312.
std::string doubled(const Ids& ids) {
  nlohmann::json city = cubes(ids);
  for (const std::string& id : ids) {
    auto& ring = city["CityObjects"][id]["geometry"][0]["boundaries"][0][0][0];
    ring.insert(ring.begin(), ring[0]);
  }
  return city.dump();
}

long count_of(const std::string& text, const std::string& word) {
  long count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++count;
  return count;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a warning about several buildings is one line with their number and an example") {
    const Folder folder;
    const std::string city = folder.write("c.city.json", doubled({"a", "b", "c"}));
    const Outcome outcome = run({"label", city, "-o", folder / "o.city.json"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit == 0);
    CHECK(count_of(outcome.err, "E312") == 1);
    CHECK(outcome.says("warning: E312 in 3 buildings, for example " + city +
                       ": a: a ring names a vertex twice in a row"));
    CHECK(outcome.says("--verbose lists all"));
  }

  TEST_CASE("verbose and JSON list every warning") {
    const Folder folder;
    const std::string city = folder.write("c.city.json", doubled({"a", "b", "c"}));
    for (const std::string option : {"--verbose", "--log-json"})
      CHECK(count_of(run({"label", city, "-o", folder / "o.city.json", option}).err, "E312") == 3);
  }

  TEST_CASE("warnings about one building stay as they are") {
    const Folder folder;
    const std::string city = folder.write("c.city.json", doubled({"a"}));
    const Outcome outcome = run({"label", city, "-o", folder / "o.city.json"});
    CHECK(count_of(outcome.err, "E312") == 1);
    CHECK(!outcome.says("for example"));
    CHECK(!outcome.says("--verbose"));
  }

  TEST_CASE("of many errors of a code the first are listed and the others are counted") {
    const Folder folder;
    std::string lines = cube_lines({"a", "b", "c", "d", "e", "f", "g", "h"});
    for (std::size_t at = lines.find("[0,0,0]"); at != std::string::npos;
         at = lines.find("[0,0,0]", at))
      lines.replace(at, 7, "[9000000000000000,0,0]");
    const std::string stream = folder.write("c.city.jsonl", lines);
    const Outcome outcome =
        run({"label", stream, "-o", folder / "o.city.jsonl", "--status", folder / "s"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("3 more of this kind, in 8 buildings altogether"));
    CHECK(lines_of(bytes_of(folder / "s.quarantine.jsonl")).size() == 8);
  }
}
