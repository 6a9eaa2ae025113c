#include "io/citygml/citygml_stream.h"
#include "io/cityjson/cityjson_collector.h"
#include "io/writer.h"
#include "tests/io/cityjson_checks.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"
#include "tests/support/citygml_samples.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace oriel {
namespace {

using nlohmann::json;
using namespace test;

/// What came of a CityGML file.
struct Read {
  std::vector<Building> buildings;
  std::vector<Issue> issues;
  /// The file that is written of it.
  json file;
};

Read read_gml(const std::string& text, ReadOptions options = {}) {
  const TemporaryFolder folder;
  Read read;
  CityJsonCollector collector;
  for (auto& record : read_all(folder.write("a.gml", text), std::move(options))) {
    read.issues.insert(read.issues.end(), record.issues.begin(), record.issues.end());
    REQUIRE(record.value);
    collector.add(write_cityjson(*record.value, {}));
    for (Building& building : record.value->buildings)
      read.buildings.push_back(std::move(building));
  }
  read.file = json::parse(collector.text());
  for (const std::string& fault : structural_faults(read.file)) FAIL_CHECK(fault);
  return read;
}

/// A file of one building.
Read read_building(const std::string& content, const std::string& version = "2.0",
                   ReadOptions options = {}, const std::string& codes = "") {
  const Read read =
      read_gml(CityGmlFile{version, building("house", content)}.text(), std::move(options));
  CHECK(codes_of(read.issues) == codes);
  REQUIRE(read.buildings.size() == 1);
  return read;
}

/// The corners of all rings of all polygons, in the input's coordinates.
std::vector<std::vector<std::vector<Vec3>>> places_of(const Building& building) {
  std::vector<std::vector<std::vector<Vec3>>> places;
  for (const Polygon& polygon : building.polygons) {
    auto& rings = places.emplace_back();
    for (const auto& ring : polygon.rings) {
      auto& corners = rings.emplace_back();
      for (const int v : ring)
        corners.push_back(building.vertices[static_cast<std::size_t>(v)] + building.frame.origin_m);
    }
  }
  return places;
}

std::vector<std::string> hints_of(const Building& building) {
  std::vector<std::string> hints;
  for (const Polygon& polygon : building.polygons) hints.push_back(polygon.hint);
  return hints;
}

/// A property of level 2 that holds a surface of one triangle, written as `surface`.
std::string lod2_surface(const std::string& surface) {
  return element("bldg:lod2MultiSurface", multi_surface(surface_member(surface)));
}

const std::string kTriangle = "0 0 0 4 0 0 0 3 0 0 0 0";

TEST_SUITE("io") {
  TEST_CASE("a CityGML building is the same as from CityJSON whose polygons are the same") {
    const auto cityjson = read_text(BoxFile().text());
    const Building& expected = cityjson.value->buildings.at(0);
    for (const std::string version : {"1.0", "2.0", "3.0"}) {
      CAPTURE(version);
      const Read read = read_building(box_by_links(version, "p"), version);
      const Building& building = read.buildings[0];
      CHECK(building.id == "house");
      CHECK(building.lod == "2");
      CHECK(building.is_solid);
      CHECK(building.frame.origin_m == expected.frame.origin_m);
      CHECK(places_of(building) == places_of(expected));
      CHECK(hints_of(building) == std::vector<std::string>{"GroundSurface", "RoofSurface",
                                                           "WallSurface", "WallSurface",
                                                           "WallSurface", "WallSurface"});
      CHECK(building.vertices.size() == 8);
    }
  }

  TEST_CASE("a CityGML file becomes a CityJSON file whose surfaces keep their gml:id") {
    const Read read = read_building(box_by_links("3.0", "p"), "3.0");
    const json& object = read.file["CityObjects"]["house"];
    CHECK(object["type"] == "Building");
    REQUIRE(object["geometry"].size() == 1);
    const json& geometry = object["geometry"][0];
    CHECK(geometry["type"] == "Solid");
    CHECK(geometry["lod"] == "2");
    CHECK(geometry["semantics"]["surfaces"][5] == json{{"type", "WallSurface"}, {"id", "p5s"}});
    CHECK(geometry["semantics"]["values"] == json{{0, 1, 2, 3, 4, 5}});
    CHECK(read.file["transform"]["scale"][0] == 0.001);
    CHECK(read.file["transform"]["translate"] == json{1000, 2000, 10});
  }

  TEST_CASE("several buildings of a CityGML file are written into one file") {
    const Read read = read_gml(
        CityGmlFile{"2.0", building("a", box_by_links("2.0", "p")) +
                               building("b", lod2_surface(polygon("", "9.00001 9 9 8 9 9 8 8 9"))) +
                               building("c", box_by_links("2.0", "q"))}
            .text());
    CHECK(read.buildings.size() == 3);
    CHECK(read.file["CityObjects"].size() == 3);
    CHECK(read.file["vertices"].size() == 8 + 3 + 8);
    CHECK(read.file["transform"]["scale"][0] == 0.00001);
    CHECK(read.file["CityObjects"]["c"]["geometry"][0]["boundaries"][0][0] ==
          json{{11, 12, 13, 14}});
    CHECK(codes_of(read.issues) == "E314");
  }

  TEST_CASE("openings are surfaces below the wall whose hole they fill") {
    const std::string wall =
        polygon("w", "0 0 0 4 0 0 4 0 3 0 0 3 0 0 0", "1 0 1 1 0 2 2 0 2 2 0 1 1 0 1");
    const std::string pane = polygon("o", "1 0.1 1 2 0.1 1 2 0.1 2 1 0.1 2 1 0.1 1");
    const std::string v2 = element(
        "bldg:boundedBy",
        element("bldg:WallSurface",
                element("bldg:lod3MultiSurface", multi_surface(surface_member(wall))) +
                    element("bldg:opening", element("bldg:Window",
                                                    element("bldg:lod3MultiSurface",
                                                            multi_surface(surface_member(pane))),
                                                    "gml:id=\"win\"")),
                "gml:id=\"wall\""));
    const std::string v3 = element(
        "c:boundary",
        element(
            "con:WallSurface",
            element("c:lod3MultiSurface", multi_surface(surface_member(wall))) +
                element("con:fillingSurface",
                        element("con:WindowSurface",
                                element("c:lod3MultiSurface", multi_surface(surface_member(pane))),
                                "gml:id=\"win\"")),
            "gml:id=\"wall\""));
    for (const bool is_v3 : {false, true}) {
      CAPTURE(is_v3);
      const Read read = read_building(is_v3 ? v3 : v2, is_v3 ? "3.0" : "2.0");
      CHECK(hints_of(read.buildings[0]) == std::vector<std::string>{"WallSurface", "Window"});
      CHECK(read.buildings[0].polygons[0].rings.size() == 2);
      CHECK_FALSE(read.buildings[0].is_solid);
      CHECK(read.file["CityObjects"]["house"]["geometry"][0]["semantics"]["surfaces"] ==
            json{{{"type", "WallSurface"}, {"id", "wall"}, {"children", {1}}},
                 {{"type", "Window"}, {"id", "win"}, {"parent", 0}}});
    }
  }

  TEST_CASE("a Window that is a thing of its own in CityGML 3 has its surfaces as one window") {
    const std::string content =
        element("bldg:buildingConstructiveElement",
                element("bldg:BuildingConstructiveElement",
                        element("con:filling",
                                element("con:Window",
                                        element("c:boundary",
                                                element("con:WindowSurface",
                                                        element("c:lod3MultiSurface",
                                                                multi_surface(surface_member(
                                                                    polygon("", kTriangle))))))))));
    const Read read = read_building(content + element("c:lod3Solid", box_solid("p")), "3.0");
    const json& object = read.file["CityObjects"]["house_BuildingConstructiveElement_1"];
    CHECK(object["parents"] == json{"house"});
    CHECK(object["geometry"][0]["semantics"]["surfaces"] == json{{{"type", "Window"}}});
  }

  TEST_CASE("a window that is given as a solid has its faces") {
    const std::string wall = element(
        "bldg:boundedBy",
        element("bldg:WallSurface",
                element("bldg:lod3MultiSurface",
                        multi_surface(surface_member(polygon("", kTriangle)))) +
                    element("bldg:opening",
                            element("bldg:Window", element("bldg:lod3Solid", box_solid("p"))))));
    std::vector<std::string> hints(7, "Window");
    hints[0] = "WallSurface";
    CHECK(hints_of(read_building(wall).buildings[0]) == hints);
  }

  TEST_CASE("curves of a surface are passed over") {
    const std::string curves =
        element("gml:MultiCurve",
                element("gml:curveMember",
                        element("gml:LineString", element("gml:posList", "0 0 0 1 0 0"))));
    const std::string wall = element(
        "c:boundary", element("con:WallSurface",
                              element("c:lod3MultiCurve", curves) +
                                  element("c:lod3MultiSurface",
                                          multi_surface(surface_member(polygon("", kTriangle))))));
    const Read read = read_building(wall, "3.0");
    CHECK(hints_of(read.buildings[0]) == std::vector<std::string>{"WallSurface"});
  }

  TEST_CASE("the level of detail asked for or the highest is read and all are written") {
    const std::string content =
        element("bldg:lod0FootPrint", multi_surface(surface_member(polygon("", kTriangle)))) +
        element("bldg:lod1Solid", box_solid("p")) +
        element("bldg:lod4MultiSurface", multi_surface(surface_member(polygon("", kTriangle))));
    const Read highest = read_building(content);
    CHECK(highest.buildings[0].lod == "4");
    CHECK(highest.file["CityObjects"]["house"]["geometry"].size() == 3);
    CHECK(read_building(content, "2.0", {"1", {}}).buildings[0].is_solid);
    CHECK(read_building(content, "2.0", {"0", {}}).buildings[0].polygons.size() == 1);
    const Read none = read_gml(CityGmlFile{"2.0", building("house", content)}.text(), {"3", {}});
    CHECK(codes_of(none.issues) == "E205");
    CHECK(none.issues[0].place.building == "house");
  }

  TEST_CASE("parts and installations are objects of their own and what is inside is left out") {
    const std::string room = element("bldg:Room", element("bldg:lod4Solid", box_solid("r")));
    const std::string content =
        element("bldg:outerBuildingInstallation",
                element("bldg:BuildingInstallation",
                        element("bldg:lod2Geometry", multi_surface(link_to("p1"))),
                        "gml:id=\"chimney\"")) +
        element("bldg:interiorBuildingInstallation", element("bldg:IntBuildingInstallation", "")) +
        element("bldg:boundedBy",
                element("bldg:InteriorWallSurface",
                        element("bldg:lod4MultiSurface",
                                multi_surface(surface_member(polygon("", kTriangle)))))) +
        element("bldg:interiorRoom", room) +
        element("bldg:consistsOfBuildingPart",
                element("bldg:BuildingPart", element("bldg:lod2Solid", box_solid("p")),
                        "gml:id=\"part\"")) +
        element("bldg:consistsOfBuildingPart",
                element("bldg:BuildingPart", element("bldg:lod2Solid", box_solid("q"))));
    const Read read = read_gml(CityGmlFile{"2.0", building("house", content)}.text());
    CHECK(codes_of(read.issues) == "");
    REQUIRE(read.buildings.size() == 2);
    CHECK(read.buildings[0].id == "part");
    CHECK(read.buildings[1].id == "house_BuildingPart_2");
    const json& objects = read.file["CityObjects"];
    CHECK(objects.size() == 4);
    CHECK(objects["house"]["children"] == json{"chimney", "part", "house_BuildingPart_2"});
    CHECK(objects["part"]["parents"] == json{"house"});
    CHECK(objects["chimney"]["type"] == "BuildingInstallation");
    CHECK(objects["chimney"]["geometry"][0]["boundaries"].size() == 1);
  }

  TEST_CASE("every way to write a surface gives the same polygon") {
    const std::string points =
        element("gml:pos", "0 0 0") + element("gml:pos", "4 0 0") + element("gml:pos", "0 3 0");
    const auto around = [](const std::string& inside) {
      return element("gml:exterior", element("gml:LinearRing", inside));
    };
    const std::string turned = polygon("", "0 0 0 0 3 0 4 0 0 0 0 0");
    const std::vector<std::string> surfaces{
        polygon("", kTriangle),
        polygon("", " \n0\t0 0 4 0 0.0\r\n +0 3e0 0 0 0 0 "),
        element("gml:Polygon", around(points + element("gml:pos", "0 0 0"))),
        element("gml:Polygon", around(element("gml:coordinates", "0,0,0 4,0,0 0,3,0 0,0,0"))),
        element(
            "gml:Polygon",
            around(element("gml:pointProperty", element("gml:Point", element("gml:pos", "0 0 0"))) +
                   element("gml:posList", "4 0 0 0 3 0 0 0 0", "srsDimension=\"3\""))),
        element("gml:CompositeSurface", surface_member(polygon("", kTriangle))),
        element("gml:OrientableSurface", element("gml:baseSurface", turned), "orientation=\"-\""),
        element("gml:OrientableSurface", element("gml:baseSurface", polygon("", kTriangle)),
                "orientation=\"+\""),
        element("gml:TriangulatedSurface",
                element("gml:trianglePatches",
                        element("gml:Triangle", around(element("gml:posList", kTriangle))))),
        element("gml:Surface",
                element("gml:patches",
                        element("gml:PolygonPatch", around(element("gml:posList", kTriangle))))),
        element("gml:OrientableSurface",
                element("gml:baseSurface",
                        element("gml:CompositeSurface",
                                surface_member(
                                    element("gml:OrientableSurface",
                                            element("gml:baseSurface", polygon("", kTriangle)),
                                            "orientation=\"-\"")))),
                "orientation=\"-\"")};
    const std::vector<std::vector<std::vector<Vec3>>> expected{{{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}}};
    for (const std::string& surface : surfaces) {
      CAPTURE(surface);
      auto places = places_of(read_building(lod2_surface(surface)).buildings[0]);
      REQUIRE(places.size() == 1);
      auto& corners = places[0][0];
      std::ranges::rotate(corners, std::ranges::find(corners, Vec3{0, 0, 0}));
      CHECK(places == expected);
    }
    CHECK(read_building(
              element("bldg:lod2MultiSurface",
                      multi_surface(element("gml:surfaceMembers", surfaces[0] + surfaces[5]))))
              .buildings[0]
              .polygons.size() == 2);
  }

  TEST_CASE("boundary surfaces inside the geometry of an installation are its surfaces") {
    const std::string first = polygon("", kTriangle);
    const std::string second = polygon("", "0 0 1 4 0 1 0 3 1 0 0 1");
    const auto surface = [](const std::string& type, const std::string& inside) {
      return element("bldg:boundedBy", element("bldg:" + type, element("bldg:lod3MultiSurface",
                                                                       multi_surface(inside))));
    };
    const std::string chimney = element(
        "bldg:outerBuildingInstallation",
        element("bldg:BuildingInstallation",
                element("bldg:lod3Geometry", surface("WallSurface", surface_member(first)) +
                                                 surface("ClosureSurface", surface_member(second))),
                "gml:id=\"chimney\""));
    const Read read = read_building(element("bldg:lod3Solid", box_solid("p")) + chimney);
    CHECK(read.buildings[0].is_solid);
    const json& geometry = read.file["CityObjects"]["chimney"]["geometry"];
    REQUIRE(geometry.size() == 1);
    CHECK(geometry[0]["lod"] == "3");
    CHECK(geometry[0]["boundaries"].size() == 2);
    CHECK(geometry[0]["semantics"]["surfaces"] ==
          json{{{"type", "WallSurface"}}, {{"type", "ClosureSurface"}}});
    CHECK(geometry[0]["semantics"]["values"] == json{0, 1});
  }

  TEST_CASE("boundary surfaces beside the surfaces of a geometry lose neither") {
    const std::string content =
        element("bldg:lod3MultiSurface",
                element("bldg:boundedBy",
                        element("bldg:RoofSurface",
                                element("bldg:lod3MultiSurface",
                                        multi_surface(surface_member(polygon("", kTriangle)))))) +
                    multi_surface(surface_member(polygon("", "0 0 1 4 0 1 0 3 1 0 0 1"))));
    CHECK(hints_of(read_building(content).buildings[0]) ==
          std::vector<std::string>{"", "RoofSurface"});
  }

  TEST_CASE("several geometries in one property are one") {
    const std::string other = polygon("", "0 0 1 4 0 1 0 3 1 0 0 1");
    const auto surfaces = [](const std::string& one) { return multi_surface(surface_member(one)); };
    const Read read = read_building(
        element("bldg:lod3Geometry", surfaces(polygon("", kTriangle)) + surfaces(other)));
    CHECK(read.buildings[0].polygons.size() == 2);
    const Read solids = read_building(element(
        "bldg:lod3Solid",
        box_solid("p") + solid(surface_member(polygon("", kTriangle)) + surface_member(other))));
    CHECK(solids.file["CityObjects"]["house"]["geometry"][0]["type"] == "MultiSolid");
    CHECK(solids.buildings[0].polygons.size() == 8);
    const Read both = read_building(
        element("bldg:lod3Geometry", box_solid("p") + surfaces(polygon("", kTriangle))), "2.0", {},
        "E215");
    CHECK(both.buildings[0].is_solid);
    CHECK(both.file["CityObjects"]["house"]["geometry"].size() == 2);
  }

  TEST_CASE("a geometry without its property and a property in another are read") {
    const std::string first = polygon("", kTriangle);
    const std::string second = polygon("", "0 0 1 4 0 1 0 3 1 0 0 1");
    for (const std::string& members :
         {surface_member(first + surface_member(second)), surface_member(first) + second,
          surface_member(surface_member(surface_member(first))) + surface_member(second)}) {
      CAPTURE(members);
      const Read read = read_building(element("bldg:lod3MultiSurface", multi_surface(members)));
      CHECK(read.buildings[0].polygons.size() == 2);
    }
    const Read read =
        read_building(element("bldg:lod3Solid", element("gml:MultiSolid", box_solid("p"))));
    CHECK(read.buildings[0].is_solid);
    CHECK(read.buildings[0].polygons.size() == 6);
  }

  TEST_CASE("solids keep their cavities and composites their solids") {
    const std::string cavity =
        element("gml:interior", element("gml:Shell", surface_member(polygon("", kTriangle))));
    std::string with_cavity = box_solid("p");
    with_cavity.insert(with_cavity.rfind("</gml:Solid>"), cavity);
    const Building one = read_building(element("bldg:lod2Solid", with_cavity)).buildings[0];
    CHECK(one.polygons.size() == 7);
    CHECK(one.polygons[6].shell == 1);
    for (const std::string type : {"MultiSolid", "CompositeSolid"}) {
      const Read two = read_building(element(
          "bldg:lod2Geometry",
          element(fmt::format("gml:{}", type), element("gml:solidMember", box_solid("p")) +
                                                   element("gml:solidMember", box_solid("q")))));
      CHECK(two.buildings[0].is_solid);
      CHECK(two.buildings[0].polygons[11].body == 1);
      CHECK(two.file["CityObjects"]["house"]["geometry"][0]["type"] == type);
    }
  }

  TEST_CASE("a solid whose polygons repeat those of boundary surfaces has their semantics") {
    const std::string roof = "bldg:RoofSurface";
    const std::string eaves = polygon("", "1004.5 2000.25 12 1005 2000.25 12 1005 2003.25 12");
    const auto bounded = [&](const std::string& surface) {
      return element(
          "bldg:boundedBy",
          element(roof, element("bldg:lod2MultiSurface", multi_surface(surface_member(surface)))));
    };
    const Read read = read_gml(CityGmlFile{
        "2.0", building("house", element("bldg:lod2Solid", box_solid("p")) +
                                     bounded(polygon("r", box_faces()[1])) + bounded(eaves))}
                                   .text());
    REQUIRE(read.buildings.size() == 1);
    CHECK(hints_of(read.buildings[0]) ==
          std::vector<std::string>{"", "RoofSurface", "", "", "", ""});
    const json& geometries = read.file["CityObjects"]["house"]["geometry"];
    REQUIRE(geometries.size() == 2);
    CHECK(geometries[1]["type"] == "MultiSurface");
    CHECK(geometries[1]["boundaries"].size() == 1);
    CHECK(geometries[1]["semantics"]["surfaces"][0]["type"] == "RoofSurface");
  }

  TEST_CASE("attributes of CityGML are attributes of CityJSON with their types") {
    const std::string solid_2 = element("bldg:lod2Solid", box_solid("p"));
    const std::string v2 =
        element("gml:name", "Town &amp; \"Hall\"") +
        element("gen:stringAttribute", element("gen:value", "x"), "name=\"owner\"") +
        element("gen:intAttribute", element("gen:value", "7"), "name=\"flats\"") +
        element("gen:measureAttribute", element("gen:value", "1.5", "uom=\"m\""), "name=\"wide\"") +
        element("gen:genericAttributeSet",
                element("gen:stringAttribute", element("gen:value", "1985"), "name=\"built\""),
                "name=\"set\"") +
        element("bldg:function", "1000") + element("bldg:function", "1010") +
        element("bldg:yearOfConstruction", "1985") + element("bldg:roofType", " 1030\n") +
        element("bldg:measuredHeight", "5.25", "uom=\"m\"") +
        element("bldg:storeysAboveGround", "two") +
        element("bldg:storeyHeightsAboveGround", "2.5 3") + solid_2;
    CHECK(read_building(v2).file["CityObjects"]["house"]["attributes"] ==
          json{{"name", "Town & \"Hall\""},
               {"owner", "x"},
               {"flats", 7},
               {"wide", 1.5},
               {"set", {{"built", "1985"}}},
               {"function", {"1000", "1010"}},
               {"yearOfConstruction", 1985},
               {"roofType", "1030"},
               {"measuredHeight", 5.25},
               {"storeysAboveGround", "two"},
               {"storeyHeightsAboveGround", {2.5, 3}}});
    const std::string v3 =
        element("c:genericAttribute",
                element("gen:DoubleAttribute",
                        element("gen:name", "wide") + element("gen:value", "1.5"))) +
        element("c:lod2Solid", box_solid("p")) +
        element("con:height",
                element("con:Height", element("con:status", "measured") +
                                          element("con:value", "5.25", "uom=\"m\""))) +
        element("bldg:storeysAboveGround", "2");
    CHECK(read_building(v3, "3.0").file["CityObjects"]["house"]["attributes"] ==
          json{{"wide", 1.5}, {"measuredHeight", 5.25}, {"storeysAboveGround", 2}});
  }

  TEST_CASE("a srsName becomes the reference system") {
    const std::string url = "https://www.opengis.net/def/crs/EPSG/0/25832";
    const std::string local = "urn:adv:crs:ETRS89_UTM32*DE_DHHN92_NH";
    const std::string both = "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783";
    for (const auto& [name, expected] : std::vector<std::pair<std::string, std::string>>{
             {"EPSG:25832", url},
             {"urn:ogc:def:crs:EPSG::25832", url},
             {"urn:ogc:def:crs:EPSG:6.12:25832", url},
             {"http://www.opengis.net/def/crs/EPSG/0/25832", url},
             {local, local},
             {both, both}}) {
      CAPTURE(name);
      const std::string envelope = element(
          "gml:boundedBy", element("gml:Envelope", "", fmt::format("srsName=\"{}\"", name)));
      const std::string content = element("bldg:lod2Solid", box_solid("p"));
      for (const bool is_in_building : {false, true}) {
        CityGmlFile file{"2.0", building("a", (is_in_building ? envelope : "") + content)};
        if (!is_in_building) file.head = envelope;
        const Read read = read_gml(file.text());
        CHECK(read.buildings.at(0).frame.crs == expected);
        CHECK(read.file["metadata"]["referenceSystem"] == expected);
      }
    }
  }

  TEST_CASE("buildings without gml:id are named by their number") {
    const Read read = read_gml(CityGmlFile{"2.0", building("", box_by_links("2.0", "a")) +
                                                      building("x", box_by_links("2.0", "b")) +
                                                      building("", box_by_links("2.0", "c"))}
                                   .text());
    REQUIRE(read.buildings.size() == 3);
    CHECK(read.buildings[0].id == "building_1");
    CHECK(read.buildings[2].id == "building_3");
  }

  TEST_CASE("other objects of the city are passed over") {
    const std::string road = element(
        "c:cityObjectMember",
        "<t:Road xmlns:t=\"http://www.opengis.net/citygml/transportation/2.0\"><t:lod2Solid>" +
            box_solid("p") + "</t:lod2Solid></t:Road>");
    const Read read =
        read_gml(CityGmlFile{"2.0", road + building("a", box_by_links("2.0", "p")) + road}.text());
    CHECK(codes_of(read.issues) == "");
    CHECK(read.file["CityObjects"].size() == 1);
    const Read none = read_gml(CityGmlFile{"2.0", road}.text());
    CHECK(codes_of(none.issues) == "E209");
    CHECK_FALSE(has_errors(none.issues));
  }

  TEST_CASE("a CityGML file may have a byte order mark and CRLF and be in Latin 1") {
    CityGmlFile file{"2.0", building("a", element("gml:name", "Caf\u00e9") +
                                              element("bldg:lod2Solid", box_solid("p")))};
    std::string text = file.text();
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2))
      text.replace(at, 1, "\r\n");
    CHECK(read_gml(fmt::format("\xEF\xBB\xBF{}", text)).buildings.size() == 1);
    file.declaration = "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n";
    text = file.text();
    text.replace(text.find("\u00e9"), 2, "\xE9");
    CHECK(read_gml(text).file["CityObjects"]["a"]["attributes"]["name"] == "Caf\u00e9");
  }

  TEST_CASE("a CityGML file may be in the code page of Windows or in Latin 9") {
    const auto name_of = [](const std::string& encoding, const std::string& name) {
      CityGmlFile file{"2.0", building("a", element("gml:name", name) +
                                                element("bldg:lod2Solid", box_solid("p")))};
      file.declaration = fmt::format("<?xml version=\"1.0\" encoding=\"{}\"?>\n", encoding);
      const Read read = read_gml(file.text());
      CHECK(codes_of(read.issues) == "");
      return read.file["CityObjects"]["a"]["attributes"]["name"].get<std::string>();
    };
    for (const std::string encoding : {"windows-1252", "Windows-1252", "cp1252"})
      CHECK(name_of(encoding, "Caf\xE9 \x96 \x93\x80\x94") ==
            "Caf\u00e9 \u2013 \u201c\u20ac\u201d");
    CHECK(name_of("iso-8859-15", "Caf\xE9 \xA4") == "Caf\u00e9 \u20ac");
    CHECK(name_of("ISO_8859-15", "Caf\xE9 \xA4") == "Caf\u00e9 \u20ac");
    CHECK(name_of("latin1", "Caf\xE9 \xA4") == "Caf\u00e9 \u00a4");
    CHECK(name_of("iso-8859-1", "Caf\xE9 \xA4") == "Caf\u00e9 \u00a4");
  }

  TEST_CASE("a building of a CityGML file is there before the next ones are read") {
    std::string members;
    for (int i = 0; i < 2000; ++i)
      members += building(fmt::format("a{}", i), box_by_links("2.0", fmt::format("p{}", i)));
    const TemporaryFolder folder;
    const std::string text = CityGmlFile{"2.0", members}.text();
    REQUIRE(text.size() > 4'000'000);
    Input input(folder.write("a.gml", text));
    const TextName name{"a.gml", 0};
    detail::CityGmlStream stream(input, name);
    std::size_t count = 0, place = 0;
    while (const auto member = stream.next()) {
      ++count;
      // What was read in advance is two of the input's chunks at most.
      place = text.find(fmt::format("gml:id=\"{}\"", member->id()), place);
      CHECK(input.bytes_read() < place + 600'000);
    }
    CHECK(count == 2000);
    CHECK_FALSE(stream.issue());
  }
}

}  // namespace
}  // namespace oriel
