#include "io/reader.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxFile;
using test::codes_of;
using test::read_text;

/// What reading `path` throws, or an issue without a code.
Issue thrown_by(const std::string& path, ReadOptions options = {}) {
  try {
    Reader(path, std::move(options)).next();
  } catch (const InputError& error) {
    return error.issue();
  }
  return {};
}

/// Reads a file that cannot be used and gives its only issue.
Issue refusal_of(const std::string& text, const std::string& name = "a.city.json") {
  const auto record = read_text(text, name);
  CHECK_FALSE(record.value);
  REQUIRE(record.issues.size() == 1);
  CHECK(record.issues[0].severity == Severity::error);
  CHECK(record.issues[0].place.file.ends_with(name));
  return record.issues[0];
}

/// Reads a file whose building "house" cannot be used and gives the issue that says so.
Issue loss_of(const BoxFile& file, ReadOptions options = {}) {
  BoxFile with_neighbour = file;
  with_neighbour.objects +=
      R"(,"next":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2.2",)"
      R"("boundaries":[[[0,3,2,1]]]}]})";
  const auto record = read_text(with_neighbour.text(), "a.city.json", std::move(options));
  REQUIRE(record.value);
  CHECK(record.value->buildings.size() == 1);
  REQUIRE(record.issues.size() == 1);
  CHECK(record.issues[0].severity == Severity::error);
  CHECK(record.issues[0].place.building == "house");
  return record.issues[0];
}

TEST_SUITE("io") {
  TEST_CASE("a missing file is refused with the reason") {
    const Issue issue = thrown_by("/nowhere/a.city.json");
    CHECK(issue.code == Code::E101);
    CHECK(issue.place.file == "/nowhere/a.city.json");
    CHECK(issue.sentence.find("No such file") != std::string::npos);
  }

  TEST_CASE("a folder is refused as a file") {
    CHECK(thrown_by("/tmp", {{}, Format::cityjson}).code == Code::E101);
  }

  TEST_CASE("a format that is unknown or written only is refused") {
    CHECK(thrown_by("a.ifc").code == Code::E106);
    CHECK(thrown_by("-").code == Code::E106);
    CHECK(thrown_by("a.gpkg").code == Code::E106);
    CHECK(thrown_by("a.gml", {{}, Format::citygml3}).code == Code::E106);
  }

  TEST_CASE("an empty file is distinguished from a broken one") {
    for (const char* name : {"a.city.json", "a.obj", "a.off", "a.ply", "a.stl", "a.city.jsonl"})
      CHECK(refusal_of("", name).code == Code::E102);
    CHECK(refusal_of(" \n").code == Code::E102);
  }

  TEST_CASE("a truncated file is distinguished from a broken one and the place is its end") {
    const std::string text = BoxFile().text();
    const Issue issue = refusal_of(text.substr(0, 100));
    CHECK(issue.code == Code::E105);
    CHECK(issue.place.line == 1);
    CHECK(issue.place.column == 101);
  }

  TEST_CASE("a syntax error has line and column and a caret") {
    const Issue issue = refusal_of("{\n  \"type\": \"CityJSON\",\n  \"a\": [1,, 2]\n}\n");
    CHECK(issue.code == Code::E104);
    CHECK(issue.place.line == 3);
    CHECK(issue.place.column == 11);
    CHECK(issue.excerpt == "    \"a\": [1,, 2]\n            ^");
  }

  TEST_CASE("NaN is no JSON") {
    BoxFile file;
    file.vertices = "[[NaN,0,0]]";
    CHECK(refusal_of(file.text()).code == Code::E104);
  }

  TEST_CASE("a file that is not UTF-8 is refused at the byte") {
    BoxFile file;
    file.root = ",\"note\":\"caf\xE9\"";
    const Issue issue = refusal_of(file.text());
    CHECK(issue.code == Code::E103);
    CHECK(issue.place.column == static_cast<int>(file.text().find('\xE9')) + 1);
  }

  TEST_CASE("a PNG is no CityJSON") {
    const Issue issue = refusal_of("\x89PNG\r\n\x1A\n");
    CHECK(issue.code == Code::E107);
    CHECK(issue.sentence.find("PNG") != std::string::npos);
    CHECK(refusal_of("<CityModel/>").code == Code::E107);
    CHECK(refusal_of("[1]").code == Code::E107);
  }

  TEST_CASE("JSON that is not CityJSON is refused") {
    CHECK(refusal_of(R"({"type":"FeatureCollection","features":[]})").code == Code::E107);
    CHECK(refusal_of(R"({"type":3})").code == Code::E107);
    CHECK(refusal_of("{}").code == Code::E107);
  }

  TEST_CASE("versions other than 1.0 and 1.1 and 2.0 are refused") {
    for (const char* version : {R"("0.9")", R"("3.0")", "2.0", "1.0", R"("2.0.1")"}) {
      const Issue issue =
          refusal_of(R"({"type":"CityJSON","version":)" + std::string(version) + "}");
      CHECK(issue.code == Code::E108);
    }
    CHECK(refusal_of(R"({"type":"CityJSON"})").code == Code::E108);
    BoxFile file;
    std::string text = file.text();
    text.replace(text.find("2.0"), 3, "1.1");
    CHECK(read_text(text).issues.empty());
  }

  TEST_CASE("a missing transform or model is refused") {
    const std::string start = R"({"type":"CityJSON","version":"2.0")";
    const std::string transform = R"(,"transform":{"scale":[1,1,1],"translate":[0,0,0]})";
    CHECK(refusal_of(start + R"(,"CityObjects":{},"vertices":[]})").sentence ==
          "has no 'transform', which CityJSON 1.1 and 2.0 require");
    CHECK(refusal_of(start + transform + R"(,"vertices":[]})").code == Code::E201);
    CHECK(refusal_of(start + transform + R"(,"CityObjects":{}})").code == Code::E201);
    CHECK(refusal_of(start + transform + R"(,"CityObjects":[],"vertices":[]})").code == Code::E202);
    CHECK(refusal_of(start + transform + R"(,"CityObjects":{},"vertices":{}})").code == Code::E202);
  }

  TEST_CASE("a transform that is no scale and translation is refused") {
    for (const char* transform :
         {"3", "{}", R"({"scale":[1,1],"translate":[0,0,0]})",
          R"({"scale":[1,1,"1"],"translate":[0,0,0]})", R"({"scale":[0,1,1],"translate":[0,0,0]})",
          R"({"scale":[-1,1,1],"translate":[0,0,0]})"}) {
      BoxFile file;
      file.transform = transform;
      CAPTURE(transform);
      CHECK(refusal_of(file.text()).code == Code::E202);
    }
  }

  TEST_CASE("nesting beyond the limit is refused") {
    BoxFile file;
    file.root = R"(,"deep":)" + std::string(100000, '[') + std::string(100000, ']');
    CHECK(refusal_of(file.text()).code == Code::E503);
    CHECK(refusal_of(R"({"a":)" + std::string(100000, '[')).code == Code::E503);
  }

  TEST_CASE("a number that no 64 bits hold is refused with its place") {
    for (const char* number : {"123456789012345678901234567890", "1e999", "-1e999"}) {
      BoxFile file;
      file.root = R"(,"n":)" + std::string(number);
      const Issue issue = refusal_of(file.text());
      CHECK(issue.code == Code::E504);
      CHECK(issue.place.column == static_cast<int>(file.text().find(number)) + 1);
    }
  }

  TEST_CASE("a file without buildings is a warning") {
    const auto record = read_text(
        R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},)"
        R"("CityObjects":{"t":{"type":"Road"}},"vertices":[]})");
    CHECK(record.value);
    CHECK(codes_of(record.issues) == "E209");
    CHECK(record.issues[0].severity == Severity::warning);
  }

  TEST_CASE("a vertex that is not there costs its building") {
    for (const char* number : {"8", "-1", "99999999999"}) {
      BoxFile file;
      file.boundaries = "[[[[0,3,2,1]],[[4,5,6," + std::string(number) + "]]]]";
      const Issue issue = loss_of(file);
      CHECK(issue.code == Code::E203);
      CHECK(issue.sentence.starts_with("polygon 1 uses vertex " + std::string(number)));
    }
  }

  TEST_CASE("boundaries of a wrong shape cost their building") {
    for (const char* boundaries : {"3", "[3]", "[[3]]", "[[[3]]]", "[[[[\"0\",1,2]]]]",
                                   "[[[[0.5,1,2]]]]", "null", "{}", "[[[[[0,1,2]]]]]"}) {
      BoxFile file;
      file.boundaries = boundaries;
      CAPTURE(boundaries);
      CHECK(loss_of(file).code == Code::E202);
    }
  }

  TEST_CASE("members of a wrong type cost their building") {
    BoxFile file;
    file.lod = "2";
    CHECK(loss_of(file).code == Code::E202);
    file.lod = R"("2","lod":"3")";
    file.building = R"(,"geometry":3)";
    CHECK(read_text(file.text()).value->buildings.size() == 1);
    std::string text = BoxFile().text();
    text.replace(text.find(R"("Building")"), 10, "3");
    CHECK(codes_of(read_text(text).issues) == "E201");
    CHECK(codes_of(read_text(R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],)"
                             R"("translate":[0,0,0]},"CityObjects":{"a":3},"vertices":[]})")
                       .issues) == "E202");
  }

  TEST_CASE("a vertex that is not three whole numbers costs the buildings that use it") {
    for (const char* vertex :
         {"[0,3000]", "[0,3000,2000,0]", "[0,3000,2000.5]", "3", "[0,0,null]"}) {
      BoxFile file;
      file.vertices =
          "[[0,0,0],[4000,0,0],[4000,3000,0],[0,3000,0],[0,0,2000],[4000,0,2000],"
          "[4000,3000,2000]," +
          std::string(vertex) + "]";
      const Issue issue = loss_of(file);
      CHECK(issue.code == Code::E202);
      CHECK(issue.sentence.find("vertex 7") != std::string::npos);
    }
  }

  TEST_CASE("an unknown geometry type costs its building") {
    BoxFile file;
    file.type = "Sphere";
    const Issue issue = loss_of(file);
    CHECK(issue.code == Code::E204);
    CHECK(issue.sentence.find("'Sphere'") != std::string::npos);
  }

  TEST_CASE("no geometry at the level asked for costs the building and names those there are") {
    const Issue issue = loss_of({{},
                                 {},
                                 {},
                                 {},
                                 BoxFile().boundaries,
                                 BoxFile().vertices,
                                 BoxFile().transform,
                                 "Solid",
                                 R"("1.2")"},
                                {"2.2", {}});
    CHECK(issue.code == Code::E205);
    CHECK(issue.sentence == "has no geometry at lod 2.2; it has 1.2");
  }

  TEST_CASE("geometry templates are not read and said so") {
    std::string text = BoxFile().text();
    text.replace(text.find(R"("Solid")"), 7, R"("GeometryInstance")");
    const auto record = read_text(text);
    CHECK(record.value->buildings.empty());
    CHECK(codes_of(record.issues) == "E206 E209");
  }

  TEST_CASE("an id that stands twice is read once") {
    BoxFile file;
    file.objects = R"(,"house":{"type":"Building"})";
    const auto record = read_text(file.text());
    CHECK(record.value->buildings.size() == 1);
    CHECK(codes_of(record.issues) == "E207");
  }

  TEST_CASE("a ring of fewer than three points is a warning with the number of val3dity") {
    for (const char* ring : {"[4,5]", "[4,5,4]", "[4,4,4]", "[]", "[4,8,5]"}) {
      BoxFile file;
      file.vertices.insert(file.vertices.size() - 1, ",[0,0,2000]");
      file.boundaries = "[[[[0,3,2,1]],[" + std::string(ring) + "]]]";
      const auto record = read_text(file.text());
      CAPTURE(ring);
      REQUIRE(record.value->buildings.size() == 1);
      CHECK(record.value->buildings[0].polygons.size() == 2);
      REQUIRE_FALSE(record.issues.empty());
      CHECK(record.issues.back().code == Code::E311);
      CHECK(record.issues.back().severity == Severity::warning);
      CHECK(record.issues.back().sentence ==
            "1 ring has fewer than 3 distinct points, the first in polygon 1 (val3dity 101 "
            "TOO_FEW_POINTS)");
    }
  }

  TEST_CASE("a polygon without an outer ring is left out with its place and the rest is read") {
    for (const char* rings : {"[]", "[[],[4,5,6,7]]", "[[],[4,5,5,6,7],[]]"}) {
      CAPTURE(rings);
      BoxFile file;
      file.boundaries = "[[[[0,3,2,1]]," + std::string(rings) + ",[[0,1,5,4]]]]";
      const auto record = read_text(file.text());
      REQUIRE(record.value->buildings.size() == 1);
      const Building& building = record.value->buildings[0];
      REQUIRE(building.polygons.size() == 3);
      CHECK(building.polygons[1].rings == std::vector<std::vector<int>>{{}});
      CHECK(building.polygons[2].source == 2);
      CHECK(building.repeats.empty());
      CHECK(building.vertices.size() == 6);
      CHECK(codes_of(record.issues) == "E201 E311");
      CHECK(record.issues[0].severity == Severity::warning);
      CHECK(record.issues[0].place.building == building.id);
      CHECK(record.issues[0].sentence ==
            "1 polygon has no exterior ring, the first is polygon 1; nothing of it is read");
    }
  }

  TEST_CASE("shells and solids without polygons are named and the others are read") {
    const std::string shell = "[[[0,3,2,1]],[[4,5,6,7]]]";
    for (const auto& [type, boundaries] : std::vector<std::pair<std::string, std::string>>{
             {"Solid", "[" + shell + ",[]]"},
             {"Solid", "[[]," + shell + "]"},
             {"MultiSolid", "[[],[" + shell + "]]"},
             {"MultiSolid", "[[[]],[" + shell + "]]"},
             {"CompositeSolid", "[[" + shell + "],[]]"}}) {
      CAPTURE(boundaries);
      BoxFile file;
      file.type = type;
      file.boundaries = boundaries;
      const auto record = read_text(file.text());
      REQUIRE(record.value->buildings.size() == 1);
      CHECK(record.value->buildings[0].polygons.size() == 2);
      CHECK(codes_of(record.issues) == "E313");
      CHECK(record.issues[0].severity == Severity::warning);
    }
    for (const char* boundaries : {"[]", "[[]]", "[[],[]]"}) {
      CAPTURE(boundaries);
      BoxFile file;
      file.boundaries = boundaries;
      const auto record = read_text(file.text());
      CHECK(record.value->buildings.empty());
      CHECK(codes_of(record.issues) == "E313");
    }
  }

  TEST_CASE("a vertex named twice in a row is read once with a warning") {
    BoxFile file;
    file.boundaries = "[[[[0,3,3,2,1,0]]]]";
    const auto record = read_text(file.text());
    CHECK(codes_of(record.issues) == "E312");
    CHECK(record.value->buildings.at(0).polygons[0].rings[0].size() == 4);
  }

  TEST_CASE("a geometry without polygons costs its building") {
    for (const char* boundaries : {"[]", "[[]]"}) {
      BoxFile file;
      file.boundaries = boundaries;
      CHECK(loss_of(file).code == Code::E313);
    }
  }

  TEST_CASE("coordinates beyond the limit cost the building") {
    BoxFile file;
    file.vertices.replace(1, 7, "[99999999999999,0,0]");
    std::string text = file.text();
    const auto record = read_text(text);
    CHECK(record.value->buildings.empty());
    CHECK(codes_of(record.issues) == "E506");
    file = {};
    file.transform = R"({"scale":[1e308,1,1],"translate":[0,0,0]})";
    CHECK(codes_of(read_text(file.text()).issues) == "E506");
  }

  TEST_CASE("a building of more than four kilometres is set aside") {
    BoxFile file;
    file.vertices.replace(1, 7, "[4100001,0,0]");
    file.vertices.replace(file.vertices.find("[4000,0,0]"), 10, "[0,0,0]");
    const auto record = read_text(file.text());
    CHECK(record.value->buildings.empty());
    CHECK(codes_of(record.issues) == "E501");
  }

  TEST_CASE("a CityJSONSeq without a header line ends after its first line") {
    const test::TemporaryFolder folder;
    const std::string line = R"({"type":"CityJSONFeature","CityObjects":{},"vertices":[]})";
    const auto records = test::read_all(folder.write("a.city.jsonl", line + "\n" + line + "\n"));
    REQUIRE(records.size() == 1);
    CHECK(codes_of(records[0].issues) == "E107");
    CHECK(records[0].issues[0].place.line == 1);
  }
}

}  // namespace
}  // namespace oriel
