#include "tests/cli/command.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

std::string first_pack() {
  return bytes_of(std::string(ORIEL_SOURCE_DIR) + "/examples/first_pack.yaml");
}

/// The first pack, which does not emit its chimneys and dormers.
std::string without_emit(const Folder& folder, const std::string& more = "") {
  const std::string text = first_pack();
  return folder.write("mine.yaml", text.substr(0, text.find("emit:")) + more);
}

std::vector<std::string> warnings_of(const Outcome& outcome) {
  auto lines = lines_of(outcome.err);
  std::erase_if(lines, [](const std::string& line) { return line.find("R258") == line.npos; });
  return lines;
}

/// The warning of a class of `pack` that stands in that column of its third line.
std::string warning(const std::string& pack, int column, const std::string& features,
                    const std::string& label) {
  return fmt::format(
      "warning: {}:3:{}: R258 {} written without a type, a protrusion as a generic "
      "BuildingInstallation, anything else by the label of its surfaces: the class has no "
      "'emit'; add emit: "
      "{{{}: {{type: BuildingInstallation}}}}",
      pack, column, features, label);
}

std::size_t installations_in(const std::string& path) {
  std::size_t count = 0;
  const json city = json::parse(bytes_of(path));
  for (const json& object : city["CityObjects"])
    count += object["type"] == "BuildingInstallation" ? 1 : 0;
  return count;
}

/// By id, the label of every feature that surfaces and installations of the file name.
std::map<std::string, std::string> labels_in(const std::string& path) {
  std::map<std::string, std::string> labels;
  const auto add = [&](const json& members) {
    if (members.contains("oriel_id")) labels[members["oriel_id"]] = members["oriel_label"];
  };
  const json city = json::parse(bytes_of(path));
  for (const json& object : city["CityObjects"]) {
    if (object.contains("attributes")) add(object["attributes"]);
    for (const json& geometry : object["geometry"])
      if (geometry.contains("semantics"))
        for (const json& surface : geometry["semantics"]["surfaces"]) add(surface);
  }
  return labels;
}

/// Every labelled record is in the file by its label, but for those of which others have all
/// polygons.
void check_all_written(const std::map<std::string, std::string>& written,
                       const std::string& records) {
  std::set<int> owned;
  std::vector<json> lost;
  for (const std::string& line : lines_of(bytes_of(records))) {
    const json record = json::parse(line);
    const auto found = written.find(record["id"]);
    if (found == written.end()) {
      lost.push_back(record);
      continue;
    }
    CHECK(found->second == record["label"]);
    for (const json& polygon : record["source_polygons"]) owned.insert(polygon.get<int>());
  }
  CHECK(written.size() > 10 * lost.size());
  for (const json& record : lost)
    for (const json& polygon : record["source_polygons"]) CHECK(owned.contains(polygon.get<int>()));
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("features without a type are named once with their number and the place of the class") {
    const Folder folder;
    const std::string pack = without_emit(folder), out = folder / "out.city.json";
    const Outcome outcome = run({"label", sample("house"), "--rules", pack, "-o", out});
    CHECK(outcome.exit == 0);
    CHECK(warnings_of(outcome) ==
          std::vector<std::string>{
              warning(pack, 33, "1 feature with the label 'chimney' is", "chimney"),
              warning(pack, 46, "2 features with the label 'dormer' are", "dormer")});
    CHECK(outcome.says("classes: {window: {}, door: {}, chimney: {}, dormer: {}}\n"));
    CHECK(lines_of(outcome.err).back().starts_with("1 of 1 building labelled: "));
    CHECK(installations_in(out) == 3);
  }

  TEST_CASE("a file that is read again has all labels of classes that are not emitted") {
    const Folder folder;
    // Windows become panels and doors gates, of which no file of buildings knows.
    const std::string pack =
        folder.write("mine.yaml",
                     "schema: oriel/1\n"
                     "pack: {name: mine, version: 1.0.0}\n"
                     "classes: {panel: {}, gate: {}, stack: {}}\n"
                     "rules:\n"
                     "  - {id: p, label: panel, require: [sense = hole, base_height > 1 m]}\n"
                     "  - {id: g, label: gate, require: [sense = hole, base_height <= 1 m]}\n"
                     "  - {id: s, label: stack, require: sense = protrusion}\n");
    const std::string out = folder / "out.city.json", parts = folder / "parts.jsonl";
    const Outcome outcome =
        run({"label", sample("house"), "--rules", pack, "-o", out, "--features", parts});
    CHECK(outcome.exit == 0);
    CHECK(warnings_of(outcome).size() == 3);
    check_all_written(labels_in(out), parts);
    CHECK(run({"validate", out}).exit == 0);
    // What it writes is what it reads: nothing is added, and nothing goes.
    const std::string again = folder / "again.city.json";
    REQUIRE(run({"label", out, "--rules", pack, "-o", again}).exit == 0);
    CHECK(labels_in(again) == labels_in(out));
    CHECK(run({"view", out, "-o", folder / "page.html"}).exit == 0);
    const std::string page = bytes_of(folder / "page.html");
    for (const char* label : {"panel", "gate", "stack"})
      CHECK(page.find(label) != std::string::npos);
  }

  TEST_CASE("the first pack of the README emits all its labels") {
    const Folder folder;
    const std::string pack = folder.write("first.yaml", first_pack());
    const std::string out = folder / "out.city.json";
    const Outcome outcome = run({"label", sample("house"), "--rules", pack, "-o", out});
    CHECK(outcome.exit == 0);
    CHECK(warnings_of(outcome).empty());
    CHECK(installations_in(out) == 3);
    const Outcome checked = run({"rules", "check", pack});
    CHECK(checked.exit == 0);
    CHECK(checked.err.empty());
  }

  TEST_CASE("features without a type are counted over all buildings of a run") {
    const Folder folder;
    const std::string pack = without_emit(folder);
    const auto warned = [&](const std::vector<std::string>& more) {
      std::vector<std::string> arguments{"label", sample("house"), sample("house-flush"), "--rules",
                                         pack};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = run(arguments);
      CHECK(outcome.exit == 0);
      return warnings_of(outcome);
    };
    const auto once = warned({"-o", folder / "out/"});
    REQUIRE(once.size() == 2);
    CHECK(once[0] == warning(pack, 33, "2 features with the label 'chimney' are", "chimney"));
    CHECK(warned({"-o", folder / "out/", "-j", "2"}) == once);
    CHECK(warned({"-o", folder / "out/", "--isolate"}) == once);
    CHECK(warned({"-o", folder / "out/", "--repeat", "2"}) == once);
  }

  TEST_CASE("a run that writes no buildings or files without names warns of nothing") {
    const Folder folder;
    const std::string pack = without_emit(folder);
    const auto warned = [&](const std::vector<std::string>& more) {
      std::vector<std::string> arguments{"label", sample("house"), "--rules", pack};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return warnings_of(run(arguments)).size();
    };
    CHECK(warned({}) == 0);
    CHECK(warned({"--features", folder / "parts.csv"}) == 0);
    CHECK(warned({"-o", folder / "out.off"}) == 0);
    CHECK(warned({"-o", folder / "out.obj"}) == 2);
    CHECK(warned({"-o", "-", "--to", "cityjson"}) == 2);
  }

  TEST_CASE("generalise counts the features that stay") {
    const Folder folder;
    const std::string pack = without_emit(
        folder, "generalise: [{id: c, scale: \"1:500 ..\", for: chimney, do: omit}]\n");
    const auto warned = [&](const std::vector<std::string>& more) {
      std::vector<std::string> arguments{"generalise", sample("house"), "--rules", pack};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = run(arguments);
      CHECK(outcome.exit == 0);
      return warnings_of(outcome);
    };
    const std::string dormers =
        warning(pack, 46, "2 features with the label 'dormer' are", "dormer");
    CHECK(warned({"--scale", "1:1000", "-o", folder / "out.city.json"}) ==
          std::vector<std::string>{dormers});
    CHECK(warned({"--scale", "1:1000", "--isolate", "-o", folder / "out.city.json"}) ==
          std::vector<std::string>{dormers});
    // A series has all features at its largest scale, or above it.
    CHECK(warned({"--series", "1:100,1:1000", "-o", folder / "house"}).size() == 2);
  }

  TEST_CASE("rules check notes labels without emit and passes") {
    const Folder folder;
    const std::string pack = without_emit(folder);
    const Outcome outcome = run({"rules", "check", pack});
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("note: " + pack + ":3:33: R258 a feature with the label 'chimney' is "));
    CHECK(outcome.says("note: " + pack + ":3:46: R258 a feature with the label 'dormer' is "));
    CHECK(run({"rules", "show", pack}).err.empty());
    folder.write("mine.test.yaml",
                 "tests_for: mine.yaml\n"
                 "fixtures: {front: {features: {w: {sense: hole, height: 1 m, host: wall}}}}\n"
                 "tests: [{name: a window, given: front, expect: {w: window}}]\n");
    const Outcome tested = run({"rules", "test", pack});
    CHECK(tested.exit == 0);
    CHECK(warnings_of(tested).empty());
    const auto findings = json::parse(run({"rules", "check", pack, "--json"}).out);
    REQUIRE(findings.size() == 2);
    CHECK(findings[0]["severity"] == "note");
    CHECK(findings[0]["code"] == "R258");
    CHECK(findings[0]["line"] == 3);
  }
}
