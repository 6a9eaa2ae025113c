#include "io/reader.h"
#include "tests/io/files.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::codes_of;
using test::read_text;

/// A tetrahedron in UTM coordinates.
constexpr const char* kObj =
    "# a house\nmtllib a.mtl\no house\nv 678114.444 5403766.115 414.03\r\nv 678115.444 5403766.115 "
    "414.03\nv 678114.444 5403767.115 414.03 1.0\nv 678114.444 5403766.115 415.03 0.5 0.5 0.5\n"
    "vt 0 0\nvn 0 0 1\ng ground\nusemtl red brick\nf 1/1/1 3//1 2/1\ng\nf -4 -3 -1\ns off\n"
    "f 2 3 \\\n4\nf 3 1 4\n";

TEST_SUITE("io") {
  TEST_CASE("an OBJ file is one building with exact coordinates") {
    const auto record = read_text(kObj, "house.v1.obj");
    CHECK(record.issues.empty());
    REQUIRE(record.value);
    const Building& building = record.value->buildings.at(0);
    CHECK(building.id == "house.v1");
    CHECK(building.lod.empty());
    CHECK(building.is_solid);
    CHECK(building.frame.origin_m == Vec3{678114, 5403766, 414});
    REQUIRE(building.polygons.size() == 4);
    CHECK(building.polygons[0].hint == "house/ground/red brick");
    CHECK(building.polygons[1].hint == "house/red brick");
    CHECK(building.polygons[3].source == 3);
    CHECK(building.vertices[0].y + building.frame.origin_m.y == 5403766.115);
  }

  TEST_CASE("a mesh that is open or in two pieces is no solid") {
    const std::string text = kObj;
    const auto open = read_text(text.substr(0, text.rfind("f 3 1 4")), "a.obj");
    CHECK_FALSE(open.value->buildings.at(0).is_solid);
    const std::string piece = text +
                              "v 678124.5 5403776 414\nv 678123.5 5403776 414\n"
                              "v 678124.5 5403775 414\nv 678124.5 5403776 413\n"
                              "f 5 6 7\nf 6 5 8\nf 7 6 8\nf 5 7 8\n";
    CHECK_FALSE(read_text(piece, "a.obj").value->buildings.at(0).is_solid);
    const auto apart = read_text(text + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 5 6 7\n", "a.obj");
    CHECK(codes_of(apart.issues) == "E501");
  }

  TEST_CASE("points at the same place close a mesh") {
    const auto record = read_text(
        "v 0 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 0 1\nf 4 5 6\n"
        "v 0 0 0\nv 0 0 1\nv 0 1 0\nf 7 8 9\nv 0 0 1\nv 1 0 0\nv 0 1 0\nf 10 11 12\n",
        "a.obj");
    CHECK(record.value->buildings.at(0).is_solid);
  }

  TEST_CASE("an OBJ file may name vertices that come later") {
    CHECK(read_text("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "a.obj").issues.empty());
    const auto record = read_text("f 1 2 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "a.obj");
    CHECK(codes_of(record.issues) == "E203");
    CHECK(record.issues[0].place.column == 7);
  }

  TEST_CASE("what is wrong in an OBJ file is reported with line and column") {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    struct Case {
      const char* line;
      const char* code;
      int column;
    };
    for (const Case& c : {Case{"fo 1 2 3", "E109", 1},
                          {"v 0 0", "E109", 6},
                          {"v 0 0 x", "E109", 7},
                          {"v 0 0 nan", "E506", 7},
                          {"v 0 -inf 0", "E506", 5},
                          {"v 0 0 1e999", "E109", 7},
                          {"f 1 2 9", "E203", 7},
                          {"f 1 2 0", "E203", 7},
                          {"f 1 2 -4", "E203", 7},
                          {"f 1 2 3.0", "E109", 7},
                          {"f 1 2 3/", "E109", 7},
                          {"f 1 2 3/x/1", "E109", 7},
                          {"f 1 2 3/1/1/1", "E109", 7},
                          {"f 1 2", "E311", 6},
                          {"f", "E311", 2}}) {
      const auto record = read_text(vertices + c.line + "\nf 1 2 3\n", "a.obj");
      CAPTURE(c.line);
      CHECK_FALSE(record.value);
      REQUIRE(codes_of(record.issues) == c.code);
      CHECK(record.issues[0].place.line == 4);
      CHECK(record.issues[0].place.column == c.column);
    }
  }

  TEST_CASE("an OBJ file of garbage is given up after twenty findings") {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "garbage\n";
    CHECK(read_text(text, "a.obj").issues.size() == 20);
  }

  TEST_CASE("a mesh file without faces is empty") {
    CHECK(codes_of(read_text("v 0 0 0\n", "a.obj").issues) == "E313");
    CHECK(codes_of(read_text("OFF\n0 0 0\n", "a.off").issues) == "E313");
  }

  TEST_CASE("an OFF file is read with comments and colours") {
    const auto record = read_text(
        "OFF # counts\n# here\n4 4 6\n678114.444 5403766.115 0\n678115 5403766 0 # a\n"
        "678114 5403767 0\n678114 5403766 1\n\n3 0 2 1 255 0 0\n3 0 1 3\n3 1 2 3 0.5\n3 2 0 3\n",
        "a.off");
    CHECK(record.issues.empty());
    REQUIRE(record.value);
    const Building& building = record.value->buildings.at(0);
    CHECK(building.is_solid);
    CHECK(building.polygons.size() == 4);
    CHECK(building.vertices[0].y + building.frame.origin_m.y == 5403766.115);
    CHECK(read_text("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", "a.off").issues.empty());
  }

  TEST_CASE("what is wrong in an OFF file is reported with its line") {
    struct Case {
      const char* text;
      const char* code;
      int line;
    };
    for (const Case& c : {Case{"COFF\n", "E107", 1},
                          {"ply\n", "E107", 1},
                          {"# c\n", "E102", 2},
                          {"OFF\n3 1\n", "E110", 2},
                          {"OFF\n3 1 x\n", "E110", 2},
                          {"OFF\n3 -1 0\n", "E110", 2},
                          {"OFF\n3 1 0 0\n", "E110", 2},
                          {"OFF\n999999999 999999999 0\n0 0 0\n", "E110", 4},
                          {"OFF\n3 999999999 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "E110", 7},
                          {"OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "E110", 4},
                          {"OFF\n3 1 0\n0 0 0\n1 0 0 1\n0 1 0\n3 0 1 2\n", "E110", 4},
                          {"OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "E506", 4},
                          {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "E203", 6},
                          {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "E203", 6},
                          {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n", "E110", 6},
                          {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n999999999 0 1 2\n", "E110", 6},
                          {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "E311", 6},
                          {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 red\n", "E110", 6},
                          {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n", "E110", 7}}) {
      const auto record = read_text(c.text, "a.off");
      CAPTURE(c.text);
      CHECK_FALSE(record.value);
      REQUIRE(codes_of(record.issues) == c.code);
      CHECK(record.issues[0].place.line == c.line);
    }
  }

  TEST_CASE("a PLY file is read with further properties and elements") {
    const auto record = read_text(
        "ply\r\nformat ascii 1.0\r\ncomment a house\nobj_info by hand\nelement material 1\n"
        "property list uchar int parts\nproperty float shine\nelement face 4\nproperty uchar red\n"
        "property list uint8 int32 vertex_index\nproperty list uchar float uv\n"
        "element vertex 4\nproperty float nx\nproperty float64 z\nproperty double y\n"
        "property double x\nend_header\n2 7 8 0.5\n255 3 0 2 1 0\n0 3 0 1 3 2 0.1 0.2\n"
        "0 3 1 2 3 0\n\n0 3 2 0 3 0\n1 0 5403766.115 678114.444\n0 0 5403766 678115\n"
        "0 0 5403767 678114\n0 1 5403766 678114\n",
        "house.ply");
    CHECK(record.issues.empty());
    REQUIRE(record.value);
    const Building& building = record.value->buildings.at(0);
    CHECK(building.id == "house");
    CHECK(building.is_solid);
    CHECK(building.polygons.size() == 4);
    CHECK(building.frame.origin_m == Vec3{678114, 5403766, 0});
    CHECK(building.vertices[0].y + building.frame.origin_m.y == 5403766.115);
  }

  TEST_CASE("what is wrong in a PLY file is reported with its line") {
    const std::string vertex =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    const std::string head = "ply\nformat ascii 1.0\n";
    const std::string whole = head + vertex + face + "end_header\n";
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
    struct Case {
      std::string text;
      const char* code;
      int line;
    };
    for (const Case& c :
         {Case{"OFF\n", "E107", 1},
          {"\n", "E102", 2},
          {"ply x\n", "E110", 1},
          {"ply\n", "E110", 2},
          {"ply\nformat binary 1.0\n", "E110", 2},
          {"ply\nformat ascii 2.0\n", "E110", 2},
          {head, "E110", 3},
          {head + "property float x\n", "E110", 3},
          {head + "element vertex many\n", "E110", 3},
          {head + "element vertex -1\n", "E110", 3},
          {head + "element vertex 3\nproperty real x\n", "E110", 4},
          {head + "element vertex 3\nproperty float\n", "E110", 4},
          {head + "element vertex 3\nproperty float x\nproperty float x\n", "E110", 5},
          {head + "element vertex 3\nelement vertex 3\n", "E110", 4},
          {head + "element vertex 3\nproperty list uchar int x\nend_header\n", "E110", 5},
          {head + "garbage\n", "E110", 3},
          {head + vertex + "end_header\n" + points, "E110", 7},
          {head + face + "end_header\n3 0 1 2\n", "E110", 5},
          {whole + points, "E110", 13},
          {whole + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "E110", 11},
          {whole + "0 0 0\n1 0 0 1\n0 1 0\n3 0 1 2\n", "E110", 11},
          {whole + "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n", "E110", 11},
          {whole + "0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n", "E506", 11},
          {whole + points + "3 0 1 3\n", "E203", 13},
          {whole + points + "3 0 1 -1\n", "E203", 13},
          {whole + points + "4 0 1 2\n", "E110", 13},
          {whole + points + "999999999 0 1 2\n", "E110", 13},
          {whole + points + "-3 0 1 2\n", "E110", 13},
          {whole + points + "2 0 1\n", "E311", 13},
          {whole + points + "3 0 1 2 9\n", "E110", 13},
          {head + vertex + face + "property int feature\nend_header\n" + points + "3 0 1 2 x\n",
           "E110", 14},
          {whole + points + "3 0 1 2\n3 0 1 2\n", "E110", 14}}) {
      const auto record = read_text(c.text, "a.ply");
      CAPTURE(c.text);
      CHECK_FALSE(record.value);
      REQUIRE(codes_of(record.issues) == c.code);
      CHECK(record.issues[0].place.line == c.line);
    }
  }

  TEST_CASE("limits hold for mesh files too") {
    CHECK(codes_of(read_text("v 0 0 0\nv 5000 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj").issues) == "E501");
    const auto far = read_text("v 0 0 0\nv 5e9 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj");
    CHECK(codes_of(far.issues) == "E506");
    CHECK(far.issues[0].place.building == "a");
    CHECK(far.value->buildings.empty());
    const auto thin = read_text("v 0 0 0\nv 0 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj");
    CHECK(codes_of(thin.issues) == "E311");
    CHECK(thin.value->buildings.size() == 1);
  }
}

}  // namespace
}  // namespace oriel
