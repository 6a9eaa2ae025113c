#include "examples/generator/house/plinth.h"

#include "examples/generator/house/extrude.h"

#include <array>

namespace oriel::generator {
namespace {

/// The walls in House::walls beside each wall: at its u = 0 and at its end.
struct Neighbours {
  std::size_t start, end;
};
constexpr std::size_t kFront = 0, kBack = 1, kLeft = 2, kRight = 3;
constexpr std::array<Neighbours, 4> kNeighbours{
    {{kLeft, kRight}, {kRight, kLeft}, {kBack, kFront}, {kFront, kBack}}};

/// Distance to what interrupts the plinth.
constexpr Um kGap = 100'000;

}  // namespace

void add_plinth(Draft& draft, House& house, Um height, Um thickness) {
  const int object = draft.add_object(
      {Class::other, "plinth", draft.owner(house.walls[kFront].facet).object, -1, {}, {}});
  const Owner owner{object};
  std::array<FacetId, 4> outside{};
  for (FacetId& facet : outside) facet = draft.add_facet(owner);
  const FacetId top = draft.add_facet(owner);
  for (std::size_t i = 0; i < 4; ++i) {
    const Panel& wall = house.walls[i];
    const Um length = wall.usable.u1 + kWallMargin;
    const Neighbours beside = kNeighbours[i];
    // Front and back fill the corners; left and right end at them, glued to what stands there.
    const bool fills_corners = i == kFront || i == kBack;
    const std::array<FacetId, 4> walls{house.walls[0].facet, house.walls[1].facet,
                                       house.walls[2].facet, house.walls[3].facet};
    const std::array<FacetId, 4>& ends = fills_corners ? outside : walls;
    const Um reach = fills_corners ? thickness : 0;
    for (const Rect& part : wall.free_parts({0, length, 0, height}, 0, height, kGap)) {
      Block block{part.u0, part.u1, 0, height, 0, thickness};
      BlockFacets joined{
          .bottom = house.ground, .top = top, .back = wall.facet, .front = outside[i]};
      if (part.u0 == 0) {
        block.u0 -= reach;
        joined.left = ends[beside.start];
      }
      if (part.u1 == length) {
        block.u1 += reach;
        joined.right = ends[beside.end];
      }
      add_block(draft, wall.frame, block, owner, joined);
    }
  }
}

}  // namespace oriel::generator
