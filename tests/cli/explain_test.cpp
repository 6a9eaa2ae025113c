#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

/// The ids of the features of a sample that have `label`.
std::vector<std::string> ids_of(const std::string& name, const std::string& label) {
  const Folder folder;
  CHECK(run({"label", sample(name), "--features", folder / "parts.json"}).exit == 0);
  std::vector<std::string> ids;
  for (const json& record : json::parse(bytes_of(folder / "parts.json")))
    if (record["label"] == label) ids.push_back(record["id"]);
  return ids;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("explain shows the conditions of a feature") {
    const auto chimneys = ids_of("house", "chimney");
    REQUIRE(chimneys.size() == 1);
    const Outcome outcome = run({"explain", sample("house"), chimneys[0]});
    CHECK(outcome.exit == 0);
    CHECK(outcome.out.starts_with(chimneys[0] + " -> chimney 1.00 by chimney.tall"));
    CHECK(outcome.out.find("dormer.with_window") != std::string::npos);
    CHECK(outcome.out.find("residential.yaml:") != std::string::npos);
    CHECK(outcome.err.empty());
  }

  TEST_CASE("the beginning of an id is enough") {
    const std::string id = ids_of("house", "chimney").at(0);
    const Outcome whole = run({"explain", sample("house"), id});
    CHECK(run({"explain", sample("house"), id.substr(0, 8)}).out == whole.out);
  }

  TEST_CASE("explain --json is one JSON object") {
    const std::string id = ids_of("house", "chimney").at(0);
    const Outcome outcome = run({"explain", sample("house"), id, "--json"});
    CHECK(outcome.exit == 0);
    const json explanation = json::parse(outcome.out);
    CHECK(explanation["feature"] == id);
    CHECK(explanation["label"] == "chimney");
    CHECK(explanation["rules"].size() > 10);
    CHECK(outcome.out.ends_with("}\n"));
  }

  TEST_CASE("a beginning that fits several features names them") {
    const Outcome outcome = run({"explain", sample("house"), "f"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.says("'f' names 53 features; it may be f"));
    CHECK(outcome.says("..."));
    CHECK(outcome.out.empty());
  }

  TEST_CASE("an unknown id is answered with ids there are") {
    const Outcome outcome = run({"explain", sample("house"), "nothing"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.says("'nothing' names 0 features; there are f"));
    CHECK(outcome.out.empty());
  }

  TEST_CASE("explain of an unreadable file is about the file") {
    const Outcome outcome = run({"explain", "no.city.json", "f1"});
    CHECK(outcome.exit == 5);
    CHECK(outcome.says("no.city.json: E101"));
    CHECK(!outcome.says("names 0 features"));
  }

  TEST_CASE("explain of a building that is set aside says why it is, not that it has no features") {
    auto city = cubes({"far"});
    city["vertices"][0][0] = 9'000'000;
    const Folder folder;
    const Outcome outcome = run({"explain", folder.write("far.city.json", city.dump()), "f1"});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("far: E501"));
    CHECK(!outcome.says("names 0 features"));
    CHECK(outcome.out.empty());
  }

  TEST_CASE("explain of a building without features says that there are none") {
    const Folder folder;
    const std::string cube = folder.write("cube.city.json", cubes({"cube"}).dump());
    const Outcome outcome = run({"explain", cube, "f1"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.says("'f1' names 0 features; there are none"));
  }
}
