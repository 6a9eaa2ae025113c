#include "kernel/mesh/measures.h"

#include "tests/kernel/mesh/meshes.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

using namespace oriel;
using namespace oriel::test;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// A tower with `sides` walls.
Mesh tower(int sides) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces(2);
  for (int i = 0; i < sides; ++i)
    for (const double z : {0.0, 3.0})
      points.push_back({std::cos(2 * kPi * i / sides), std::sin(2 * kPi * i / sides), z});
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    faces[0].push_back(2 * (sides - 1 - i));
    faces[1].push_back(2 * i + 1);
    faces.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
  }
  return Mesh(source_of(points, faces));
}

}  // namespace

TEST_SUITE("kernel/mesh") {
  TEST_CASE("a box has twelve feature edges at right angles however it is triangulated") {
    const Solid box = solid_of(BoxBody().add({0, 0, 0}, {4, 3, 2}).build());
    for (const MeshFaces kind : {MeshFaces::polygons, MeshFaces::triangles}) {
      const auto edges = feature_edges(to_mesh(box, kind));
      REQUIRE(edges.size() == 12);
      for (const FeatureEdge& edge : edges) {
        CHECK(edge.dihedral_deg == doctest::Approx(90).epsilon(1e-12));
        CHECK_FALSE(edge.is_open);
      }
    }
  }

  TEST_CASE("the edges of a recess are ridges outside and valleys inside") {
    const Solid solid =
        solid_of(BoxBody().add({0, 0, 0}, {4, 3, 2}).remove({1, 0, 0.5}, {2, 1, 1.5}).build());
    const auto edges = feature_edges(to_mesh(solid));
    CHECK(edges.size() == 24);
    // Its mouth has four ridges, its sides and its back eight valleys.
    CHECK(std::ranges::count_if(edges, [](const auto& e) { return e.dihedral_deg < 0; }) == 8);
  }

  TEST_CASE("edges with one face are feature edges") {
    const Mesh square(source_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}),
                      MeshFaces::triangles);
    const auto edges = feature_edges(square);
    CHECK(edges.size() == 4);
    CHECK(std::ranges::all_of(edges, &FeatureEdge::is_open));
    CHECK_FALSE(measure(square).is_closed);
  }

  TEST_CASE("the normals of a box are those of its faces and no means") {
    const Mesh mesh = to_mesh(solid_of(BoxBody().add({0, 0, 0}, {4, 3, 2}).build()));
    const auto normals = corner_normals(mesh);
    REQUIRE(normals.size() == 12);
    for (int f = 0; f < mesh.faces(); ++f)
      for (const Vec3 normal : normals[static_cast<std::size_t>(f)])
        CHECK(length(normal - mesh.normal(f)) < 1e-12);
  }

  TEST_CASE("a round tower is smooth around and sharp at its top") {
    const Mesh mesh = tower(24);
    const auto normals = corner_normals(mesh);
    REQUIRE(mesh.findings().open_edges == 0);
    for (int f = 0; f < mesh.faces(); ++f) {
      const std::vector<int> corners = mesh.corners(f);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 p = mesh.point(corners[i]);
        const Vec3 expected = f < 2 ? mesh.normal(f) : Vec3{p.x, p.y, 0};
        CHECK(length(normals[static_cast<std::size_t>(f)][i] - expected) < 1e-9);
      }
    }
    // With a finer crease every wall is flat.
    CHECK(length(corner_normals(mesh, 10)[5][0] - mesh.normal(5)) < 1e-12);
  }

  TEST_CASE("a solid is at no distance from itself") {
    const Solid box = solid_of(BoxBody().add({0, 0, 0}, {4, 3, 2}).build());
    CHECK(hausdorff_m(box, box) == 0);
    CHECK(hausdorff_m(to_mesh(box), to_mesh(box)) <= 0.001);
  }

  TEST_CASE("a chimney is as far from the roof as it is high") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    const Solid bare = solid_of(body.build());
    const Solid with = solid_of(body.add({4, 4, 6}, {5, 5, 7.5}).build());
    CHECK(hausdorff_m(with, bare) == doctest::Approx(1.5).epsilon(0.001));
    CHECK(hausdorff_m(bare, with) == doctest::Approx(1.5).epsilon(0.001));
  }

  TEST_CASE("the bottom of a recess is as far from the filled wall as from the other sides") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    const Solid whole = solid_of(body.build());
    const Solid with = solid_of(body.remove({4, 0, 2}, {6, 5, 4}).build());
    // The middle of its bottom is 3 m from the floor, the top and the back wall.
    CHECK(hausdorff_m(whole, with) == doctest::Approx(3).epsilon(0.01));
  }

  TEST_CASE("what two solids share changes no distance between them") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    const Solid bare = solid_of(body.build());
    // A window, then a bay over it, then a wing: walls and roof become larger and smaller.
    for (const auto& [min, max, is_added] :
         std::vector<std::tuple<Vec3, Vec3, bool>>{{{2, 0, 2}, {3, 0.25, 3}, false},
                                                   {{5, -1, 1}, {7, 0, 4}, true},
                                                   {{10, 0, 0}, {12, 8, 3}, true}}) {
      is_added ? body.add(min, max) : body.remove(min, max);
      const Solid with = solid_of(body.build());
      CHECK(std::abs(hausdorff_m(bare, with) - hausdorff_m(to_mesh(bare), to_mesh(with))) <= 0.002);
      CHECK(std::abs(hausdorff_m(with, bare) - hausdorff_m(bare, with)) <= 0.002);
    }
  }
}
