#include "io/mesh/mesh_writer.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::codes_of;
using test::read_text;

using Corners = std::array<std::array<float, 3>, 3>;

/// A binary STL that promises `count` triangles.
std::string binary(const std::vector<Corners>& triangles, std::uint32_t count,
                   const std::string& head = "solid that is none") {
  std::string bytes = head;
  bytes.resize(80);
  const auto append = [&](const auto& number) {
    const auto raw = std::bit_cast<std::array<char, sizeof number>>(number);
    bytes.append(raw.data(), raw.size());
  };
  append(count);
  for (const Corners& corners : triangles) {
    for (int axis = 0; axis < 3; ++axis) append(0.0F);
    for (const auto& corner : corners)
      for (const float x : corner) append(x);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

const std::vector<Corners>& tetrahedron() {
  static const std::vector<Corners> triangles{{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}},
                                              {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}},
                                              {{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                              {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}};
  return triangles;
}

constexpr const char* kFacet =
    "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\n"
    "endfacet\n";

TEST_SUITE("io") {
  TEST_CASE("an STL that oriel wrote is read as the same closed building") {
    const auto box = read_text(test::BoxFile().text());
    MeshSource mesh;
    append_mesh(mesh, *box.value, {});
    const auto back = read_text(write_stl(mesh), "house.stl");
    CHECK(back.issues.empty());
    REQUIRE(back.value);
    const Building& building = back.value->buildings.at(0);
    CHECK(building.id == "house");
    CHECK(building.is_solid);
    CHECK(building.polygons.size() == 12);
    CHECK(building.vertices.size() == 8);
    CHECK(building.polygons[0].hint == "unlabelled");
    Box bounds;
    for (const Vec3 vertex : building.vertices) bounds.grow(vertex + building.frame.origin_m);
    CHECK(bounds == Box{{1000.5, 2000.25, 10}, {1004.5, 2003.25, 12}});
  }

  TEST_CASE("a binary STL is told by its size whatever its first word") {
    for (const char* head : {"solid that is none", "", "binary"}) {
      const auto record = read_text(binary(tetrahedron(), 4, head), "a.stl");
      CAPTURE(head);
      CHECK(record.issues.empty());
      REQUIRE(record.value);
      CHECK(record.value->buildings.at(0).is_solid);
      CHECK(record.value->buildings.at(0).vertices.size() == 4);
    }
  }

  TEST_CASE("the words of an STL may be upper case and lines may end anywhere") {
    const auto record = read_text(
        "SOLID roof red\r\nFacet Normal 0 0 nan outer loop vertex 0 0 -0 vertex\n0 1 0\nvertex 1 0 "
        "0\nEndLoop EndFacet\nENDSOLID\n\nsolid\nendsolid\n",
        "a.stl");
    REQUIRE(record.value);
    CHECK(record.value->buildings.at(0).polygons.at(0).hint == "roof red");
  }

  TEST_CASE("what is wrong in an STL file is reported with its line") {
    struct Case {
      std::string text;
      const char* code;
      int line;
    };
    const std::string facet = kFacet;
    for (const Case& c :
         {Case{"obj\n", "E107", 1},
          {"solid a\n" + facet, "E105", 9},
          {"solid a\nface\nendsolid\n", "E167", 2},
          {"solid a\nfacet normal 0 0\nouter loop\n", "E167", 3},
          {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nvertex", "E167", 5},
          {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n", "E506", 4},
          {"solid a\n" + facet + "endsolid a\nmore\n", "E167", 10},
          {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
           "vertex 0 1 0\nvertex 1 1 0\n",
           "E167", 7}}) {
      const auto record = read_text(c.text, "a.stl");
      CAPTURE(c.text);
      CHECK_FALSE(record.value);
      REQUIRE(codes_of(record.issues) == c.code);
      CHECK(record.issues[0].place.line == c.line);
    }
    CHECK(codes_of(read_text("solid a\nendsolid\n", "a.stl").issues) == "E313");
  }

  TEST_CASE("a binary STL whose size is not what it promises is refused before it is read") {
    const auto huge = read_text(binary(tetrahedron(), 4'294'967'295U, "x"), "a.stl");
    CHECK(codes_of(huge.issues) == "E105");
    CHECK(codes_of(read_text(binary(tetrahedron(), 3, "x"), "a.stl").issues) == "E167");
    CHECK(codes_of(read_text(binary({}, 0, "x"), "a.stl").issues) == "E313");
    auto triangles = tetrahedron();
    triangles[2][1][0] = std::numeric_limits<float>::quiet_NaN();
    CHECK(codes_of(read_text(binary(triangles, 4), "a.stl").issues) == "E506");
  }
}

}  // namespace
}  // namespace oriel
