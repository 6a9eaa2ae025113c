#include "io/tiles/tile_tree.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

namespace oriel::detail {

namespace {

/// So often a cell is quartered at most: cells of centimetres.
constexpr std::size_t kMostDepth = 30;

using TileMembers = std::vector<std::size_t>;

/// A square.
struct QuadCell {
  double x = 0, y = 0;  ///< its middle
  double half = 0;
  std::string path = "r";

  /// 0 south-west, 1 south-east, 2 north-west, 3 north-east.
  [[nodiscard]] std::size_t quadrant_of(Vec3 p) const {
    return (p.x < x ? 0U : 1U) + (p.y < y ? 0U : 2U);
  }
  [[nodiscard]] QuadCell quadrant(std::size_t q) const {
    const double h = half / 2;
    return {x + (q % 2 == 0 ? -h : h), y + (q < 2 ? -h : h), h, path + static_cast<char>('0' + q)};
  }
};

class TileTreeBuilder {
 public:
  TileTreeBuilder(const std::vector<TileItem>& items, std::size_t levels,
                  std::uint64_t most_triangles)
      : items_(items), levels_(levels), most_triangles_(most_triangles) {}

  Tile build() const {
    Box box;
    for (const TileItem& item : items_) box.grow(item.middle);
    const double half = std::max(box.max.x - box.min.x, box.max.y - box.min.y) / 2;
    const QuadCell whole{(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2, half};
    TileMembers all(items_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::vector<Tile> tiles = tiles_of(levels_ - 1, all, whole);
    return tiles.size() == 1 ? std::move(tiles.front()) : above(std::move(tiles), whole);
  }

 private:
  /// The tiles that show these buildings of a cell at a scale, or at a finer one that looks the
  /// same.
  [[nodiscard]] std::vector<Tile> tiles_of(std::size_t level, const TileMembers& buildings,
                                           const QuadCell& cell) const {
    if (is_too_much(level, buildings) && cell.path.size() <= kMostDepth)
      return quarters_of(level, buildings, cell);
    Tile tile{level, level, cell.path, buildings, 0, {}, {}};
    if (level > 0) {
      tile.children = tiles_of(level - 1, buildings, cell);
      if (looks_like_finer(level, buildings)) {
        for (Tile& child : tile.children) child.coarsest_level = level;
        return std::move(tile.children);
      }
    }
    for (const std::size_t b : buildings) {
      tile.box.grow(items_[b].boxes[items_[b].entry->mesh_at[level]]);
      if (level > 0) tile.error_m = std::max(tile.error_m, items_[b].entry->error_m[level - 1]);
    }
    for (const Tile& child : tile.children) {
      tile.box.grow(child.box);
      tile.error_m = std::max(tile.error_m, child.error_m);
    }
    std::vector<Tile> one;
    one.push_back(std::move(tile));
    return one;
  }

  [[nodiscard]] std::vector<Tile> quarters_of(std::size_t level, const TileMembers& buildings,
                                              const QuadCell& cell) const {
    std::array<TileMembers, 4> quarters;
    for (const std::size_t b : buildings) quarters[cell.quadrant_of(items_[b].middle)].push_back(b);
    std::vector<Tile> all;
    for (std::size_t q = 0; q < quarters.size(); ++q) {
      if (quarters[q].empty()) continue;
      std::vector<Tile> tiles = tiles_of(level, quarters[q], cell.quadrant(q));
      std::ranges::move(tiles, std::back_inserter(all));
    }
    if (level + 1 < levels_ || all.size() == 1) return all;
    std::vector<Tile> one;
    one.push_back(above(std::move(all), cell));
    return one;
  }

  /// A tile without content: as long as its children are missing, all of it is.
  [[nodiscard]] Tile above(std::vector<Tile> children, const QuadCell& cell) const {
    Tile tile{levels_ - 1, levels_ - 1, cell.path, {}, 0, {}, std::move(children)};
    for (const Tile& child : tile.children) tile.box.grow(child.box);
    tile.error_m = length(tile.box.max - tile.box.min);
    for (const Tile& child : tile.children) tile.error_m = std::max(tile.error_m, child.error_m);
    return tile;
  }

  [[nodiscard]] bool is_too_much(std::size_t level, const TileMembers& buildings) const {
    std::uint64_t triangles = 0;
    for (const std::size_t b : buildings) triangles += items_[b].entry->stored_at(level).triangles;
    return buildings.size() > 1 && triangles > most_triangles_;
  }

  [[nodiscard]] bool looks_like_finer(std::size_t level, const TileMembers& buildings) const {
    return std::ranges::all_of(buildings, [&](std::size_t b) {
      const auto& mesh_at = items_[b].entry->mesh_at;
      return mesh_at[level] == mesh_at[level - 1];
    });
  }

  const std::vector<TileItem>& items_;
  std::size_t levels_;
  std::uint64_t most_triangles_;
};

}  // namespace

Tile tile_tree(const std::vector<TileItem>& items, std::size_t levels,
               std::uint64_t most_triangles) {
  return TileTreeBuilder(items, levels, most_triangles).build();
}

}  // namespace oriel::detail
