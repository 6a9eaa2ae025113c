#include "kernel/mesh/mesh.h"

#include "kernel/mesh/measures.h"
#include "tests/kernel/mesh/meshes.h"

#include <algorithm>
#include <cmath>

using namespace oriel;
using namespace oriel::test;

namespace {

/// A house with a recess, a bump and a through hole: facets with holes, reflex corners.
BoxBody house() {
  return BoxBody()
      .add({0, 0, 0}, {10, 8, 6})
      .remove({2, 0, 1}, {3, 0.5, 3})
      .add({6, -0.5, 2}, {7, 0, 3})
      .remove({4, 0, 4}, {5, 8, 5})
      .add({4, 3, 6}, {5, 4, 7.5});
}

/// Two unit cubes that share the edge over (1, 1).
std::vector<Vec3> cube_points(Vec3 at) {
  std::vector<Vec3> points;
  for (const double z : {0.0, 1.0})
    for (const Vec3 p : {Vec3{0, 0, z}, Vec3{1, 0, z}, Vec3{1, 1, z}, Vec3{0, 1, z}})
      points.push_back(at + p);
  return points;
}

const std::vector<std::vector<int>> kCube{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                          {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

MeshSource cubes_at_an_edge() {
  std::vector<Vec3> points = cube_points({0, 0, 0});
  std::vector<std::vector<int>> faces = kCube;
  // Corner 0 of the second is corner 2 of the first, and 4 is 6.
  std::vector<int> number{2, 8, 9, 10, 6, 11, 12, 13};
  const std::vector<Vec3> second = cube_points({1, 1, 0});
  for (const int v : {1, 2, 3, 5, 6, 7}) points.push_back(second[static_cast<std::size_t>(v)]);
  for (const auto& face : kCube) {
    faces.emplace_back();
    for (const int v : face) faces.back().push_back(number[static_cast<std::size_t>(v)]);
  }
  return source_of(points, faces);
}

std::size_t edges_of(const Solid& solid) {
  std::size_t half_edges = 0;
  for (const Facet& facet : solid.facets)
    for (const Loop& loop : facet.loops) half_edges += loop.size();
  return half_edges / 2;
}

}  // namespace

TEST_SUITE("kernel/mesh") {
  TEST_CASE("a solid as a mesh keeps its vertices and facets") {
    const Solid solid = solid_of(house().build());
    for (const MeshFaces kind : {MeshFaces::polygons, MeshFaces::convex, MeshFaces::triangles}) {
      const Mesh mesh = to_mesh(solid, kind);
      REQUIRE(mesh.originals() == static_cast<int>(solid.vertices.size()));
      for (int v = 0; v < mesh.originals(); ++v)
        CHECK(mesh.point(v) == solid.vertices[static_cast<std::size_t>(v)].point);
      CHECK(mesh.findings().non_manifold_edges == 0);
      CHECK(mesh.findings().open_edges == 0);
      CHECK(mesh.findings().shells == 1);
      const MeshMeasures sizes = measure(mesh);
      CHECK(sizes.is_closed);
      CHECK(sizes.euler == 0);  // the tunnel is a handle
      CHECK(sizes.volume_m3 == doctest::Approx(volume_m3(solid)).epsilon(1e-12));
      CHECK(sizes.area_m2 == doctest::Approx(surface_m2(solid)).epsilon(1e-12));
      for (int f = 0; f < mesh.faces(); ++f) {
        const Facet& facet = solid.facets[mesh.facet(f).index()];
        CHECK(mesh.normal(f) == solid.planes[facet.plane.index()].normal);
        if (facet.loops.size() == 1 && kind == MeshFaces::polygons)
          CHECK(mesh.corners(f) == facet.loops[0]);
        if (kind == MeshFaces::triangles) CHECK(mesh.corners(f).size() == 3);
      }
    }
  }

  TEST_CASE("a solid comes back from its mesh") {
    const Solid solid = solid_of(house().build());
    for (const MeshFaces kind : {MeshFaces::polygons, MeshFaces::triangles}) {
      const Solidified back = to_solid(to_mesh(solid, kind));
      REQUIRE(back.value);
      CHECK(back.value->facets.size() == solid.facets.size());
      CHECK(back.value->vertices.size() == solid.vertices.size());
      CHECK(edges_of(*back.value) == edges_of(solid));
      CHECK(volume_m3(*back.value) == doctest::Approx(volume_m3(solid)).epsilon(1e-12));
    }
  }

  TEST_CASE("a cavity comes back from its mesh") {
    const Solid solid =
        solid_of(BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({2, 2, 2}, {4, 4, 4}).build());
    REQUIRE(solid.shells.size() == 2);
    const Solidified back = to_solid(to_mesh(solid));
    REQUIRE(back.value);
    CHECK(back.value->shells.size() == 2);
    CHECK(volume_m3(*back.value) == doctest::Approx(472).epsilon(1e-12));
  }

  TEST_CASE("bodies that touch along an edge come apart and come back together") {
    const Mesh mesh(cubes_at_an_edge());
    CHECK(mesh.faces() == 12);
    CHECK(mesh.findings().non_manifold_edges == 1);
    CHECK(mesh.findings().open_edges == 0);
    CHECK(mesh.findings().shells == 2);
    CHECK(mesh.findings().doubled_vertices == 2);
    CHECK(mesh.findings().loose_faces == 0);
    CHECK(measure(mesh).euler == 4);
    CHECK(measure(mesh).volume_m3 == doctest::Approx(2));
    CHECK(mesh.vertices() == mesh.originals() + 2);
    CHECK(mesh.point(mesh.originals()) == mesh.point(mesh.original(mesh.originals())));
    const MeshSource again = mesh_source(mesh);
    REQUIRE(again.polygons.size() == 12);
    for (std::size_t f = 0; f < 12; ++f)
      CHECK(again.polygons[f].rings == cubes_at_an_edge().polygons[f].rings);
    const Solidified solid = to_solid(mesh);
    REQUIRE(solid.value);
    CHECK(volume_m3(*solid.value) == doctest::Approx(2));
  }

  TEST_CASE("material that meets at an edge from two sides stays in one piece elsewhere") {
    // A wall with two notches whose corners touch: one solid, one edge with four facets.
    const Solid solid = solid_of(BoxBody()
                                     .add({0, 0, 0}, {4, 2, 4})
                                     .remove({1, 0, 1}, {2, 1, 2})
                                     .remove({2, 0, 2}, {3, 1, 3})
                                     .build());
    const Mesh mesh = to_mesh(solid);
    CHECK(measure(mesh).is_closed);
    CHECK(mesh.findings().non_manifold_edges == 1);
    CHECK(mesh.findings().loose_faces == 0);
    CHECK(measure(mesh).volume_m3 == doctest::Approx(30));
    const Solidified back = to_solid(mesh);
    REQUIRE(back.value);
    CHECK(back.value->facets.size() == solid.facets.size());
    CHECK(volume_m3(*back.value) == doctest::Approx(30));
  }

  TEST_CASE("a third face at an edge is kept as an open one") {
    const Mesh mesh(source_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                              {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
    CHECK(mesh.faces() == 3);
    CHECK(mesh.findings().non_manifold_edges == 1);
    CHECK(mesh.findings().doubled_vertices == 2);
    for (int f = 0; f < 3; ++f) CHECK(mesh.ring(f).size() == 3);
    CHECK(mesh.ring(2) == std::vector{0, 1, 4});
  }

  TEST_CASE("a face that fits nowhere keeps its place and shape") {
    // A Möbius strip of five quadrilaterals: the last one runs against the first.
    std::vector<Vec3> points;
    std::vector<std::vector<int>> faces;
    for (int i = 0; i < 5; ++i)
      for (const double side : {-1.0, 1.0}) {
        const double turn = i * 2 * 3.14159265358979323846 / 5;
        const double r = 4 + side * std::cos(turn / 2);
        points.push_back({r * std::cos(turn), r * std::sin(turn), side * std::sin(turn / 2)});
      }
    for (int i = 0; i < 4; ++i) faces.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    faces.push_back({8, 1, 0, 9});
    const Mesh mesh(source_of(points, faces));
    CHECK(mesh.faces() == 5);
    for (int f = 0; f < 5; ++f) CHECK(mesh.ring(f) == faces[static_cast<std::size_t>(f)]);
    CHECK_FALSE(measure(mesh).is_closed);
  }

  TEST_CASE("a ring that comes by a vertex twice is kept") {
    // Two triangles that touch in a point, as one ring.
    const Mesh mesh(source_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
                              {{0, 1, 2, 0, 3, 4}}));
    CHECK(mesh.faces() == 1);
    CHECK(mesh.ring(0) == std::vector{0, 1, 2, 0, 3, 4});
    CHECK(mesh.findings().doubled_vertices == 1);
  }

  TEST_CASE("a polygon without area is counted where triangles are asked for") {
    const MeshSource line = source_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2, 3}});
    CHECK(Mesh(line).faces() == 1);
    CHECK(Mesh(line, MeshFaces::triangles).faces() == 0);
    CHECK(Mesh(line, MeshFaces::triangles).findings().empty_polygons == 1);
  }

  TEST_CASE("faces know their feature and label and surface") {
    MeshSource source = source_of(cube_points({0, 0, 0}), kCube);
    source.features = {{"house", "window", "w1"}};
    source.polygons[2].feature = 0;
    source.polygons[2].surface = "Window";
    const Mesh mesh(source, MeshFaces::triangles);
    CHECK(mesh.feature(3) == -1);
    CHECK(mesh.label(3).empty());
    CHECK(mesh.feature(4) == 0);
    CHECK(mesh.label(4) == "window");
    CHECK(mesh.surface(5) == "Window");
    const Mesh copy = mesh;
    CHECK(copy.label(5) == "window");
    CHECK(copy.point(6) == Vec3{1, 1, 1});
  }
}
