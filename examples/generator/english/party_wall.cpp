#include "examples/generator/english/party_wall.h"

#include "examples/generator/house/extrude.h"

#include <utility>

namespace oriel::generator {
namespace {

/// Oversailing courses: two of brick, a quarter of a brick out.
constexpr Um kCourses = 150'000, kOversail = 56'000;
constexpr Um kFlueDepth = 300'000;
constexpr Um kPotWidth = 260'000, kPotWall = 30'000, kFlueWidth = 225'000;

std::vector<Uv> octagon(const Rect& rect) {
  const Um cut = rect.width() * 3 / 10'000 * 1'000;
  return {{rect.u0 + cut, rect.v0}, {rect.u1 - cut, rect.v0}, {rect.u1, rect.v0 + cut},
          {rect.u1, rect.v1 - cut}, {rect.u1 - cut, rect.v1}, {rect.u0 + cut, rect.v1},
          {rect.u0, rect.v1 - cut}, {rect.u0, rect.v0 + cut}};
}

/// A round pot on the stack, or an open flue in it.
void add_flue(Draft& draft, const Rect& rect, const Stack& stack, Owner owner, FacetId top) {
  if (stack.pot == 0) {
    carve_block(draft, {}, {rect.u0, rect.u1, rect.v0, rect.v1, stack.top - kFlueDepth, stack.top},
                owner, {.front = top});
    return;
  }
  const Um rim = stack.top + stack.pot;
  const PrismFacets pot = extrude(draft, {}, {octagon(rect), stack.top, rim}, Matter::solid, owner,
                                  {{}, top, kNewFacet});
  extrude(draft, {}, {octagon(rect.grown(-kPotWall)), rim - stack.pot / 2'000 * 1'000, rim},
          Matter::hollow, owner, {{}, kNewFacet, pot.high});
}

/// The plane's point at this y, seen along x: (y, z).
Uv on_plane(const RoofPlane& plane, Um y) {
  const Um v = plane.frame.coordinates_of({0, y, 0}).y;
  return {y, plane.frame.origin.z + plane.slope.rise(v)};
}

}  // namespace

StackFaces add_stack(Draft& draft, House& house, const Stack& stack) {
  const Rect& r = stack.plan;
  const int object =
      draft.add_object({Class::chimney, "stack", host_below(draft, house, r), -1, {}, {}});
  const FacetId seam = draft.add_facet({object});
  const std::vector<FacetId> walls =
      stand_on_roof(draft, house, rectangle({}, r, 0), stack.top - kCourses, {object}, seam);
  const Rect head = r.grown(kOversail);
  const FacetId top =
      add_block(draft, {}, {head.u0, head.u1, head.v0, head.v1, stack.top - kCourses, stack.top},
                {object}, {.back = seam})
          .front;
  const Um flue = stack.pot > 0 ? kPotWidth : kFlueWidth;
  const Um across = r.width() / stack.columns, along = r.height() / stack.rows;
  for (int column = 0; column < stack.columns; ++column)
    for (int row = 0; row < stack.rows; ++row) {
      const Um u0 = (r.u0 + column * across + (across - flue) / 2) / 1'000 * 1'000;
      const Um v0 = (r.v0 + row * along + (along - flue) / 2) / 1'000 * 1'000;
      add_flue(draft, {u0, u0 + flue, v0, v0 + flue}, stack, {object}, top);
    }
  reserve_roof(house, head);
  return {walls[0], walls[2]};
}

void add_upstand(Draft& draft, House& house, const Upstand& upstand) {
  const RoofPlane &front = house.roof[0], &back = house.roof[1];
  const int object =
      draft.add_object({Class::other, "upstand", draft.owner(front.facet).object, -1, {}, {}});
  const Um y0 = front.frame.origin.y, y1 = back.frame.origin.y, ridge = (y0 + y1) / 2;
  const auto above = [&](Uv p) { return Uv{p.u, p.v + upstand.height}; };
  const auto add = [&](const std::vector<Uv>& outline, std::vector<FacetId> walls) {
    extrude(draft, Frame{}.turned(), {outline, upstand.x0, upstand.x1}, Matter::solid, {object},
            {std::move(walls), upstand.west, upstand.east});
  };
  const Uv foot = on_plane(front, y0), end = on_plane(back, y1);
  if (upstand.stack) {
    const Uv up = on_plane(front, upstand.stack_y0), down = on_plane(back, upstand.stack_y1);
    add({foot, up, above(up), above(foot)},
        {front.facet, upstand.stack->front, kNewFacet, upstand.front});
    add({down, end, above(end), above(down)},
        {back.facet, kNewFacet, kNewFacet, upstand.stack->back});
  } else {
    const Uv top = on_plane(front, ridge);
    add({foot, top, end, above(end), above(top), above(foot)},
        {front.facet, back.facet, kNewFacet, kNewFacet, kNewFacet, upstand.front});
  }
  reserve_roof(house, {upstand.x0, upstand.x1, y0, y1});
}

}  // namespace oriel::generator
