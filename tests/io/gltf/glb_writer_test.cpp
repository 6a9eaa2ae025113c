#include "io/gltf/glb_writer.h"

#include "io/tiles/mesh_bytes.h"
#include "tests/support/glb_reader.h"

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::GlbReader;
using test::GlbRow;

constexpr Vec3 kPlace{85'000, 447'000, 12};

/// A wall of 4 × 3 m with a hole of 1 × 1 m, in which a window lies, in coordinates of a city.
MeshSource wall_with_window() {
  MeshSource source;
  for (const auto& [x, z] : std::vector<std::pair<double, double>>{
           {0, 0}, {4, 0}, {4, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}})
    source.points.push_back(kPlace + Vec3{x, 0, z});
  source.features = {{"house", "wall", ""}, {"house", "window", "w12", 0.75, "a window"}};
  source.polygons = {{{{0, 1, 2, 3}, {7, 6, 5, 4}}, {0, -1, 0}, 0, "WallSurface"},
                     {{{4, 5, 6, 7}}, {0, -1, 0}, 1, "Window"}};
  return source;
}

TEST_SUITE("io") {
  TEST_CASE("a GLB has the faces of a mesh as triangles, where they were") {
    const GlbReader glb(write_glb(wall_with_window()));
    const auto points = glb.points();
    CHECK(points.size() == 12);
    double area_m2 = 0;
    const auto corners = glb.indices();
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      const auto p = points[corners[i]], q = points[corners[i + 1]], r = points[corners[i + 2]];
      const Vec3 normal = cross(Vec3{q[0] - p[0], q[1] - p[1], q[2] - p[2]},
                                Vec3{r[0] - p[0], r[1] - p[1], r[2] - p[2]});
      CHECK(normal.y < 0);
      area_m2 += length(normal) / 2;
    }
    CHECK(area_m2 == doctest::Approx(12));
    std::set<std::array<double, 3>> places(points.begin(), points.end());
    CHECK(places.size() == 8);
    CHECK(places.contains({kPlace.x + 4, kPlace.y, kPlace.z + 3}));
  }

  TEST_CASE("the table of a GLB says what a feature is") {
    const auto rows = GlbReader(write_glb(wall_with_window())).rows();
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].label == "wall");
    CHECK(rows[0].id.empty());
    CHECK(rows[0].score == -1);
    CHECK(rows[0].height == 3);
    CHECK(rows[1].building == "house");
    CHECK(rows[1].id == "w12");
    CHECK(rows[1].label == "window");
    CHECK(rows[1].surface == "Window");
    CHECK(rows[1].rule == "a window");
    CHECK(rows[1].score == 0.75F);
    CHECK(rows[1].height == 1);
    CHECK(rows[1].triangles == 2);
  }

  TEST_CASE("a feature with two types of surfaces has a row for each") {
    MeshSource source = wall_with_window();
    source.polygons[0].feature = 1;
    const auto rows = GlbReader(write_glb(source)).rows();
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].id == rows[1].id);
    CHECK(rows[0].surface == "WallSurface");
    CHECK(rows[1].surface == "Window");
  }

  TEST_CASE("several GLBs have the same enumerations if they are told the names") {
    GlbOptions options;
    options.labels = {"balcony", "wall", "window"};
    options.surfaces = {"RoofSurface"};
    const GlbReader glb(write_glb(wall_with_window(), options));
    const auto& enums = glb.head()["extensions"]["EXT_structural_metadata"]["schema"]["enums"];
    CHECK(enums["label"]["values"].size() == 3);
    CHECK(enums["surface"]["values"].size() == 3);
    CHECK(glb.rows()[1].label == "window");
  }

  TEST_CASE("outlines are the edges of the polygons, each once") {
    GlbOptions options;
    options.has_outlines = true;
    const GlbReader glb(write_glb(wall_with_window(), options));
    const auto& primitives = glb.head()["meshes"][0]["primitives"];
    REQUIRE(primitives.size() == 2);
    CHECK(primitives[1]["mode"] == 1);
    CHECK(glb.indices(1).size() == 2 * 8);
    CHECK(GlbReader(write_glb(wall_with_window())).head()["meshes"][0]["primitives"].size() == 1);
  }

  TEST_CASE("colours are by label, by surface or none") {
    GlbOptions options;
    const std::string by_label = write_glb(wall_with_window(), options);
    options.colours = GlbColours::by_surface;
    CHECK(write_glb(wall_with_window(), options).size() > 0);
    options.colours = GlbColours::none;
    const GlbReader plain(write_glb(wall_with_window(), options));
    const auto has_colours = [](const GlbReader& glb) {
      return glb.head()["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0");
    };
    CHECK(has_colours(GlbReader(by_label)));
    CHECK_FALSE(has_colours(plain));
  }

  TEST_CASE("by material, faces have the colour of theirs, others that of their surface") {
    MeshSource source = wall_with_window();
    source.polygons[0].colour = FaceColour{255, 0, 0, 255};
    GlbOptions options;
    options.colours = GlbColours::by_material;
    const GlbReader glb(write_glb(source, options));
    const auto& primitives = glb.head()["meshes"][0]["primitives"];
    CHECK(primitives.size() == 1);
    const std::string colours = glb.view_bytes(
        glb.head()["accessors"][primitives[0]["attributes"]["COLOR_0"].get<std::size_t>()]
                  ["bufferView"]);
    CHECK(colours.substr(0, 4) == std::string("\xFF\0\0\xFF", 4));
    // The wall's eight points come first.
    options.colours = GlbColours::by_surface;
    CHECK(GlbReader(write_glb(wall_with_window(), options)).view_bytes(2).substr(32) ==
          colours.substr(32));
  }

  TEST_CASE("transparent faces are a primitive of their own, with their rows") {
    MeshSource source = wall_with_window();
    source.polygons[1].colour = FaceColour{0, 0, 255, 128};
    GlbOptions options;
    options.colours = GlbColours::by_material;
    options.has_outlines = true;
    const GlbReader glb(write_glb(source, options));
    const auto &head = glb.head(), &primitives = head["meshes"][0]["primitives"];
    REQUIRE(primitives.size() == 3);
    CHECK(primitives[1]["mode"] == 1);
    CHECK(head["materials"][primitives[2]["material"].get<std::size_t>()]["alphaMode"] == "BLEND");
    CHECK(glb.indices(0).size() + glb.indices(2).size() == 3 * (8 + 2));
    CHECK(glb.indices(2).size() == 3 * 2);
    // By label nothing is transparent.
    options.colours = GlbColours::by_label;
    CHECK(GlbReader(write_glb(source, options)).head()["meshes"][0]["primitives"].size() == 2);
  }

  TEST_CASE("a compressed GLB has the same vertices and indices, byte for byte") {
    MeshSource source;
    source.features = {{"city", "roof", "r1"}};
    for (int i = 0; i < 100; ++i) {
      const double x = 0.37 * i;
      for (const Vec3 p : {Vec3{x, 0, 0.1 * i}, Vec3{x + 1, 0, 0}, Vec3{x, 1, 0}})
        source.points.push_back(p);
      source.polygons.push_back({{{3 * i, 3 * i + 1, 3 * i + 2}}, {0, 0, 1}, 0, "RoofSurface"});
    }
    GlbOptions options;
    options.has_outlines = true;
    const std::string bytes = write_glb(source, options);
    options.compression = GlbCompression::meshopt;
    const std::string packed_bytes = write_glb(source, options);
    CHECK(packed_bytes == write_glb(source, options));
    CHECK(packed_bytes.size() < bytes.size());
    const GlbReader plain(bytes), packed(packed_bytes);
    CHECK(packed.head()["extensionsRequired"] == nlohmann::json{"EXT_meshopt_compression"});
    CHECK_FALSE(plain.head().contains("extensionsRequired"));
    CHECK(packed.head()["buffers"].size() == 2);
    const auto views = plain.head()["bufferViews"].size();
    REQUIRE(packed.head()["bufferViews"].size() == views);
    for (std::size_t view = 0; view < views; ++view)
      CHECK(packed.view_bytes(view) == plain.view_bytes(view));
    CHECK(packed.rows().size() == plain.rows().size());
  }

  TEST_CASE("what compression would enlarge stays as it is") {
    MeshSource source;
    source.features = {{"house", "roof", ""}};
    source.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    source.polygons = {{{{0, 1, 2}}, {0, 0, 1}, 0, "RoofSurface"}};
    GlbOptions options;
    const std::string plain = write_glb(source, options);
    options.compression = GlbCompression::meshopt;
    const GlbReader glb(write_glb(source, options));
    CHECK(glb.points().size() == 3);
    CHECK(glb.rows().at(0).triangles == 1);
  }

  TEST_CASE("a mesh without faces is a GLB with an empty scene") {
    const GlbReader glb(write_glb(MeshSource{}));
    CHECK(glb.head()["scenes"].size() == 1);
    CHECK_FALSE(glb.head().contains("meshes"));
  }

  TEST_CASE("polygons without area are left out, as their normal has no direction") {
    MeshSource source = wall_with_window();
    source.points.push_back(kPlace + Vec3{2, 0, 0});
    source.polygons.push_back({{{0, 8, 1}}, {}, 0, "RoofSurface"});
    const GlbReader glb(write_glb(source));
    CHECK(glb.points().size() == 12);
    CHECK(glb.rows().size() == 2);
  }

  TEST_CASE("a mesh of more than 65,535 points has long indices") {
    MeshSource source;
    source.features = {{"city", "roof", ""}};
    for (int i = 0; i < 22'000; ++i) {
      const double x = 2 * i;
      for (const Vec3 p : {Vec3{x, 0, 0}, Vec3{x + 1, 0, 0}, Vec3{x, 1, 0}})
        source.points.push_back(p);
      source.polygons.push_back({{{3 * i, 3 * i + 1, 3 * i + 2}}, {0, 0, 1}, 0, "RoofSurface"});
    }
    const GlbReader glb(write_glb(source));
    CHECK(glb.indices().back() == 65'999);
    CHECK(glb.rows().at(0).triangles == 22'000);
  }

  TEST_CASE("a mesh goes through bytes unchanged, and bytes that are cut are none") {
    const FlatMesh mesh = flat_mesh(wall_with_window(), kPlace);
    const std::string bytes = detail::to_bytes(mesh);
    CHECK(detail::flat_mesh_of(bytes) == mesh);
    for (std::size_t size = 0; size < bytes.size(); size += 7)
      CHECK_THROWS(detail::flat_mesh_of(bytes.substr(0, size)));
    CHECK_THROWS(detail::flat_mesh_of(bytes + "x"));
  }

  TEST_CASE("a mesh that is placed has turned normals") {
    FlatMesh mesh;
    Placement turned;
    turned.columns = {Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}};
    turned.origin = {10, 20, 30};
    append(mesh, flat_mesh(wall_with_window(), kPlace), turned);
    CHECK(mesh.normals[0] == FlatMesh::Point{1, 0, 0});
    CHECK(box_of(mesh) == Box{{10, 20, 30}, {10, 24, 33}});
  }
}

}  // namespace
}  // namespace oriel
