#include "model/cell_complex.h"

#include <array>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

constexpr CellId kOutside, kLeft{0}, kRight{1}, kAlone{2};

Face square(int plane, CellId front, CellId behind, const Loop& loop) {
  return {PlaneId{plane}, {loop}, front, behind, 1};
}

/// Two cubes of 1 m side by side along x; cell 2 has no faces. Vertex x + 3 y + 6 z.
CellComplex two_cubes() {
  std::vector<Vertex> vertices;
  for (const double z : {0, 1})
    for (const double y : {0, 1})
      for (const double x : {0, 1, 2}) vertices.push_back({{x, y, z}, true});
  std::vector<Face> faces{square(0, kOutside, kLeft, {0, 6, 9, 3}),
                          square(1, kRight, kLeft, {1, 4, 10, 7}),
                          square(2, kOutside, kRight, {2, 5, 11, 8})};
  for (const int x : {0, 1}) {
    const CellId cell{x};
    faces.push_back(square(3, kOutside, cell, {x, x + 1, x + 7, x + 6}));
    faces.push_back(square(4, kOutside, cell, {x + 3, x + 9, x + 10, x + 4}));
    faces.push_back(square(5, kOutside, cell, {x, x + 3, x + 4, x + 1}));
    // Told from the other side.
    faces.push_back(square(6, cell, kOutside, {x + 6, x + 9, x + 10, x + 7}));
  }
  return {vertices, faces, 3};
}

TEST_SUITE("model") {
  TEST_CASE("neighbours are the cells across faces with the area shared, the outside first") {
    const CellComplex complex = two_cubes();
    const auto contacts = complex.neighbours(kLeft);
    REQUIRE(contacts.size() == 2);
    CHECK(contacts[0].cell == kOutside);
    CHECK(contacts[0].area_m2 == 5);
    CHECK(contacts[1].cell == kRight);
    CHECK(contacts[1].area_m2 == 1);
    CHECK(complex.neighbours(kOutside).size() == 2);
    CHECK(complex.neighbours(kAlone).empty());
    CHECK(complex.faces_of(CellId{7}).empty());
  }

  TEST_CASE("the contact of two cells is the same from both and a cell has none with itself") {
    const CellComplex complex = two_cubes();
    CHECK(complex.contact_area_m2(kLeft, kRight) == 1);
    CHECK(complex.contact_area_m2(kRight, kLeft) == 1);
    CHECK(complex.contact_area_m2(kOutside, kRight) == 5);
    CHECK(complex.contact_area_m2(kLeft, kLeft) == 0);
    CHECK(complex.contact_area_m2(kLeft, kAlone) == 0);
  }

  TEST_CASE("the boundary of several cells leaves out what lies between them") {
    const CellComplex complex = two_cubes();
    const std::array both{kLeft, kRight, kLeft};
    CHECK(complex.boundary(both).size() == 10);
    CHECK(complex.boundary_area_m2(both) == 10);
    const auto right = complex.boundary({&kRight, 1});
    REQUIRE(right.size() == 6);
    CHECK(right[0] == BoundaryFace{FaceId{1}, true});
    CHECK(right[1] == BoundaryFace{FaceId{2}, false});
    CHECK(right.back().is_reversed);
    CHECK(complex.boundary({}).empty());
  }

  TEST_CASE("a complex closes around its cells unless a face is missing") {
    const CellComplex whole = two_cubes();
    CHECK(whole.open_edge_count() == 0);
    auto faces = whole.faces();
    faces.erase(faces.begin() + 1);
    // Four edges of either cube.
    CHECK(CellComplex(whole.vertices(), faces, 3).open_edge_count() == 8);
  }

  TEST_CASE("the cells of a feature are its own and those of features found in it") {
    Segmentation s;
    s.features.resize(3);
    s.features[1].parent = FeatureId{0};
    s.features[2].parent = FeatureId{};
    s.cells.resize(4);
    s.cells[1].feature = FeatureId{0};
    s.cells[2].feature = FeatureId{1};
    s.cells[2].sign = -1;
    s.cells[3].feature = FeatureId{2};
    using Ids = std::vector<CellId>;
    CHECK(cells_of(s, FeatureId{0}) == Ids{{1}, {2}});
    CHECK(cells_of(s, FeatureId{1}) == Ids{{2}});
    CHECK(cells_of(s, FeatureId{}).size() == 4);
    CHECK(cells_of_sign(s, -1) == Ids{{2}});
    CHECK(cells_of_sign(s, 1) == Ids{{0}, {1}, {3}});
  }
}

}  // namespace
}  // namespace oriel
