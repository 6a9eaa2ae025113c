#include "examples/generator/addition.h"
#include "examples/generator/generate.h"
#include "examples/generator/output/cityjson.h"
#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/studio/session/recorded_page.h"

#include <fstream>
#include <map>
#include <set>

#include <doctest/doctest.h>
#include <fmt/format.h>
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

/// The replies in a page that view has written.
json page_data(const std::string& path) {
  const std::string page = bytes_of(path);
  const std::string mark = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = page.find(mark) + mark.size();
  return replies_of(page.substr(begin, page.find("</script>", begin) - begin));
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("explain shows the conditions of a feature") {
    const auto chimneys = ids_of("house", "chimney");
    REQUIRE(chimneys.size() == 1);
    const Outcome outcome = run({"explain", sample("house"), chimneys[0]});
    CHECK(outcome.exit == 0);
    CHECK(outcome.out.starts_with("chimney 1 of roof slope north (" + chimneys[0] +
                                  ") is labelled chimney by chimney.tall with score 1.00; no rule "
                                  "for another label holds.\nwinner "));
    CHECK(outcome.out.find("\nnearest miss  ") != std::string::npos);
    CHECK(outcome.out.find("\nsmallest flip  ") != std::string::npos);
    CHECK(outcome.out.find("residential.yaml:") != std::string::npos);
    CHECK(lines_of(outcome.out).size() <= 20);
    CHECK(outcome.err.empty());
    const Outcome full = run({"explain", sample("house"), chimneys[0], "--full"});
    CHECK(full.out.starts_with(chimneys[0] + " -> chimney 1.00 by chimney.tall"));
    CHECK(full.out.find("dormer.with_window") != std::string::npos);
  }

  TEST_CASE("no feature of the samples is explained in more than twenty lines") {
    for (const std::string name : {"house", "block"})
      for (const std::string label : {"door", "window", "balcony", "", "loggia"})
        for (const std::string& id : ids_of(name, label)) {
          const Outcome outcome = run({"explain", sample(name), id});
          CAPTURE(outcome.out);
          CHECK(outcome.exit == 0);
          CHECK(lines_of(outcome.out).size() <= 20);
          break;
        }
  }

  TEST_CASE("explain --rule shows one rule or all rules for a label") {
    const std::string id = ids_of("house", "chimney").at(0);
    const auto rules_in = [](const std::string& text) {
      std::vector<std::string> rules;
      for (const std::string& line : lines_of(text))
        if (line.starts_with("  ") && line[2] != ' ')
          rules.push_back(line.substr(2, line.find(' ', 2) - 2));
      return rules;
    };
    CHECK(rules_in(run({"explain", sample("house"), id, "--rule", "vent.pipe"}).out) ==
          std::vector<std::string>{"vent.pipe"});
    CHECK(rules_in(run({"explain", sample("house"), id, "--rule", "dormer"}).out) ==
          std::vector<std::string>{"dormer.with_window", "dormer.by_shape"});
    const Outcome wrong = run({"explain", sample("house"), id, "--rule", "dormr"});
    CHECK(wrong.exit == 2);
    CHECK(wrong.says("the pack has no rule and no label 'dormr'; did you mean 'dormer'?"));
    CHECK(run({"explain", sample("house"), id, "--rule", "vent.pipe", "--full"}).exit == 2);
    CHECK(run({"explain", sample("house"), "--rule", "vent.pipe"}).says("--rule: needs a feature"));
  }

  TEST_CASE("explain without a feature lists the building") {
    const Outcome outcome = run({"explain", sample("house")});
    CHECK(outcome.exit == 0);
    const auto lines = lines_of(outcome.out);
    REQUIRE(lines.size() == 27);
    CHECK(lines[0] ==
          "house: 24 of 53 features have a label: 1 balcony, 1 canopy, 1 chimney, 2 door, 2 "
          "dormer, 1 stairs, 16 window");
    CHECK(lines.back() == "29 without a label: --full lists them.");
    CHECK(lines_of(run({"explain", sample("house"), "--full"}).out).size() == 55);
    const json building = json::parse(run({"explain", sample("house"), "--json"}).out);
    CHECK(building["building"] == "house");
    CHECK(building["features"].size() == 53);
    CHECK(building["features"][0]["rules"].size() > 10);
  }

  TEST_CASE("the list of a building has storey 2 before storey 10") {
    oriel::generator::Options options;
    options.storeys = {8, 8};
    options.roof = oriel::generator::RoofKind::flat;
    options.features.emplace();
    for (int i = 0; i < 12; ++i)
      options.additions.push_back(oriel::generator::read_addition(
          fmt::format("window hole on front at 2,{} size 0.8x0.6", 1 + 1.5 * i)));
    const Folder folder;
    const std::string tower = folder.write(
        "tower.city.json",
        oriel::generator::cityjson({"tower", oriel::generator::generate(options, 0), {}},
                                   oriel::generator::Content::stripped));
    const Outcome outcome = run({"explain", tower});
    CAPTURE(outcome.out);
    std::vector<int> storeys;
    const std::string begin = "window 1 of facade south, storey ";
    for (const std::string& line : lines_of(outcome.out))
      if (line.starts_with(begin)) storeys.push_back(std::stoi(line.substr(begin.size())));
    CHECK(storeys == std::vector{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  }

  TEST_CASE("a feature is explained by its name in any case and by the beginning of it") {
    const std::string id = ids_of("house", "chimney").at(0);
    const std::string by_id = run({"explain", sample("house"), id}).out;
    for (const std::string name :
         {"chimney 1 of roof slope north", "Chimney 1 of  ROOF slope north", "chimney"})
      CHECK(run({"explain", sample("house"), name}).out == by_id);
    const Outcome second =
        run({"explain", sample("house"), "window 2 of facade south storey 1", "--json"});
    CHECK(json::parse(second.out)["name"] == "window 2 of facade south, storey 1");

    const Outcome several = run({"explain", sample("house"), "window 1 of facade south"});
    CHECK(several.exit == 2);
    CHECK(several.says("2 features start with 'window 1 of facade south'; it may be f"));
    CHECK(several.says("(window 1 of facade south, storey 2)"));
    CHECK(!several.says("--id names one building"));

    const Outcome none = run({"explain", sample("house"), "chimney 2 of roof slope north"});
    CHECK(none.exit == 2);
    CHECK(
        none.says("no feature starts with 'chimney 2 of roof slope north'; there are 'chimney 1 "
                  "of roof slope north', '"));

    const Folder folder;
    const std::string town = folder / "town.city.json";
    REQUIRE(run({"collect", sample("house"), sample("l-house"), "-o", town}).exit == 0);
    const Outcome in_both = run({"explain", town, "door 1 of facade south, storey 1"});
    CHECK(in_both.exit == 2);
    CHECK(in_both.out.empty());
    CHECK(in_both.says("(door 1 of facade south, storey 1 in building house), f"));
    CHECK(in_both.says("(door 1 of facade south, storey 1 in building l-house); --id names one"));
    CHECK(run({"explain", town, "door 1 of facade south, storey 1", "--id", "l-house"}).exit == 0);
  }

  TEST_CASE("a misspelt beginning of a name is answered with the names near it") {
    CHECK(
        run({"explain", sample("house"), "chmney"})
            .says("no feature starts with 'chmney'; there are 'chimney 1 of roof slope north', '"));
  }

  TEST_CASE("what is explained is printed once however often the work is repeated") {
    for (const std::vector<std::string>& what :
         {std::vector<std::string>{"--surface", "3"}, {"chimney"}, {}}) {
      std::vector<std::string> words{"explain", sample("house")};
      words.insert(words.end(), what.begin(), what.end());
      const std::string once = run(words).out;
      words.insert(words.end(), {"--repeat", "2"});
      CHECK(run(words).out == once);
    }
  }

  TEST_CASE("what is only said of features is refused of a surface") {
    for (const std::string option : {"--json", "--full"})
      CHECK(run({"explain", sample("house"), "--surface", "3", option}).exit == 2);
  }

  TEST_CASE("names are the same in records and files and on pages whatever the threads") {
    const Folder folder;
    const std::string records = folder / "parts.json", again = folder / "again.json",
                      labelled = folder / "labelled.city.json", page = folder / "page.html";
    REQUIRE(run({"label", sample("house"), "--features", records, "-o", labelled}).exit == 0);
    REQUIRE(run({"view", sample("house"), "-o", page}).exit == 0);
    std::map<std::string, std::string> names;
    for (const json& record : json::parse(bytes_of(records))) names[record["id"]] = record["name"];
    REQUIRE(names.size() == 53);
    std::set<std::string> once;
    for (const auto& [id, name] : names) CHECK(once.insert(name).second);
    const json shown = page_data(page);
    for (const json& feature : shown["buildings"][0]["features"])
      CHECK(feature["name"] == names[feature["id"]]);
    std::size_t written = 0;
    const json city = json::parse(bytes_of(labelled));
    for (const json& object : city["CityObjects"]) {
      if (object["type"] == "BuildingInstallation") {
        CHECK(object["attributes"]["oriel_name"] == names[object["attributes"]["oriel_id"]]);
        ++written;
      }
      for (const json& geometry : object["geometry"])
        for (const json& surface : geometry["semantics"]["surfaces"]) {
          if (!surface.contains("oriel_id")) continue;
          CHECK(surface["oriel_name"] == names[surface["oriel_id"]]);
          ++written;
        }
    }
    CHECK(written >= 24);
    // Records that are named anew have the names of the new labels, here the same.
    REQUIRE(run({"interpret", records, "-o", again}).exit == 0);
    CHECK(bytes_of(again) == bytes_of(records));

    const std::string town = folder / "town.city.jsonl";
    REQUIRE(run({"collect", sample("house"), sample("row"), sample("hip"), "-o",
                 folder / "town.city.json"})
                .exit == 0);
    std::ofstream(town, std::ios::binary) << run({"cat", folder / "town.city.json"}).out;
    std::vector<std::string> tables;
    for (const std::string jobs : {"1", "4"}) {
      REQUIRE(run({"label", town, "--features", folder / "town.csv", "-j", jobs}).exit == 0);
      tables.push_back(bytes_of(folder / "town.csv"));
    }
    CHECK(tables[0] == tables[1]);
  }

  TEST_CASE("explain --id works on one building of a file and of a stream") {
    const Folder folder;
    const std::string stream = folder / "town.city.jsonl", file = folder / "town.city.json";
    REQUIRE(run({"collect", sample("house"), sample("row"), sample("hip"), "-o", file}).exit == 0);
    std::ofstream(stream, std::ios::binary) << run({"cat", file}).out;
    const Outcome alone = run({"explain", sample("house")});
    const std::string chimney = ids_of("house", "chimney").at(0);
    for (const std::string& town : {stream, file}) {
      CAPTURE(town);
      CHECK(run({"explain", town, "--id", "house"}).out == alone.out);
      const Outcome one = run({"explain", town, chimney, "--id", "house"});
      CHECK(one.out == run({"explain", sample("house"), chimney}).out);
      CHECK(run({"explain", town, "--id", "house", chimney}).out == one.out);
      CHECK(run({"explain", town, chimney, "--id", "row"}).exit == 2);
      // Nothing is done with the others.
      const Outcome timed = run({"explain", town, "--id", "house", "--log-level", "debug"});
      CHECK(timed.says("house"));
      CHECK(!timed.says("row"));
      const Outcome none = run({"explain", town, "--id", "hous"});
      CHECK(none.exit == 3);
      CHECK(none.says("hous: E130"));
    }
    CHECK(lines_of(run({"explain", file}).out).size() > lines_of(alone.out).size());
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
    CHECK(outcome.says("53 features start with 'f'; it may be f"));
    CHECK(outcome.says("..."));
    CHECK(outcome.out.empty());
  }

  TEST_CASE("a beginning that fits several features is refused also if the input breaks off") {
    const Folder folder;
    const std::string cut = folder / "cut.city.jsonl";
    std::ofstream(cut, std::ios::binary) << run({"cat", sample("house")}).out << "{\"type\": \n";
    const Outcome outcome = run({"explain", cut, "f"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.says("53 features start with 'f'; it may be f"));
    CHECK(outcome.out.empty());
  }

  TEST_CASE("an unknown id is answered with ids there are") {
    const Outcome outcome = run({"explain", sample("house"), "fzzzz"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.says("no feature starts with 'fzzzz'; there are f"));
    CHECK(outcome.out.empty());
  }

  TEST_CASE("an empty text is no feature and does not list the building") {
    const Outcome outcome = run({"explain", sample("house"), ""});
    CHECK(outcome.exit == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.says("an empty text names no feature"));
  }

  TEST_CASE("explain of an unreadable file is about the file") {
    const Outcome outcome = run({"explain", "no.city.json", "f1"});
    CHECK(outcome.exit == 5);
    CHECK(outcome.says("no.city.json: E101"));
    CHECK(!outcome.says("no feature starts with"));
  }

  TEST_CASE("explain of a building that is set aside says why it is, not that it has no features") {
    auto city = cubes({"far"});
    city["vertices"][0][0] = 9'000'000;
    const Folder folder;
    const Outcome outcome = run({"explain", folder.write("far.city.json", city.dump()), "f1"});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("far: E501"));
    CHECK(!outcome.says("no feature starts with"));
    CHECK(outcome.out.empty());
  }

  TEST_CASE("explain of a building without features says that there are none") {
    const Folder folder;
    const std::string cube = folder.write("cube.city.json", cubes({"cube"}).dump());
    const Outcome outcome = run({"explain", cube, "f1"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.says("no feature starts with 'f1'; there are none"));
  }

  TEST_CASE("explain at a place is about the feature there or else the surface") {
    const Folder folder;
    REQUIRE(run({"view", sample("house-utm"), "-o", folder / "page.html"}).exit == 0);
    const json data = page_data(folder / "page.html");
    const json& building = data["buildings"][0];
    const RecordedShape shape = shape_of(building["geometry"]);
    std::size_t of_features = 0, of_surfaces = 0;
    std::string of_surface;
    for (std::size_t i = 0; i < shape.polygons.size(); i += 9) {
      const RecordedPolygon& polygon = shape.polygons[i];
      if (polygon.rings.size() > 1 || polygon.rings[0].size() > 4) continue;
      std::string place;
      for (int axis = 0; axis < 3; ++axis) {
        double sum = 0;
        for (const std::size_t corner : polygon.rings[0])
          sum += shape.vertices_mm[3 * corner + static_cast<std::size_t>(axis)];
        sum /= 1000 * static_cast<double>(polygon.rings[0].size());
        const double metres =
            data["state"]["origin_m"][static_cast<std::size_t>(axis)].get<double>() + sum;
        place += (axis == 0 ? "" : ",") + fmt::format("{:.3f}", metres);
      }
      const Outcome outcome = run({"explain", sample("house-utm"), "--at", place});
      CAPTURE(place);
      CHECK(outcome.exit == 0);
      std::string feature;
      for (const std::size_t owner : polygon.owners) {
        const bool is_known = !building["explain"][owner]["label"].is_null();
        if (feature.empty() || is_known) feature = building["features"][owner]["id"];
        if (is_known) break;
      }
      (feature.empty() ? of_surfaces : of_features) += 1;
      const std::string number = std::to_string(i);
      const Outcome same = feature.empty()
                               ? run({"explain", sample("house-utm"), "--surface", number})
                               : run({"explain", sample("house-utm"), feature});
      CHECK(outcome.out == same.out);
      if (feature.empty()) of_surface = place;
    }
    // What is only said of features is refused.
    using Arguments = std::vector<std::string>;
    for (const Arguments& option : {Arguments{"--json"}, {"--rule", "window.in_wall"}}) {
      Arguments words{"explain", sample("house-utm"), "--at", of_surface};
      words.insert(words.end(), option.begin(), option.end());
      const Outcome refused = run(words);
      CHECK(refused.exit == 2);
      CHECK(refused.out.empty());
      CHECK(refused.says(option[0] + ": a surface lies there"));
    }
    CHECK(of_features > 5);
    CHECK(of_surfaces > 1);
    const Outcome nowhere = run({"explain", sample("house-utm"), "--at", "0,0,0"});
    CHECK(nowhere.exit == 2);
    CHECK(nowhere.says("--at: no polygon lies there"));
    CHECK(run({"explain", sample("house-utm"), "--at", "0,0"}).exit == 2);
  }

  TEST_CASE("label --explain writes a reason onto every surface and installation") {
    const Folder folder;
    const std::string with = folder / "with.city.json", without = folder / "without.city.json";
    REQUIRE(run({"label", sample("house"), "-o", without}).exit == 0);
    REQUIRE(run({"label", sample("house"), "--explain", "-o", with}).exit == 0);
    CHECK(bytes_of(without).find("oriel_why") == std::string::npos);
    json city = json::parse(bytes_of(with));
    std::size_t surfaces = 0, installations = 0;
    for (json& object : city["CityObjects"]) {
      for (json& geometry : object["geometry"])
        for (json& surface : geometry["semantics"]["surfaces"]) {
          const std::string why = surface["oriel_why"];
          const std::string name = surface.value("oriel_label", surface["type"]);
          CHECK(why.starts_with(name));
          CHECK(why.find(" by " + surface.value("oriel_rule", "")) != std::string::npos);
          surface.erase("oriel_why");
          ++surfaces;
        }
      if (object["type"] != "BuildingInstallation") continue;
      const std::string why = object["attributes"]["oriel_why"];
      CHECK(why.find(" by " + object["attributes"]["oriel_rule"].get<std::string>() + ": ") !=
            std::string::npos);
      object["attributes"].erase("oriel_why");
      ++installations;
    }
    CHECK(surfaces > 100);
    CHECK(installations == 6);
    // Nothing else is different.
    CHECK(city == json::parse(bytes_of(without)));
  }

  TEST_CASE("surfaces that stay as they were say so and what the rules say") {
    const Folder folder;
    json city = json::parse(bytes_of(sample("house")));
    json& geometry = city["CityObjects"]["house"]["geometry"][0];
    json& values = geometry["semantics"]["values"][0];
    values = json(geometry["boundaries"][0].size(), nullptr);
    geometry["semantics"]["surfaces"] = {{{"type", "RoofSurface"}, {"name", "two of them"}},
                                         {{"type", "WallSurface"}, {"oriel_why", "because"}},
                                         {{"type", "GroundSurface"}},
                                         {{"type", "WallSurface"}}};
    values[0] = values[1] = 0;
    values[2] = 1;
    values[3] = 3;
    const std::string input = folder.write("some.city.json", city.dump());
    const auto labelled = [&](const std::string& existing, const std::string& from) {
      const std::string out = folder / (existing + ".city.json");
      REQUIRE(run({"label", from, "--existing", existing, "--explain", "-o", out}).exit == 0);
      return bytes_of(out);
    };
    for (const std::string existing : {"fill", "keep"}) {
      const std::string written = labelled(existing, input);
      const json surfaces =
          json::parse(written)["CityObjects"]["house"]["geometry"][0]["semantics"]["surfaces"];
      const std::string why = surfaces[0]["oriel_why"];
      // Polygon 0 is a reveal of a window, polygon 1 is not.
      CHECK(
          why.starts_with("kept as RoofSurface from the input; by the rules window 1.00 by "
                          "window.in_wall: "));
      CHECK(why.find(", and of others of its polygons WallSurface by wall.any: ") !=
            std::string::npos);
      CHECK(surfaces[0]["name"] == "two of them");
      CHECK(surfaces[1]["oriel_why"] == "because");
      // No polygon has it.
      CHECK_FALSE(surfaces[2].contains("oriel_why"));
      for (std::size_t i = 3; i < surfaces.size(); ++i) CHECK(surfaces[i].contains("oriel_why"));
      if (existing == "keep") CHECK_FALSE(surfaces[0].contains("children"));
      CHECK(labelled(existing, folder.write("again.city.json", written)) == written);
    }
  }

  TEST_CASE("view writes one page with what explain says of every feature") {
    const Folder folder;
    const Outcome outcome = run({"view", sample("house"), "-o", folder / "page.html"});
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("1 of 1 building shown: 1 balcony, 1 canopy, 1 chimney, 2 door"));
    const json data = page_data(folder / "page.html");
    CHECK(data["after"].is_null());
    CHECK(data["state"]["buildings"][0]["id"] == "house");
    const json& building = data["buildings"][0];
    REQUIRE(building["features"].size() == 53);
    CHECK(building["explain"].size() == 53);
    CHECK(data["pack"]["labels"]["0"].size() == 53);
    CHECK(shape_of(building["geometry"]).storeys_mm.size() >= 2);
    CHECK(bytes_of(folder / "page.html").size() <= 1'000'000);
    for (const std::size_t number : {0, 20, 40}) {
      const json& reply = building["explain"][number];
      const std::string id = building["features"][number]["id"];
      const Outcome explained = run({"explain", sample("house"), id, "--full"});
      CHECK(explained.out.starts_with(reply["head"].get<std::string>() + "\n"));
      const std::string label = reply["label"].is_null() ? "unknown" : reply["label"];
      CHECK(reply["sentence"].get<std::string>().starts_with(label + ": a"));
      for (const json& relation : reply["relations"])
        for (const std::size_t other : relation["features"])
          CHECK(other < building["features"].size());
      const json said = json::parse(run({"explain", sample("house"), id, "--json"}).out);
      CHECK(reply["why"].size() == said["rules"].size());
      for (const json& rule : reply["why"]) {
        CHECK(explained.out.find(rule["place"].get<std::string>() + "\n") != std::string::npos);
        for (const json& condition : rule["conditions"])
          for (const char* cell : {"found", "asked"})
            CHECK(explained.out.find(condition[cell].get<std::string>()) != std::string::npos);
      }
      // Flips are searched for one feature at a time.
      CHECK(reply["flip"].is_null());
    }
  }

  TEST_CASE("every polygon of a page has its corners and says what surface it is and why") {
    const Folder folder;
    REQUIRE(run({"view", sample("house"), "-o", folder / "page.html"}).exit == 0);
    const json building = page_data(folder / "page.html")["buildings"][0];
    const RecordedShape shape = shape_of(building["geometry"]);
    const json &types = building["surfaces"]["types"], &reasons = building["surfaces"]["why"];
    REQUIRE(types.size() == shape.polygons.size());
    std::size_t owned = 0;
    for (std::size_t i = 0; i < shape.polygons.size(); ++i) {
      for (const auto& ring : shape.polygons[i].rings)
        for (const std::size_t corner : ring) CHECK(3 * corner < shape.vertices_mm.size());
      for (const std::size_t owner : shape.polygons[i].owners)
        CHECK(owner < building["features"].size());
      owned += shape.polygons[i].owners.empty() ? 0 : 1;
      const std::string why = reasons.at(i), number = std::to_string(i);
      if (i % 40 == 0)
        CHECK(run({"explain", sample("house"), "--surface", number}).out ==
              "house: polygon " + number + " is " + why);
      CHECK(why.starts_with(types[i].get<std::string>() + " by "));
    }
    CHECK(owned > 100);
  }

  TEST_CASE("a page asks for nothing and is the same for any number of jobs") {
    const Folder folder;
    const std::vector<std::string> inputs = {sample("house"), sample("row"), sample("hip")};
    std::vector<std::string> pages;
    for (const std::string jobs : {"1", "8"}) {
      std::vector<std::string> arguments = {"view", "-o", folder / "page.html", "-j", jobs};
      arguments.insert(arguments.end(), inputs.begin(), inputs.end());
      REQUIRE(run(arguments).exit == 0);
      pages.push_back(bytes_of(folder / "page.html"));
    }
    CHECK(pages[0] == pages[1]);
    CHECK(pages[0].find("default-src 'none'") != std::string::npos);
    for (const std::string loader : {"src=", "href=", "import(", "@import", "fetch("})
      CHECK(pages[0].find(loader) == std::string::npos);
    CHECK(pages[0].find("{{data}}") == std::string::npos);
    CHECK(folder.names() == std::vector<std::string>{"page.html"});
  }

  TEST_CASE("a page with a generalised file has both") {
    const Folder folder;
    const std::string small = folder / "small.city.json";
    REQUIRE(run({"generalise", sample("house"), "--scale", "1:2500", "-o", small}).exit == 0);
    REQUIRE(run({"view", sample("house"), "--after", small, "-o", folder / "page.html"}).exit == 0);
    const json data = page_data(folder / "page.html");
    REQUIRE(data["after"].size() == 1);
    const json& after = data["after"][0];
    const json& features = data["buildings"][0]["features"];
    const auto windows = [&](const json& labels) {
      std::size_t count = 0;
      for (const int label : labels)
        count += label >= 0 && data["pack"]["classes"].at(
                                   static_cast<std::size_t>(label))["name"] == "window"
                     ? 1
                     : 0;
      return count;
    };
    CHECK(windows(data["pack"]["labels"]["0"]) == 16);
    // The file says nothing of what is gone: the picture has no polygon of it.
    CHECK(features.size() == 53);
    CHECK(after["labels"] == data["pack"]["labels"]["0"]);
    std::set<std::size_t> seen;
    std::size_t owned = 0;
    const RecordedShape shape = shape_of(after["geometry"]);
    CHECK(after["types"].size() == shape.polygons.size());
    for (const RecordedPolygon& polygon : shape.polygons) {
      owned += polygon.owners.empty() ? 0 : 1;
      seen.insert(polygon.owners.begin(), polygon.owners.end());
    }
    CHECK(seen.size() == 6);
    json left = json::array();
    for (const std::size_t feature : seen) left.push_back(after["labels"].at(feature));
    CHECK(windows(left) == 1);
    CHECK(owned > 20);
    // A file without labels of oriel is labelled as it is.
    REQUIRE(run({"view", sample("house"), "--after", sample("house"), "-o", folder / "page.html"})
                .exit == 0);
    const json same = page_data(folder / "page.html");
    CHECK(same["buildings"][0]["geometry"] == same["after"][0]["geometry"]);
    CHECK(same["buildings"][0]["surfaces"]["types"] == same["after"][0]["types"]);
    CHECK(same["pack"]["labels"]["0"] == same["after"][0]["labels"]);
  }

  TEST_CASE("a page of nothing is not written") {
    const Folder folder;
    const std::string page = folder / "page.html";
    const Outcome nothing = run({"view", sample("house"), "--id", "nobody", "-o", page});
    CHECK(nothing.exit == 5);
    CHECK(nothing.says("E127 there is no building to show"));
    const Outcome other = run({"view", sample("house"), "--after", sample("row"), "-o", page});
    CHECK(other.exit == 5);
    CHECK(other.says("E128 has none of the buildings that are shown"));
    const Outcome missing = run({"view", sample("house"), "--after", "no.city.json", "-o", page});
    CHECK(missing.exit == 5);
    CHECK(missing.says("no.city.json: E101"));
    CHECK(run({"view", sample("house"), "-o", folder / "no/page.html"}).exit == 6);
    CHECK(folder.names().empty());
  }

  TEST_CASE("no name can break out of a page") {
    const Folder folder;
    const std::string id = "</script><script>alert(1)</script>";
    const std::string cube = folder.write("cube.city.json", cubes({id}).dump());
    REQUIRE(run({"view", cube, "-o", folder / "page.html"}).exit == 0);
    CHECK(bytes_of(folder / "page.html").find("alert(1)</script>") == std::string::npos);
    CHECK(page_data(folder / "page.html")["state"]["buildings"][0]["id"] == id);
  }

  TEST_CASE("a page shows a building that stays open and says so, and none that cannot be read") {
    auto city = cubes({"open", "far"});
    city["CityObjects"]["open"]["geometry"][0]["boundaries"][0].erase(1);
    city["vertices"][8][0] = 9'000'000;
    const Folder folder;
    const std::string input = folder.write("in.city.json", city.dump());
    const Outcome outcome = run({"view", input, "-o", folder / "page.html"});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("far: E501"));
    const json data = page_data(folder / "page.html");
    REQUIRE(data["buildings"].size() == 1);
    const json& building = data["state"]["buildings"][0];
    CHECK(shape_of(data["buildings"][0]["geometry"]).polygons.size() == 5);
    CHECK(data["buildings"][0]["surfaces"]["types"].at(0) != "");
    CHECK(building["issues"].at(0)["code"] == "E302");
    CHECK(building["issues"].at(0)["severity"] == "warning");
    CHECK(building["issues"].at(0)["sentence"].get<std::string>().starts_with("not closed"));
  }
}
