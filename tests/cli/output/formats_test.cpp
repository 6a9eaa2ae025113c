#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/shared.h"

#include <cctype>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel::test {
namespace {

using nlohmann::json;

/// Features of a file, as `label` finds them.
std::string features_of(const Folder& folder, const std::string& file) {
  CHECK(run({"label", file, "--features", folder / "f.csv"}).exit == 0);
  return bytes_of(folder / "f.csv");
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++count;
  return count;
}

std::string stream_of_cubes(const Folder& folder) {
  return folder.write("in.city.jsonl", cube_lines({"a", "b", "c", "d", "e"}));
}

TEST_SUITE("cli") {
  TEST_CASE("what was labelled as CityGML has the same features as CityJSON") {
    const Folder folder;
    const std::string house = sample("house");
    REQUIRE(run({"label", house, "-o", folder / "a.city.json"}).exit == 0);
    const std::string expected = features_of(folder, folder / "a.city.json");
    for (const std::string version : {"citygml2", "citygml3"}) {
      REQUIRE(run({"label", house, "--to", version, "-o", folder / "a.gml"}).exit == 0);
      CHECK(features_of(folder, folder / "a.gml") == expected);
      const std::string text = bytes_of(folder / "a.gml");
      CHECK(count_of(text, "<bldg:Building ") == 1);
      const std::size_t windows = count_of(bytes_of(folder / "a.city.json"), R"("type":"Window")");
      CHECK(windows >= 16);
      CHECK(count_of(text, version == "citygml2" ? "<bldg:Window>" : "<con:WindowSurface ") ==
            windows);
    }
  }

  TEST_CASE("every id in CityGML is there once and every link leads to one") {
    const Folder folder;
    for (const std::string version : {"citygml2", "citygml3"}) {
      REQUIRE(run({"label", sample("house"), "--to", version, "-o", folder / "a.gml"}).exit == 0);
      const std::string text = bytes_of(folder / "a.gml");
      const auto values = [&](const std::string& attribute) {
        std::multiset<std::string> found;
        for (std::size_t at = text.find(attribute); at != std::string::npos;
             at = text.find(attribute, at)) {
          at += attribute.size();
          found.insert(text.substr(at, text.find('"', at) - at));
        }
        return found;
      };
      const auto ids = values("gml:id=\"");
      CHECK(std::set<std::string>(ids.begin(), ids.end()).size() == ids.size());
      for (const std::string& link : values("xlink:href=\"#")) CHECK(ids.contains(link));
    }
  }

  TEST_CASE("installations are solids of their own in CityGML if asked") {
    const Folder folder;
    const Outcome outcome =
        run({"label", sample("house"), "-o", folder / "a.gml", "--closed-installations", "-v"});
    CHECK(outcome.exit == 0);
    const std::string text = bytes_of(folder / "a.gml");
    const std::size_t installations = count_of(text, "<bldg:BuildingInstallation ");
    CHECK(installations > 0);
    CHECK(count_of(text, "<gml:Solid>") + count_of(outcome.err, "E166") == installations + 1);
    CHECK(count_of(text, "<gml:Solid>") > 1);
    const Outcome valid = run({"validate", folder / "a.gml"});
    CAPTURE(valid.err);
    CHECK(valid.exit == 0);
    CHECK(run({"label", sample("house"), "-o", folder / "a.city.json", "--closed-installations"})
              .exit == 2);
  }

  TEST_CASE("a stream becomes the same CityGML and the same GeoPackage whatever the threads") {
    const Folder folder;
    const std::string in = stream_of_cubes(folder);
    for (const std::string name : {"gml", "gpkg"}) {
      REQUIRE(run({"label", in, "-o", folder / ("one." + name)}).exit == 0);
      REQUIRE(run({"label", in, "-j", "3", "-o", folder / ("more." + name)}).exit == 0);
      REQUIRE(run({"label", in, "--isolate", "-o", folder / ("apart." + name)}).exit == 0);
      const std::string bytes = bytes_of(folder / ("one." + name));
      CHECK_FALSE(bytes.empty());
      CHECK(bytes == bytes_of(folder / ("more." + name)));
      CHECK(bytes == bytes_of(folder / ("apart." + name)));
    }
    CHECK(count_of(bytes_of(folder / "one.gml"), "<bldg:Building ") == 5);
    CHECK(bytes_of(folder / "one.gpkg").starts_with("SQLite format 3"));
  }

  TEST_CASE("buildings that nobody says where they lie come with a warning") {
    const Folder folder;
    for (const std::string name : {"a.gml", "a.gpkg"}) {
      const Outcome outcome = run({"label", sample("house"), "-o", folder / name});
      CHECK(outcome.exit == 0);
      CHECK(outcome.says("E161"));
    }
  }

  TEST_CASE("a GeoPackage and CityGML go to stdout with the same bytes") {
    const Folder folder;
    for (const std::string format : {"citygml3", "gpkg"}) {
      REQUIRE(run({"label", sample("house"), "--to", format, "-o", folder / "file"}).exit == 0);
      const Outcome outcome = run({"label", sample("house"), "--to", format, "-o", "-"});
      CHECK(outcome.exit == 0);
      CHECK(outcome.out == bytes_of(folder / "file"));
    }
  }

  TEST_CASE("a GeoPackage that does not fit on the disk is an error and no file") {
    const Folder folder;
    const Outcome outcome =
        run({"label", sample("house"), "-o", folder / "a.gpkg"}, {.file_limit = 20'000});
    CHECK(outcome.exit == 6);
    CHECK(outcome.says("E601"));
    CHECK(folder.names().empty());
  }

  TEST_CASE("generalised buildings are written as CityGML and GeoPackage") {
    const Folder folder;
    for (const std::string name : {"a.gml", "a.gpkg"})
      CHECK(run({"generalise", sample("house"), "--scale", "1:5000", "-o", folder / name}).exit ==
            0);
    CHECK(run({"validate", folder / "a.gml"}).exit == 0);
    CHECK(run({"repair", sample("house"), "-o", folder / "b.gpkg"}).exit == 0);
  }
}

}  // namespace
}  // namespace oriel::test
