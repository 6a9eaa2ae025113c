#include "tests/io/files.h"
#include "tests/support/citygml_samples.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace oriel {
namespace {

using namespace test;

/// Reads a file that is broken as a whole and gives the issue that says so.
Issue gml_refusal(const std::string& text) {
  const TemporaryFolder folder;
  const auto records = read_all(folder.write("a.gml", text));
  REQUIRE(!records.empty());
  CHECK_FALSE(records.back().value);
  REQUIRE(records.back().issues.size() == 1);
  const Issue issue = records.back().issues[0];
  CHECK(issue.severity == Severity::error);
  CHECK(issue.place.file.ends_with("a.gml"));
  return issue;
}

/// Reads a file whose first building cannot be used, and whose second can; gives the issue that
/// says why.
Issue loss_of(const std::string& content, const std::string& version = "2.0") {
  const TemporaryFolder folder;
  const CityGmlFile file{version,
                         building("bad", content) + building("next", box_by_links(version, "n"))};
  const auto records = read_all(folder.write("a.gml", file.text()));
  REQUIRE(records.size() == 3);
  REQUIRE(records[1].value);
  CHECK(records[1].value->buildings.empty());
  REQUIRE(records[2].value);
  CHECK(records[2].issues.empty());
  CHECK(records[2].value->buildings.at(0).id == "next");
  REQUIRE(records[1].issues.size() == 1);
  const Issue& issue = records[1].issues[0];
  CHECK(issue.severity == Severity::error);
  CHECK(issue.place.building == "bad");
  CHECK(issue.place.line > 1);
  return issue;
}

std::string lod2(const std::string& members) {
  return element("bldg:lod2MultiSurface", multi_surface(members));
}

std::string lod2_polygon(const std::string& ring_content, const std::string& attributes = "") {
  return lod2(surface_member(
      element("gml:Polygon",
              element("gml:exterior", element("gml:LinearRing", ring_content, attributes)))));
}

TEST_SUITE("io") {
  TEST_CASE("an empty CityGML file is distinguished from a broken one") {
    CHECK(gml_refusal("").code == Code::E102);
    CHECK(gml_refusal(" \n").code == Code::E102);
    CHECK(gml_refusal("<?xml version=\"1.0\"?>\n<!-- no model -->\n").code == Code::E102);
  }

  TEST_CASE("a file that is not XML is refused as CityGML") {
    for (const std::string text :
         {"{\"type\":\"CityJSON\"}", "\x89PNG\r\n", "v 0 0 0\n", "\xFF\xD8\xFF\xE0JFIF"}) {
      CAPTURE(text);
      const Issue issue = gml_refusal(text);
      CHECK(issue.code == Code::E107);
      CHECK(issue.place.line == 1);
    }
  }

  TEST_CASE("XML that is not CityGML and other versions of it are refused") {
    CHECK(gml_refusal("<html><body/></html>").code == Code::E107);
    CHECK(gml_refusal("<CityModel/>").code == Code::E107);
    CHECK(
        gml_refusal("<c:Building xmlns:c=\"http://www.opengis.net/citygml/building/2.0\"/>").code ==
        Code::E107);
    for (const std::string space :
         {"http://www.opengis.net/citygml/4.0", "http://www.citygml.org/citygml/1/0/0"}) {
      const Issue issue = gml_refusal(fmt::format("\n<CityModel xmlns=\"{}\"></CityModel>", space));
      CHECK(issue.code == Code::E115);
      CHECK(issue.place.line == 2);
      CHECK(issue.sentence.find(space.substr(0, 30)) != std::string::npos);
    }
  }

  TEST_CASE("a truncated CityGML file gives its whole buildings and then says that it ends") {
    const std::string text = CityGmlFile{"2.0", building("a", box_by_links("2.0", "p")) +
                                                    building("b", box_by_links("2.0", "q"))}
                                 .text();
    const std::string whole = text.substr(0, text.size() - 1);
    CHECK(gml_refusal(whole.substr(0, whole.size() - 1)).code == Code::E105);
    const TemporaryFolder folder;
    const auto records = read_all(folder.write("a.gml", text.substr(0, text.find("gml:id=\"q3"))));
    REQUIRE(records.size() == 3);
    CHECK(records[1].value->buildings.at(0).id == "a");
    CHECK_FALSE(records[2].value);
    CHECK(codes_of(records[2].issues) == "E105");
  }

  TEST_CASE("XML that is not well-formed has line and column and a caret") {
    const Issue issue = gml_refusal("<a>\n <b></c>\n</a>");
    // The root comes first.
    CHECK(issue.code == Code::E107);
    CityGmlFile file{"2.0", "<x>\n <y></z>\n</x>"};
    const Issue mismatch = gml_refusal(file.text());
    CHECK(mismatch.code == Code::E113);
    CHECK(mismatch.place.line == 4);
    CHECK(mismatch.place.column == 7);
    CHECK(mismatch.excerpt == "   <y></z>\n        ^");
    file.members = "&unknown;";
    CHECK(gml_refusal(file.text()).code == Code::E113);
    file.members = "<x/></c:CityModel><y/><c:CityModel>";
    CHECK(gml_refusal(file.text()).code == Code::E113);
  }

  TEST_CASE("bytes and encodings that are not read are refused") {
    CityGmlFile file{"2.0", element("gml:name", "caf\xE9")};
    const Issue issue = gml_refusal(file.text());
    CHECK(issue.code == Code::E103);
    CHECK(issue.place.line == 3);
    file.declaration = "<?xml version=\"1.0\" encoding=\"KOI8-R\"?>";
    const Issue unknown = gml_refusal(file.text());
    CHECK(unknown.code == Code::E103);
    CHECK(unknown.place.line == 1);
    CHECK(unknown.place.column == 31);
    CHECK(unknown.sentence.find("'KOI8-R'") != std::string::npos);
    file.declaration = "<?xml version=\"1.0\" encoding=\"windows-1252\"?>\n";
    file.members = element("gml:name", "caf\x81");
    const Issue unused = gml_refusal(file.text());
    CHECK(unused.code == Code::E103);
    CHECK(unused.place.line == 3);
    CHECK(unused.place.column == 14);
    CHECK(unused.sentence == "the byte 0x81, which windows-1252 does not have");
  }

  TEST_CASE("entities are refused before they are looked at") {
    CityGmlFile file{"2.0", element("gml:name", "&lol9;")};
    std::string entities = "<!ENTITY lol0 \"lol\">";
    for (int i = 0; i < 9; ++i) {
      std::string ten;
      for (int n = 0; n < 10; ++n) ten += fmt::format("&lol{};", i);
      entities += fmt::format("<!ENTITY lol{} \"{}\">\n", i + 1, ten);
    }
    file.declaration = fmt::format("<?xml version=\"1.0\"?>\n<!DOCTYPE bomb [{}]>\n", entities);
    const Issue bomb = gml_refusal(file.text());
    CHECK(bomb.code == Code::E114);
    CHECK(bomb.place.line == 2);
    file.declaration = "<!DOCTYPE x [<!ENTITY lol9 SYSTEM \"file:///etc/passwd\">]>";
    CHECK(gml_refusal(file.text()).code == Code::E114);
    file.declaration = "<!DOCTYPE x SYSTEM \"http://localhost/x.dtd\">";
    CHECK(gml_refusal(file.text()).code == Code::E114);
  }

  TEST_CASE("nesting and markup without end are refused") {
    std::string deep;
    for (int i = 0; i < 5000; ++i) deep += "<x>";
    CHECK(gml_refusal(CityGmlFile{"2.0", deep}.text()).code == Code::E503);
    std::string open;
    for (int i = 0; i < 5000; ++i) open += "<bldg:consistsOfBuildingPart><bldg:BuildingPart>";
    CHECK(gml_refusal(CityGmlFile{"2.0", building("a", open)}.text()).code == Code::E503);
    CHECK(
        gml_refusal(CityGmlFile{"2.0", fmt::format("<!--{}-->", std::string(40 << 20, 'x'))}.text())
            .code == Code::E505);
  }

  TEST_CASE("coordinates that are none cost their building") {
    struct Case {
      const char* positions;
      Code code;
    };
    for (const Case& c : {Case{"0 0 0 4 0 0 0 3", Code::E210},
                          {"", Code::E210},
                          {"  ", Code::E210},
                          {"0 0 0 4 0 x 0 3 0 0 0 0", Code::E210},
                          {"0 0 0 4,0,0 0 3 0 0 0 0", Code::E210},
                          {"0 0 0 4 0 1e999 0 3 0 0 0 0", Code::E210},
                          {"0 0 0 4 0 nan 0 3 0 0 0 0", Code::E506},
                          {"0 0 0 4 0 -inf 0 3 0 0 0 0", Code::E506},
                          {"0 0 0 4 0 2e9 0 3 0 0 0 0", Code::E506},
                          {"0 0 0 4 0 5000 0 3 0 0 0 0", Code::E501}}) {
      CAPTURE(c.positions);
      CHECK(loss_of(lod2_polygon(element("gml:posList", c.positions))).code == c.code);
    }
    CHECK(loss_of(lod2_polygon("")).code == Code::E210);
    CHECK(loss_of(lod2_polygon(element("gml:pos", "0 0 0 1 1 1"))).code == Code::E210);
    CHECK(loss_of(lod2_polygon(element("gml:posList", "0 0 4 0 0 3 0 0", "srsDimension=\"2\"")))
              .code == Code::E210);
    CHECK(loss_of(
              lod2_polygon(element("gml:posList", "0 0 0 4 0 0 0 3 0 0 0 0"), "srsDimension=\"2\""))
              .code == Code::E210);
  }

  TEST_CASE("latitudes and longitudes are no metres") {
    CHECK(loss_of(lod2_polygon(element("gml:posList",
                                       "35.65898 139.69839 18.9 35.65896 139.69835 18.9 "
                                       "35.65897 139.69834 25 35.65898 139.69839 18.9")))
              .code == Code::E213);
  }

  TEST_CASE("the place of what is wrong in a building is its element") {
    const Issue issue =
        loss_of(fmt::format("\n\n{}", lod2_polygon("\n  <gml:posList>1 2</gml:posList>")));
    CHECK(issue.place.line == 6);
    CHECK(issue.place.column == 3);
  }

  TEST_CASE("polygons and geometries that cannot be read cost their building") {
    CHECK(loss_of(lod2(surface_member(element("gml:Polygon", "")))).code == Code::E201);
    CHECK(
        loss_of(lod2(surface_member(element(
                    "gml:Polygon", element("gml:exterior", ring("0 0 0 1 0 0 0 1 0 0 0 0")) +
                                       element("gml:exterior", ring("0 0 0 1 0 0 0 1 0 0 0 0"))))))
            .code == Code::E201);
    CHECK(loss_of(lod2(surface_member(
                      element("gml:Polygon", element("gml:exterior", element("gml:Ring", ""))))))
              .code == Code::E204);
    CHECK(loss_of(lod2(surface_member(element("gml:Sphere", "")))).code == Code::E204);
    CHECK(loss_of(element("bldg:lod2Solid",
                          element("gml:CompositeSolid",
                                  element("gml:solidMember", element("gml:Box", "")))))
              .code == Code::E204);
    CHECK(loss_of(element("bldg:lod2Solid", solid(""))).code == Code::E313);
  }

  TEST_CASE("links that lead nowhere or out of the building cost it") {
    CHECK(loss_of(lod2(link_to("nowhere"))).code == Code::E211);
    // A polygon of the next building.
    CHECK(loss_of(lod2(link_to("n0"))).code == Code::E211);
    const Issue issue =
        loss_of(lod2("<gml:surfaceMember xlink:href=\"http://localhost/other.gml#p\"/>"));
    CHECK(issue.code == Code::E211);
    CHECK(issue.sentence.find("'http://localhost/other.gml#p'") != std::string::npos);
    CHECK(loss_of("<bldg:lod2Solid xlink:href=\"#s\"/>").code == Code::E211);
    CHECK(loss_of("<bldg:boundedBy xlink:href=\"#s\"/>").code == Code::E211);
    CHECK(loss_of("<c:boundary xlink:href=\"#s\"/>", "3.0").code == Code::E211);
  }

  TEST_CASE("links in a circle cost their building") {
    const auto composite = [](const std::string& id, const std::string& members) {
      return surface_member(
          element("gml:CompositeSurface", members, fmt::format("gml:id=\"{}\"", id)));
    };
    CHECK(loss_of(lod2(composite("a", link_to("a")))).code == Code::E212);
    CHECK(loss_of(lod2(composite("a", link_to("b")) + composite("b", link_to("a")))).code ==
          Code::E212);
    CHECK(loss_of("<bldg:lod2Solid xlink:href=\"#s\"/>" +
                  element("bldg:lod3Solid",
                          element("gml:CompositeSolid", "<gml:solidMember xlink:href=\"#s\"/>",
                                  "gml:id=\"s\"")))
              .code == Code::E212);
  }

  TEST_CASE("links that multiply surfaces cost their building and no time") {
    std::string members = surface_member(polygon("a0", "0 0 0 1 0 0 0 1 0 0 0 0"));
    for (int i = 1; i <= 60; ++i) {
      const std::string link = link_to(fmt::format("a{}", i - 1));
      members += surface_member(
          element("gml:CompositeSurface", link + link, fmt::format("gml:id=\"a{}\"", i)));
    }
    CHECK(loss_of(lod2(members)).code == Code::E212);
    // Surfaces that all link to the same large one.
    std::string large, small;
    for (int i = 0; i < 300; ++i) {
      large += surface_member(polygon("", "0 0 0 1 0 0 0 1 0 0 0 0"));
      small += element("bldg:boundedBy", element("bldg:WallSurface", lod2(link_to("large"))));
    }
    CHECK(loss_of(lod2(surface_member(element("gml:CompositeSurface", large, "gml:id=\"large\""))) +
                  small)
              .code == Code::E212);
  }

  TEST_CASE("parts that all link to the same many surfaces cost their building and no time") {
    std::string openings, parts;
    for (int i = 0; i < 20000; ++i) {
      openings += element("bldg:opening", element("bldg:Window", ""));
      parts += element("bldg:consistsOfBuildingPart",
                       element("bldg:BuildingPart", "<bldg:boundedBy xlink:href=\"#w\"/>"));
    }
    CHECK(
        loss_of(element("x", element("bldg:WallSurface", openings, "gml:id=\"w\"")) + parts).code ==
        Code::E212);
  }

  TEST_CASE("links that lead ever deeper cost their building") {
    const auto chain = [](const std::string& property, const std::string& name,
                          const std::string& inside, int length) {
      std::string content = inside;
      for (int i = 0; i < length; ++i) {
        const std::string next =
            i + 1 < length ? fmt::format("<{} xlink:href=\"#a{}\"/>", property, i + 1) : "";
        content += element(property, element(name, next, fmt::format("gml:id=\"a{}\"", i)));
      }
      return content;
    };
    CHECK(loss_of(
              lod2(link_to("a0") + chain("gml:surfaceMember", "gml:CompositeSurface", "", 100000)))
              .code == Code::E503);
    CHECK(loss_of("<bldg:opening xlink:href=\"#a0\"/>" +
                  element("x", chain("bldg:opening", "bldg:Window", "", 100000)))
              .code == Code::E503);
    CHECK(
        loss_of("<bldg:consistsOfBuildingPart xlink:href=\"#a0\"/>" +
                element("x", chain("bldg:consistsOfBuildingPart", "bldg:BuildingPart", "", 100000)))
            .code == Code::E503);
  }

  TEST_CASE("a building without geometry is reported with a warning") {
    const TemporaryFolder folder;
    const auto records =
        read_all(folder.write("a.gml", CityGmlFile{"2.0", building("a", "")}.text()));
    CHECK(codes_of(records.at(1).issues) == "E209");
    CHECK_FALSE(has_errors(records[1].issues));
    CHECK(records[1].value->buildings.empty());
  }

  TEST_CASE("an id that stands twice in a CityGML file costs the second building") {
    const TemporaryFolder folder;
    const CityGmlFile file{"2.0", building("a", box_by_links("2.0", "p")) +
                                      building("a", box_by_links("2.0", "q")) +
                                      building("b", box_by_links("2.0", "r"))};
    const auto records = read_all(folder.write("a.gml", file.text()));
    REQUIRE(records.size() == 4);
    CHECK(records[1].issues.empty());
    CHECK(codes_of(records[2].issues) == "E207");
    CHECK(records[2].value->buildings.empty());
    CHECK(records[3].issues.empty());
  }

  TEST_CASE("an id that stands twice in a building costs it if a link names it") {
    const std::string twice = surface_member(polygon("p", "0 0 0 1 0 0 0 1 0 0 0 0")) +
                              surface_member(polygon("p", "0 0 1 1 0 1 0 1 1 0 0 1"));
    CHECK(loss_of(lod2(twice + link_to("p"))).code == Code::E207);
    const TemporaryFolder folder;
    const auto records =
        read_all(folder.write("a.gml", CityGmlFile{"2.0", building("a", lod2(twice))}.text()));
    REQUIRE(records.size() == 2);
    CHECK(codes_of(records[1].issues) == "E207");
    CHECK(records[1].issues[0].severity == Severity::warning);
    CHECK(records[1].value->buildings.size() == 1);
  }

  TEST_CASE("a ring that is not closed is read with a warning") {
    const TemporaryFolder folder;
    const auto records = read_all(folder.write(
        "a.gml",
        CityGmlFile{"2.0", building("a", lod2(surface_member(polygon("", "0 0 0 1 0 0 0 1 0"))))}
            .text()));
    CHECK(codes_of(records.at(1).issues) == "E314");
    CHECK(records[1].value->buildings.at(0).polygons.at(0).rings.at(0).size() == 3);
  }

  TEST_CASE("implicit geometries are passed over with a note") {
    const TemporaryFolder folder;
    const auto records = read_all(folder.write(
        "a.gml", CityGmlFile{"2.0", building("a", element("bldg:lod2Solid", box_solid("p")) +
                                                      element("bldg:lod3ImplicitRepresentation",
                                                              element("c:ImplicitGeometry", "")))}
                     .text()));
    CHECK(codes_of(records.at(1).issues) == "E206");
    CHECK(records[1].value->buildings.size() == 1);
  }
}

}  // namespace
}  // namespace oriel
