#pragma once

#include "io/gltf/glb_writer.h"
#include "io/tiles/tile_building.h"
#include "kernel/base/issue.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace oriel {

/// The name by which `TilesetOptions::crs` asks for a frame of its own.
inline constexpr const char* kLocalFrame = "local";

/// How a tileset is made.
struct TilesetOptions {
  /// Denominators, ascending: those that the buildings have meshes for.
  std::vector<double> scales;
  /// The coordinate reference system of the coordinates; empty: the one that the buildings name;
  /// kLocalFrame: none.
  std::string crs{};
  /// A tile has so many triangles at most, or one building.
  std::uint64_t most_triangles = 20'000;
  GlbOptions glb{};
  /// Every file is a gzip archive under its own name, as servers send it with `Content-Encoding:
  /// gzip`.
  bool has_gzip = false;
};

/// What was written.
struct TilesetFiles {
  /// At one scale.
  struct OfScale {
    double scale = 0;
    std::size_t tiles = 0, buildings = 0;
    std::uint64_t bytes = 0;
  };
  std::vector<OfScale> scales;  ///< in the order of the options
  std::size_t buildings = 0;
};

/// Writes a tileset of 3D Tiles 1.1: FOLDER/tiles/1-N/CELL.glb (write_glb), each as a file that
/// appears whole, and at last FOLDER/tileset.json, a quadtree in which coarser scales stand above
/// finer ones and are replaced by them. The geometric error of a tile is measured (tile_tree). With
/// a coordinate reference system the tileset stands on the earth: each building's coordinates are
/// mapped to east, north and up of the tileset's middle by the affine map that is exact at its
/// origin. Otherwise it stands where its coordinates say, seen from (0, 0, 0).
///
/// Issues: a warning E161 or E162, or E169 if colours are by material and no face has one; an error
/// E207 for each building whose id an earlier one has, which is left out. No value: E160, E163, or
/// E134 for no buildings. Throws OutputError E601, InputError E101.
Checked<TilesetFiles> write_tileset(const std::string& folder, const TileBuildings& buildings,
                                    const TilesetOptions& options);

}  // namespace oriel
