#pragma once

#include "io/tiles/tile_building.h"
#include "model/vec3.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace oriel::detail {

/// A tile: buildings of one cell of the quadtree at one scale, and what takes its place for a
/// nearer view.
struct Tile {
  /// The scale's number, from fine to coarse.
  std::size_t level = 0;
  /// The coarsest scale at which all its buildings look the same.
  std::size_t coarsest_level = 0;
  /// The way from the root of the quadtree: "r", "r0", "r03" …
  std::string cell;
  /// Numbers of buildings, ascending; none: the tile has no content.
  std::vector<std::size_t> buildings;
  /// What is seen where the children are not, at most, in metres; no less than that of a child.
  double error_m = 0;
  /// Round its content and that of all below, in the frame of the tileset.
  Box box;
  std::vector<Tile> children;
};

/// A building as the tree sees it.
struct TileItem {
  const TileEntry* entry = nullptr;
  /// By which it is sorted into cells.
  Vec3 middle;
  /// Around each of its meshes.
  std::vector<Box> boxes;
};

/// The tree of tiles over all buildings at so many scales. A tile has `most_triangles` at most, or
/// one building. Its error is the greatest Hausdorff distance between a building in it and the same
/// building in a tile below, made no less than those below it; leaves have 0. Tiles whose buildings
/// look the same at the next finer scale are left out. Where even the coarsest scale is too much
/// for one tile, tiles without content stand above. Every building is in one tile of each scale
/// that has tiles of it. `items` is not empty.
Tile tile_tree(const std::vector<TileItem>& items, std::size_t levels,
               std::uint64_t most_triangles);

}  // namespace oriel::detail
