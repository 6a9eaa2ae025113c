#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <algorithm>
#include <set>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

/// What the schema of SARIF 2.1.0 requires of the parts that are written, and allows there.
void check_keys(const json& value, const std::set<std::string>& needed,
                const std::set<std::string>& allowed) {
  CAPTURE(value.dump());
  REQUIRE(value.is_object());
  for (const std::string& key : needed) CHECK_MESSAGE(value.contains(key), key);
  for (const auto& member : value.items())
    CHECK_MESSAGE((needed.contains(member.key()) || allowed.contains(member.key())), member.key());
}

void check_message(const json& message) {
  check_keys(message, {"text"}, {"markdown"});
  for (const auto& member : message.items()) CHECK(member.value().is_string());
}

void check_rule(const json& rule) {
  check_keys(rule, {"id", "shortDescription"}, {"help", "helpUri"});
  CHECK(rule["id"].is_string());
  check_message(rule["shortDescription"]);
  if (rule.contains("help")) check_message(rule["help"]);
  if (rule.contains("helpUri"))
    CHECK(rule["helpUri"].get<std::string>().find("://") != std::string::npos);
}

void check_location(const json& location) {
  check_keys(location, {}, {"physicalLocation", "logicalLocations"});
  if (location.contains("physicalLocation")) {
    const json& physical = location["physicalLocation"];
    check_keys(physical, {"artifactLocation"}, {"region"});
    check_keys(physical["artifactLocation"], {"uri"}, {});
    CHECK(physical["artifactLocation"]["uri"].get<std::string>().find(' ') == std::string::npos);
    if (physical.contains("region")) {
      check_keys(physical["region"], {"startLine"}, {"startColumn", "snippet"});
      CHECK(physical["region"]["startLine"] >= 1);
      if (physical["region"].contains("startColumn")) CHECK(physical["region"]["startColumn"] >= 1);
    }
  }
  if (location.contains("logicalLocations"))
    for (const json& logical : location["logicalLocations"])
      check_keys(logical, {"fullyQualifiedName"}, {"kind"});
}

/// The log, whose structure is that of the schema.
json checked_log(const std::string& path) {
  json log = json::parse(bytes_of(path));
  check_keys(log, {"version", "runs"}, {"$schema"});
  CHECK(log["version"] == "2.1.0");
  REQUIRE(log["runs"].size() == 1);
  const json& run = log["runs"][0];
  check_keys(run, {"tool", "results", "columnKind"}, {});
  check_keys(run["tool"], {"driver"}, {});
  check_keys(run["tool"]["driver"], {"name"}, {"semanticVersion", "rules"});
  const json& rules = run["tool"]["driver"]["rules"];
  std::set<std::string> ids;
  for (const json& rule : rules) {
    check_rule(rule);
    CHECK(ids.insert(rule["id"]).second);
  }
  const std::set<std::string> levels{"none", "note", "warning", "error"};
  for (const json& result : run["results"]) {
    check_keys(result, {"message"}, {"ruleId", "ruleIndex", "level", "locations"});
    check_message(result["message"]);
    CHECK(levels.contains(result["level"].get<std::string>()));
    CHECK(rules.at(result["ruleIndex"].get<std::size_t>())["id"] == result["ruleId"]);
    if (result.contains("locations"))
      for (const json& location : result["locations"]) check_location(location);
  }
  return log;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("rules check writes findings as SARIF with their places and help") {
    const Folder folder;
    const std::string pack =
        folder.write("a pack.yaml",
                     "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}}\n"
                     "params: {low: {value: 1 m, rangee: 0 m .. 2 m}}\n"
                     "rules: [{id: w, label: window, require: heigth > 1 m}]\n");
    const std::string file = folder / "log.sarif";
    CHECK(run({"rules", "check", pack, "--sarif", file}).exit == 4);
    const json log = checked_log(file);
    const json& run_of = log["runs"][0];
    REQUIRE(run_of["results"].size() == 2);
    const auto result = std::ranges::find_if(
        run_of["results"], [](const json& one) { return one["ruleId"] == "R204"; });
    REQUIRE(result != run_of["results"].end());
    CHECK((*result)["level"] == "error");
    CHECK((*result)["message"]["text"] == "unknown attribute 'heigth'; did you mean 'height'?");
    const json& physical = (*result)["locations"][0]["physicalLocation"];
    CHECK(physical["artifactLocation"]["uri"].get<std::string>().ends_with("a%20pack.yaml"));
    CHECK(physical["region"]["startLine"] == 5);
    CHECK(physical["region"]["startColumn"] == 41);
    const json& rule = run_of["tool"]["driver"]["rules"][(*result)["ruleIndex"].get<std::size_t>()];
    CHECK(rule["shortDescription"]["text"] == "Unknown attribute");
    CHECK(rule["helpUri"].get<std::string>().ends_with("/rules.md#r204-unknown-attribute"));
    CHECK(rule["help"]["text"].get<std::string>().size() > 40);
    CHECK(run({"rules", "check", pack, "--sarif", pack}).exit == 2);
  }

  TEST_CASE("columns of a SARIF log are characters, and it says so") {
    const Folder folder;
    const std::string pack = folder.write(
        "pack.yaml",
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}}\n"
        "rules: [{id: w, label: window, why: \"ä \xF0\x9F\x8F\xA0\", require: heigth > 1 m}]\n");
    const std::string file = folder / "log.sarif";
    CHECK(run({"rules", "check", pack, "--sarif", file}).exit == 4);
    const json log = checked_log(file);
    CHECK(log["runs"][0]["columnKind"] == "unicodeCodePoints");
    for (const json& result : log["runs"][0]["results"])
      if (result["ruleId"] == "R204")
        CHECK(result["locations"][0]["physicalLocation"]["region"]["startColumn"] == 53);
  }

  TEST_CASE("a run without findings is a SARIF log without results") {
    const Folder folder;
    const std::string file = folder / "log.sarif";
    CHECK(run({"rules", "check", "residential", "--sarif", file}).exit == 0);
    CHECK(checked_log(file)["runs"][0]["results"].empty());
    CHECK(run({"validate", sample("house"), "--sarif", file}).exit == 0);
    CHECK(checked_log(file)["runs"][0]["results"].empty());
  }

  TEST_CASE("validate writes what is wrong with each building as SARIF") {
    const Folder folder;
    auto city = cubes({"a", "b"});
    for (const char* id : {"a", "b"})
      city["CityObjects"][id]["geometry"][0]["boundaries"][0].erase(0);
    const std::string input = folder.write("two.city.json", city.dump());
    const std::string file = folder / "log.sarif";
    const Outcome outcome = run({"validate", input, "--sarif", file});
    CHECK(outcome.exit == 3);
    const json log = checked_log(file);
    std::set<std::string> buildings;
    for (const json& result : log["runs"][0]["results"]) {
      CHECK(result["level"] == "error");
      CHECK(result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
                .get<std::string>()
                .ends_with("two.city.json"));
      buildings.insert(result["locations"][0]["logicalLocations"][0]["fullyQualifiedName"]);
    }
    CHECK(buildings == std::set<std::string>{"a", "b"});
  }
}
