#include "io/tiles/tile_building.h"

#include "io/files/output_file.h"
#include "kernel/base/issue.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

FlatMesh triangle(const std::string& label, float size) {
  FlatMesh mesh;
  mesh.features.push_back({"b", "f1", label, "WallSurface", 0.5, "a rule", size});
  mesh.points = {{0, 0, 0}, {size, 0, 0}, {0, 0, size}};
  mesh.normals.assign(3, {0, -1, 0});
  mesh.feature_of.assign(3, 0);
  mesh.triangles = {{0, 1, 2}};
  mesh.edges = {{0, 1}, {1, 2}, {2, 0}};
  return mesh;
}

/// A file in a folder of its own.
class TilesFile {
 public:
  explicit TilesFile(const std::string& bytes)
      : path_((std::filesystem::temp_directory_path() / "oriel_tile_building.part").string()) {
    write_file(path_, bytes);
  }
  ~TilesFile() { std::filesystem::remove(path_); }
  TilesFile(const TilesFile&) = delete;
  TilesFile& operator=(const TilesFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TileBuilding two_levels(const std::string& id) {
  return {id,        "EPSG:25832", {5, 6, 7}, {triangle("window", 2), triangle("wall", 1)},
          {0, 1, 1}, {1.5, 0}};
}

TEST_SUITE("io") {
  TEST_CASE(
      "buildings of a file come one behind the other, with their meshes when they are asked for") {
    const TilesFile file(to_bytes(two_levels("a")) + to_bytes(two_levels("b")));
    const TileBuildings buildings(file.path());
    REQUIRE(buildings.entries().size() == 2);
    const TileEntry& entry = buildings.entries()[1];
    CHECK(entry.id == "b");
    CHECK(entry.crs == "EPSG:25832");
    CHECK(entry.origin_m == Vec3{5, 6, 7});
    CHECK(entry.error_m == std::vector<double>{1.5, 0});
    CHECK(entry.stored_at(2).triangles == 1);
    CHECK(entry.stored_at(2).box == Box{{0, 0, 0}, {1, 0, 1}});
    CHECK(buildings.mesh(entry.stored_at(0)) == triangle("window", 2));
    CHECK(buildings.mesh(entry.stored_at(2)) == triangle("wall", 1));
    CHECK(buildings.labels() == std::set<std::string>{"wall", "window"});
  }

  TEST_CASE("a file of buildings that was cut is refused wherever the cut is") {
    const std::string bytes = to_bytes(two_levels("a"));
    for (std::size_t size = 1; size < bytes.size(); size += 5) {
      const TilesFile file(bytes.substr(0, size));
      CHECK_THROWS_AS(TileBuildings(file.path()), InputError);
    }
    CHECK_THROWS_AS(TileBuildings("/nowhere/at/all"), InputError);
  }
}

}  // namespace
}  // namespace oriel
