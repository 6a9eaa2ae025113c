#include "io/tiles/tile_tree.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel {
namespace {

using detail::Tile;
using detail::tile_tree;
using detail::TileItem;

/// Buildings in a row, each of three scales with so many triangles and these errors.
class Row {
 public:
  Row(std::size_t buildings, std::vector<std::uint64_t> triangles, std::vector<double> errors) {
    entries_.resize(buildings);
    for (std::size_t b = 0; b < buildings; ++b) {
      TileEntry& entry = entries_[b];
      for (std::size_t level = 0; level < triangles.size(); ++level) {
        entry.meshes.push_back({0, 0, triangles[level], Box{{0, 0, 0}, {8, 8, 8}}});
        entry.mesh_at.push_back(static_cast<std::uint32_t>(level));
      }
      entry.error_m = errors;
    }
  }
  [[nodiscard]] TileEntry& entry(std::size_t b) { return entries_.at(b); }
  [[nodiscard]] Tile tree(std::uint64_t most) const {
    std::vector<TileItem> items;
    for (std::size_t b = 0; b < entries_.size(); ++b) {
      const double x = 10.0 * static_cast<double>(b);
      TileItem item{&entries_[b], {x + 4, 4, 4}, {}};
      for (const auto& mesh : entries_[b].meshes) item.boxes.push_back(mesh.box.moved({x, 0, 0}));
      items.push_back(std::move(item));
    }
    return tile_tree(items, entries_[0].mesh_at.size(), most);
  }

 private:
  std::vector<TileEntry> entries_;
};

template <class Visit>
void for_each_tile(const Tile& tile, const Visit& visit) {
  visit(tile);
  for (const Tile& child : tile.children) for_each_tile(child, visit);
}

std::size_t depth_of(const Tile& tile) {
  std::size_t depth = 0;
  for (const Tile& child : tile.children) depth = std::max(depth, depth_of(child));
  return depth + 1;
}

/// What is seen where every tile is refined down to a scale.
std::vector<std::size_t> seen_at(const Tile& tile, std::size_t level) {
  std::vector<std::size_t> seen;
  if (tile.level <= level && !tile.buildings.empty()) return tile.buildings;
  if (tile.children.empty()) return tile.buildings;
  for (const Tile& child : tile.children) {
    const auto more = seen_at(child, level);
    seen.insert(seen.end(), more.begin(), more.end());
  }
  return seen;
}

bool holds(const Box& outer, const Box& inner) {
  Box both = outer;
  both.grow(inner);
  return both == outer;
}

TEST_SUITE("io") {
  TEST_CASE("a small city is a chain of tiles from coarse to fine") {
    const Tile root = Row(4, {100, 50, 10}, {0.5, 3}).tree(1000);
    CHECK(root.level == 2);
    CHECK(root.error_m == 3);
    CHECK(root.children.at(0).level == 1);
    CHECK(root.children.at(0).error_m == 0.5);
    const Tile& leaf = root.children[0].children.at(0);
    CHECK(leaf.level == 0);
    CHECK(leaf.error_m == 0);
    CHECK(leaf.children.empty());
  }

  TEST_CASE("what is too much for one tile is quartered") {
    const Tile root = Row(4, {100, 50, 10}, {0.5, 3}).tree(100);
    CHECK(root.buildings.size() == 4);
    REQUIRE(root.children.size() == 2);
    CHECK(root.children[0].cell == "r2");
    CHECK(root.children[0].buildings == std::vector<std::size_t>{0, 1});
    CHECK(root.children[0].children.size() == 2);
  }

  TEST_CASE("an error is no less than those below it") {
    const Tile root = Row(2, {100, 50, 10}, {5, 3}).tree(1000);
    CHECK(root.error_m == 5);
  }

  TEST_CASE("a tile whose buildings look the same at the next finer scale is left out") {
    Row row(2, {100, 50, 10}, {0.5, 0});
    for (std::size_t b = 0; b < 2; ++b) row.entry(b).mesh_at = {0, 1, 1};
    const Tile root = row.tree(1000);
    CHECK(root.level == 1);
    CHECK(depth_of(root) == 2);
    row.entry(0).mesh_at = {0, 1, 2};
    CHECK(depth_of(row.tree(1000)) == 3);
  }

  TEST_CASE("a city that is too much at its coarsest scale has tiles without content on top") {
    const Tile root = Row(4, {100, 50, 30}, {0.5, 3}).tree(60);
    CHECK(root.buildings.empty());
    CHECK(root.children.size() == 2);
    CHECK(root.children[0].buildings.size() == 2);
    CHECK(root.error_m >= 38);
  }

  TEST_CASE("buildings at one place do not quarter for ever") {
    Row row(1, {100, 50, 10}, {0.5, 3});
    const TileEntry& entry = row.entry(0);
    const std::vector<TileItem> items(
        3, TileItem{
               &entry,
               {0, 0, 0},
               {Box{{0, 0, 0}, {1, 1, 1}}, Box{{0, 0, 0}, {1, 1, 1}}, Box{{0, 0, 0}, {1, 1, 1}}}});
    const Tile root = tile_tree(items, 3, 10);
    std::set<std::size_t> seen;
    for (const std::size_t b : seen_at(root, 0)) seen.insert(b);
    CHECK(seen.size() == 3);
  }

  TEST_CASE("every building is seen once at each scale, in boxes that hold it") {
    rc::check([] {
      const auto buildings = *rc::gen::inRange<std::size_t>(1, 40);
      const auto most = *rc::gen::inRange<std::uint64_t>(1, 2000);
      Row row(buildings, {100, 50, 10}, {0.5, 3});
      for (std::size_t b = 0; b < buildings; ++b)
        if (*rc::gen::arbitrary<bool>()) row.entry(b).mesh_at = {0, 1, 1};
      const Tile root = row.tree(most);
      for (const std::size_t level : {0U, 1U, 2U}) {
        const auto seen = seen_at(root, level);
        RC_ASSERT(seen.size() == buildings);
        RC_ASSERT(std::set<std::size_t>(seen.begin(), seen.end()).size() == buildings);
      }
      for_each_tile(root, [](const Tile& tile) {
        for (const Tile& child : tile.children) {
          RC_ASSERT(child.error_m <= tile.error_m);
          RC_ASSERT(holds(tile.box, child.box));
        }
        if (tile.children.empty()) RC_ASSERT(tile.error_m == 0);
      });
    });
  }
}

}  // namespace
}  // namespace oriel
