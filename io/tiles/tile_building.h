#pragma once

#include "io/gltf/flat_mesh.h"
#include "model/vec3.h"

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// A building at all scales of a tileset, from fine to coarse.
struct TileBuilding {
  std::string id;
  /// The coordinate reference system as the input names it, or empty.
  std::string crs;
  /// Where the meshes' origin is in the input's coordinates.
  Vec3 origin_m;
  /// What it looks like, each form once.
  std::vector<FlatMesh> meshes;
  /// Which of them it has at each scale.
  std::vector<std::uint32_t> mesh_at;
  /// How far its form at each scale but the first is from that at the next finer one: the symmetric
  /// Hausdorff distance in metres.
  std::vector<double> error_m;
};

/// What is known of a building without its meshes, which stand in a file.
struct TileEntry {
  /// One of its meshes in the file.
  struct Stored {
    std::uint64_t at = 0, bytes = 0;
    std::uint64_t triangles = 0;
    Box box;  ///< from the building's origin
  };
  std::string id, crs;
  Vec3 origin_m;
  std::vector<Stored> meshes;
  std::vector<std::uint32_t> mesh_at;
  std::vector<double> error_m;

  [[nodiscard]] const Stored& stored_at(std::size_t level) const {
    return meshes.at(mesh_at.at(level));
  }
};

/// A building as bytes of this program's own, which stand one behind the other in a file of
/// buildings.
std::string to_bytes(const TileBuilding& building);

/// A file of buildings, from which a tileset is made.
class TileBuildings {
 public:
  /// Reads all but the meshes. Throws InputError E101 if it cannot be read or is no such file.
  explicit TileBuildings(const std::string& path);
  ~TileBuildings();
  TileBuildings(const TileBuildings&) = delete;
  TileBuildings& operator=(const TileBuildings&) = delete;

  [[nodiscard]] const std::vector<TileEntry>& entries() const { return entries_; }
  /// Of all their features.
  [[nodiscard]] const std::set<std::string>& labels() const { return labels_; }
  [[nodiscard]] const std::set<std::string>& surfaces() const { return surfaces_; }
  /// Any of them has a colour of its own.
  [[nodiscard]] bool has_colours() const { return has_colours_; }

  /// A mesh. Throws InputError E101.
  [[nodiscard]] FlatMesh mesh(const TileEntry::Stored& stored) const;

 private:
  [[nodiscard]] std::string read(std::uint64_t at, std::uint64_t bytes) const;
  [[noreturn]] void fail(const std::string& why) const;
  void read_entries(std::uint64_t size);
  void read_head(std::string_view head, std::uint64_t meshes_at);

  std::string path_;
  int descriptor_ = -1;
  std::vector<TileEntry> entries_;
  std::set<std::string> labels_, surfaces_;
  bool has_colours_ = false;
};

}  // namespace oriel
