#include "examples/generator/generate.h"
#include "examples/generator/output/cityjson.h"
#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/citygml_samples.h"
#include "tests/support/error_files.h"
#include "tests/support/shared.h"

#include <filesystem>
#include <set>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

std::string errors_folder() {
  return (std::filesystem::path(ORIEL_SOURCE_DIR) / "tests" / "data" / "errors").string();
}

/// The lines of JSON that the command prints.
std::vector<json> judged(const std::vector<std::string>& arguments, int exit) {
  std::vector<std::string> all{"validate", "--json"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Outcome outcome = run(all);
  CAPTURE(outcome.err);
  CHECK(outcome.exit == exit);
  std::vector<json> lines;
  for (std::size_t at = 0; at < outcome.out.size();) {
    const std::size_t end = outcome.out.find('\n', at);
    lines.push_back(json::parse(outcome.out.substr(at, end - at)));
    at = end + 1;
  }
  return lines;
}

/// "E341_104" of each finding, once.
std::set<std::string> codes_in(const json& building) {
  std::set<std::string> codes;
  for (const json& finding : building["findings"])
    codes.insert(
        fmt::format("{}_{:03}", finding["code"].get<std::string>(), finding.value("val3dity", 0)));
  return codes;
}

/// A building of two parts p and q, cubes of 4 m, the second shifted from 10 m to `x_mm`.
nlohmann::ordered_json two_parts(int x_mm) {
  auto city = cubes({"p", "q"});
  for (std::size_t i = 8; i < 16; ++i)
    city["vertices"][i][0] = city["vertices"][i][0].get<int>() - 10000 + x_mm;
  city["CityObjects"]["h"] = {{"type", "Building"}, {"children", {"p", "q"}}};
  for (const char* id : {"p", "q"}) {
    city["CityObjects"][id]["type"] = "BuildingPart";
    city["CityObjects"][id]["parents"] = {"h"};
  }
  return city;
}

TEST_SUITE("cli") {
  TEST_CASE("the files of tests/data/errors are those that the project makes") {
    std::set<std::string> expected{"make.cpp"};
    for (const ErrorFile& file : error_files()) {
      CAPTURE(file.name);
      CHECK(bytes_of(errors_folder() + "/" + file.name) == file.text);
      expected.insert(file.name);
    }
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(errors_folder()))
      found.insert(entry.path().filename().string());
    CHECK(found == expected);
  }

  TEST_CASE("each file of tests/data/errors has exactly its code") {
    const std::string page =
        bytes_of(std::filesystem::path(ORIEL_SOURCE_DIR) / "docs" / "errors.md");
    for (const ErrorFile& file : error_files()) {
      CAPTURE(file.name);
      const std::string stem = file.name.substr(0, file.name.find('.'));
      const std::string path = errors_folder() + "/" + file.name;
      if (stem == "E201_000") {  // costs the file
        CHECK(run({"validate", path}).exit == 5);
        CHECK(run({"validate", path}).says("E201 has no 'transform'"));
        continue;
      }
      const auto lines = judged({path}, stem == "valid" ? 0 : 3);
      REQUIRE(lines.size() == 1);
      CHECK(lines[0]["id"] == "cube");
      CHECK(lines[0]["valid"] == (stem == "valid"));
      CHECK(codes_in(lines[0]) ==
            (stem == "valid" ? std::set<std::string>{} : std::set<std::string>{stem}));
      if (stem == "valid" || stem.ends_with("000")) continue;
      const std::size_t section = page.find("### " + stem.substr(0, 4) + " ");
      REQUIRE(section != std::string::npos);
      const std::string text = page.substr(section, page.find("###", section + 4) - section);
      CHECK(text.find("val3dity") != std::string::npos);
      CHECK(text.find(stem.substr(5)) != std::string::npos);
    }
  }

  TEST_CASE("validate tells each building and counts codes at the end") {
    const Folder folder;
    auto city = cubes({"a", "b"});
    city["CityObjects"]["b"]["geometry"][0]["boundaries"][0].erase(1);
    const std::string path = folder.write("two.city.json", city.dump());
    const Outcome all = run({"validate", path});
    CHECK(all.exit == 3);
    CHECK(all.out.starts_with("a: valid\nb: 1 finding\n  E302 not closed: 4 connected open edges"));
    CHECK(all.out.find("(val3dity 302 SHELL_NOT_CLOSED)") != std::string::npos);
    CHECK(all.says("1 of 2 buildings is valid; 1 E302 (val3dity 302 SHELL_NOT_CLOSED)"));
    CHECK(run({"validate", path, "--only-problems"}).out.starts_with("b: 1 finding\n"));
    CHECK(run({"validate", path, "--as", "surfaces"}).exit == 0);
    CHECK(run({"validate", path, "--id", "a"}).exit == 0);
    CHECK(run({"validate", folder / "no.city.json"}).exit == 5);
  }

  TEST_CASE("every geometry of every object is judged") {
    const Folder folder;
    for (const std::string type :
         {"Building", "BuildingInstallation", "GenericCityObject", "+Shed"}) {
      CAPTURE(type);
      auto city = cubes({"a", "b"});
      auto& other = city["CityObjects"]["b"];
      other["type"] = type;
      const std::string good = folder.write("good.city.json", city.dump());
      CHECK(run({"validate", good}).out == "a: valid\nb: valid\n");
      other["geometry"].push_back(other["geometry"][0]);
      other["geometry"][1]["boundaries"][0].erase(1);  // open
      const Outcome bad = run({"validate", folder.write("bad.city.json", city.dump())});
      CHECK(bad.exit == 3);
      CHECK(bad.out.starts_with(
          "a: valid\nb (geometry 0): valid\nb (geometry 1): 1 finding\n  E302"));
      CHECK(bad.says("2 of 3 geometries are valid; 1 E302"));
      const auto lines = judged({folder / "bad.city.json"}, 3);
      REQUIRE(lines.size() == 3);
      CHECK_FALSE(lines[0].contains("geometry"));
      CHECK(lines[1]["geometry"] == 0);
      CHECK(lines[2]["geometry"] == 1);
      // E205 of buildings; of other objects nothing is asked.
      CHECK(judged({folder / "bad.city.json", "--lod", "1"}, 3).size() ==
            (type == "Building" ? 2U : 1U));
    }
    auto city = cubes({"a", "b"});
    city["CityObjects"]["b"] = {{"type", "Building"},
                                {"geometry", {{{"type", "GeometryInstance"}, {"template", 0}}}}};
    const Outcome none = run({"validate", folder.write("template.city.json", city.dump())});
    CHECK(none.exit == 3);
    CHECK(none.says("E214 1 object of type GeometryInstance with geometry is not checked: b"));
    CHECK(none.says("1 of 1 building is valid; 1 other object was not checked"));
  }

  TEST_CASE("objects of CityGML that are not judged are named and the end is not clean") {
    const Folder folder;
    const auto member = [](const std::string& name, const std::string& content,
                           const std::string& attributes = "") {
      return element("c:cityObjectMember", element(name, content, attributes));
    };
    const std::string generic =
        member("gen:GenericCityObject", element("gen:lod1Geometry", box_solid("g")),
               "gml:id=\"g\"") +
        member("gen:GenericCityObject", element("gen:lod1Geometry", box_solid("h")));
    // An address is a point, and says nothing of geometry.
    const std::string bare =
        member("gen:GenericCityObject", element("gen:address",
                                                "<gml:Point><gml:pos>1 2 3</gml:pos>"
                                                "</gml:Point>"));
    for (const std::string version : {"1.0", "2.0", "3.0"}) {
      CAPTURE(version);
      const std::string lod = version == "3.0" ? "c:lod2Solid" : "bldg:lod2Solid";
      const std::string house = building("house", element(lod, box_solid("p")));
      const auto judge = [&](const std::string& members, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{
            "validate", folder.write("city.gml", CityGmlFile{version, members}.text())};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
      };
      for (const std::string& members : {generic + house, house + generic}) {
        const Outcome some = judge(members, {});
        CHECK(some.exit == 3);
        CHECK(some.out == "house: valid\n");
        CHECK(some.says("E214 2 objects of type GenericCityObject"));
        CHECK(some.says("are not checked: g, ..."));
        CHECK(some.says("1 of 1 building is valid; 2 other objects were not checked"));
        CHECK(judge(members, {"--lod", "all"}).says("2 other objects were not checked"));
        CHECK(judge(members, {"--id", "house"}).exit == 0);
      }
      const Outcome none = judge(generic, {});
      CHECK(none.exit == 3);
      CHECK(none.says("E214"));
      CHECK(none.says("E134"));
      CHECK(judge(house + bare, {}).exit == 0);
      const Outcome templates = judge(
          house + building("copy", element(lod.substr(0, lod.size() - 5) + "ImplicitRepresentation",
                                           element("c:ImplicitGeometry", ""))),
          {});
      CHECK(templates.exit == 3);
      CHECK(templates.says("E214 1 object of type ImplicitGeometry"));
      CHECK(templates.says("is not checked: copy"));
    }
  }

  TEST_CASE("what has no geometry or shares that of its building is not missed") {
    const Folder folder;
    auto city = cubes({"a"});
    city["CityObjects"]["r"] = {{"type", "Road"}};
    city["CityObjects"]["e"] = {{"type", "Road"}, {"geometry", json::array()}};
    CHECK(run({"validate", folder.write("a.city.json", city.dump())}).exit == 0);
    const std::string labelled = folder / "labelled.city.json";
    REQUIRE(run({"label", sample("house"), "-o", labelled}).exit == 0);
    CHECK(bytes_of(labelled).find("BuildingInstallation") != std::string::npos);
    CHECK_FALSE(run({"validate", labelled}).says("E214"));
    CHECK(run({"validate", labelled}).exit == 0);
  }

  TEST_CASE("a second geometry of a level is named by every command that reads one only") {
    const Folder folder;
    auto city = cubes({"a"});
    auto& geometries = city["CityObjects"]["a"]["geometry"];
    auto surfaces = geometries[0];
    surfaces["type"] = "MultiSurface";
    surfaces["boundaries"] = surfaces["boundaries"][0];
    geometries.insert(geometries.begin(), surfaces);
    const std::string path = folder.write("two.city.json", city.dump());
    const std::string out = folder / "out.city.json";
    const std::string said =
        "E215 has 2 geometries at lod 3: geometry 1 (Solid) is used, not geometry 0 (MultiSurface)";
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"segment", path},
                                               {"label", path, "-o", out},
                                               {"repair", path, "-o", out},
                                               {"generalise", path, "--scale", "1:500", "-o", out},
                                               {"generalise", path, "--to-lod", "1.0", "-o", out},
                                               {"view", path, "-o", folder / "out.html"}}) {
      CAPTURE(command[0]);
      const Outcome outcome = run(command);
      CHECK(outcome.exit == (command[0] == "segment" ? 3 : 0));  // a cube has no features
      CHECK(outcome.says(said));
    }
    CHECK_FALSE(run({"validate", path}).says("E215"));
  }

  TEST_CASE("what stood for a building besides its solid leaves when that is redrawn") {
    const Folder folder;
    auto city = json::parse(bytes_of(sample("house")));
    const std::string id = city["CityObjects"].begin().key();
    auto& geometries = city["CityObjects"][id]["geometry"];
    const std::size_t one = geometries.size();
    auto surfaces = geometries[0];
    surfaces["type"] = "MultiSurface";
    surfaces["boundaries"] = surfaces["boundaries"][0];
    surfaces.erase("semantics");
    geometries.push_back(surfaces);
    const std::string path = folder.write("two.city.json", city.dump());
    const std::string out = folder / "out.city.json";
    const auto left = [&] {
      return json::parse(bytes_of(out))["CityObjects"][id]["geometry"].size();
    };
    REQUIRE(run({"generalise", path, "--scale", "1:5000", "-o", out}).exit == 0);
    CHECK(left() == one);
    REQUIRE(run({"label", path, "-o", out}).exit == 0);
    CHECK(left() == one + 1);
  }

  TEST_CASE("the small cases of shared data get the verdicts that val3dity gives") {
    ORIEL_NEEDS_SHARED(shared);
    const auto codes = [&](const std::string& name) {
      std::set<std::string> all;
      const std::string path = (shared / "data" / "cases" / name).string();
      const Outcome outcome = run({"validate", "--json", "--lod", "all", path});
      for (std::size_t at = 0; at < outcome.out.size(); at = outcome.out.find('\n', at) + 1)
        all.merge(codes_in(json::parse(outcome.out.substr(at, outcome.out.find('\n', at) - at))));
      CHECK(outcome.exit == (all.empty() ? 0 : 3));
      return all;
    };
    CHECK(codes("families/second-geometry-invalid.city.json").contains("E344_203"));
    CHECK(codes("families/touching-parts.gml").empty());
    CHECK(codes("geometry/installation-folded.city.json") == std::set<std::string>{"E345_204"});
    CHECK(codes("geometry/vertices-one-unit-apart.city.jsonl") ==
          std::set<std::string>{"E312_102"});
  }

  TEST_CASE("all levels of detail are judged if asked for") {
    const Folder folder;
    auto city = cubes({"a", "b"});
    auto& geometries = city["CityObjects"]["a"]["geometry"];
    geometries.push_back(geometries[0]);
    geometries[0]["lod"] = "1";
    geometries[0]["boundaries"][0].erase(1);  // open, and not the highest
    const std::string path = folder.write("lods.city.json", city.dump());
    CHECK(run({"validate", path}).exit == 0);
    const Outcome all = run({"validate", path, "--lod", "all"});
    CHECK(all.exit == 3);
    CHECK(all.out.starts_with("a (lod 1): 1 finding\n  E302"));
    CHECK(all.out.ends_with("a (lod 3): valid\nb (lod 3): valid\n"));
    CHECK(all.says("2 of 3 geometries are valid"));
    const auto lines = judged({path, "--lod", "all"}, 3);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0]["lod"] == "1");
    CHECK(lines[1]["lod"] == "3");
    CHECK(run({"validate", "-", "--from", "cityjson", "--lod", "all"}, {.in = city.dump()}).out ==
          all.out);
  }

  TEST_CASE("building parts that overlap are 601 and parts that touch are not") {
    const Folder folder;
    const auto parts_at = [&](int x_mm) {
      return folder.write("parts.city.json", two_parts(x_mm).dump());
    };
    for (const int overlapping : {3999, 2000, 1, 0, -1})
      for (const json& line : judged({parts_at(overlapping), "--snap", "1e-6"}, 3)) {
        if (line["id"] == "p") CHECK(line["valid"] == true);
        if (line["id"] == "q") CHECK(codes_in(line) == std::set<std::string>{"E359_601"});
      }
    for (const int apart : {4000, 4001, 10000}) CHECK(judged({parts_at(apart)}, 0).size() == 2);
    auto strangers = cubes({"p", "q"});
    for (std::size_t i = 8; i < 16; ++i)
      strangers["vertices"][i][0] = strangers["vertices"][i][0].get<int>() - 8000;
    CHECK(judged({folder.write("two.city.json", strangers.dump())}, 0).size() == 2);
  }

  TEST_CASE("parts that overlap as generalise writes them are named and the end is not clean") {
    const Folder folder;
    const std::string out = folder / "out.city.json";
    for (const std::vector<std::string>& target :
         std::vector<std::vector<std::string>>{{"--scale", "1:500", "-o", out},
                                               {"--scale", "1:25000", "-o", out},
                                               {"--to-lod", "1.0", "--to-lod", "2.0", "-o", out},
                                               {"--series", "1:500,1:5000", "-o", folder / "s"}}) {
      CAPTURE(target[1]);
      for (const bool do_overlap : {true, false}) {
        const std::string path =
            folder.write("p.city.json", two_parts(do_overlap ? 3000 : 4000).dump());
        std::vector<std::string> command{"generalise", path};
        command.insert(command.end(), target.begin(), target.end());
        const Outcome drawn = run(command);
        CHECK(drawn.exit == (do_overlap ? 3 : 0));
        CHECK(drawn.says("q: E359 it overlaps p of the same building") == do_overlap);
        if (do_overlap) CHECK(drawn.says("1 of 2 buildings"));
        const bool is_series = target[0] == "--series";
        CHECK(run({"validate", "--lod", "all", is_series ? folder / "s.1-5000.city.json" : out})
                  .exit == drawn.exit);
      }
    }
  }

  TEST_CASE(
      "parts of shared data that overlap are named by generalise and ones that touch are not") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    for (const auto& [name, exit] :
         {std::pair{"p04_dormer_is_a_part.city.json", 3}, {"touching-parts.gml", 0}}) {
      const std::string path = (shared / "data" / "cases" / "families" / name).string();
      for (const char* scale : {"1:500", "1:25000"}) {
        CAPTURE(name);
        const Outcome drawn =
            run({"generalise", path, "--scale", scale, "-o", folder / "out.city.json"});
        CHECK(drawn.exit == exit);
        CHECK(drawn.says("E359 ") == (exit == 3));
      }
    }
  }

  TEST_CASE("line ends and a byte order mark change nothing") {
    const Folder folder;
    for (const ErrorFile& file : error_files()) {
      if (!file.name.ends_with(".json") || file.name.starts_with("E201")) continue;
      CAPTURE(file.name);
      std::string other = "\xEF\xBB\xBF";
      for (const char c : file.text) other += c == '\n' ? std::string("\r\n") : std::string(1, c);
      const auto expected = run({"validate", errors_folder() + "/" + file.name});
      const auto found = run({"validate", folder.write(file.name, other)});
      CHECK(found.exit == expected.exit);
      if (!file.name.ends_with("000.city.json")) CHECK(found.out == expected.out);
    }
  }

  TEST_CASE("an open mesh is judged as a solid unless told otherwise") {
    const Folder folder;
    const std::string path = folder.write(
        "open.off", "OFF\n4 3 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    CHECK(judged({path}, 3)[0]["findings"][0]["code"] == "E301");
    CHECK(judged({path, "--as", "surfaces"}, 0)[0]["valid"] == true);
  }

  TEST_CASE("what generalise writes is valid when it is read again") {
    const Folder folder;
    oriel::generator::Options options;
    options.seed = 5;
    std::vector<std::string> houses{sample("house"), sample("l-house"), sample("row")};
    for (int i = 0; i < 12; ++i)
      houses.push_back(
          folder.write(fmt::format("h{}.city.json", i),
                       oriel::generator::cityjson(
                           {fmt::format("h{}", i), oriel::generator::generate(options, i), {}},
                           oriel::generator::Content::stripped)));
    for (const char* scale : {"1:1000", "1:5000", "1:20000"})
      for (const std::string& house : houses) {
        CAPTURE(scale);
        CAPTURE(house);
        const std::string out = folder / "out.city.json";
        REQUIRE(run({"generalise", house, "--scale", scale, "-o", out}).exit == 0);
        for (const json& line : judged({out}, 0)) CHECK(line["findings"].empty());
      }
  }
}

}  // namespace
