#include "examples/generator/house/attachments.h"

#include "examples/generator/house/extrude.h"

namespace oriel::generator {
namespace {

int add_installation(Draft& draft, const Panel& panel, Class kind, std::string_view subclass) {
  return draft.add_object(
      {kind, std::string(subclass), draft.owner(panel.facet).object, panel.installation, {}, {}});
}

/// The facet a feature that starts at height v is summed into at its bottom.
FacetId below(const Panel& panel, Um v) { return v == 0 ? panel.ground : kNewFacet; }

}  // namespace

int add_balcony(Draft& draft, Panel& panel, const Balcony& balcony) {
  const int object = add_installation(draft, panel, Class::balcony, "balcony");
  const Rect& r = balcony.rect;
  const Um t = balcony.parapet, depth = balcony.depth, top = r.v1 + balcony.screens;
  panel.reserved.push_back({r.u0, r.u1, r.v0, top});
  const BlockFacets outside = add_block(draft, panel.frame, {r.u0, r.u1, r.v0, r.v1, 0, depth},
                                        {object}, {.back = panel.facet});
  if (t == 0) return object;
  const BlockFacets inside =
      carve_block(draft, panel.frame, {r.u0 + t, r.u1 - t, r.v0 + balcony.slab, r.v1, 0, depth - t},
                  {object}, {.top = outside.top, .back = panel.facet});
  if (balcony.screens == 0) return object;
  add_block(draft, panel.frame, {r.u0, r.u0 + t, r.v1, top, 0, depth}, {object},
            {.left = outside.left,
             .right = inside.left,
             .bottom = outside.top,
             .back = panel.facet,
             .front = outside.front});
  add_block(draft, panel.frame, {r.u1 - t, r.u1, r.v1, top, 0, depth}, {object},
            {.left = inside.right,
             .right = outside.right,
             .bottom = outside.top,
             .back = panel.facet,
             .front = outside.front});
  return object;
}

Panel add_loggia(Draft& draft, Panel& panel, const Rect& rect, Um depth, Um parapet) {
  const int object = add_installation(draft, panel, Class::loggia, "loggia");
  panel.reserved.push_back(rect);
  const BlockFacets room =
      carve_block(draft, panel.frame, {rect.u0, rect.u1, rect.v0, rect.v1, -depth, 0}, {object},
                  {.front = panel.facet});
  const Um thickness = 120_mm;
  if (parapet > 0)
    add_block(
        draft, panel.frame, {rect.u0, rect.u1, rect.v0, rect.v0 + parapet, -thickness, 0}, {object},
        {.left = room.left, .right = room.right, .bottom = room.bottom, .front = panel.facet});
  return {room.back, panel.frame.moved(0, 0, -depth),
          kNewFacet, {rect.u0 + 100_mm, rect.u1 - 100_mm, rect.v0, rect.v1 - 100_mm},
          {},        object,
          false};
}

Panel add_bay(Draft& draft, Panel& panel, const Bay& bay) {
  const int object = add_installation(draft, panel, Class::bay, "bay");
  const Rect& r = bay.rect;
  panel.reserved.push_back(r);
  const FacetId ground = below(panel, r.v0);
  PrismFacets facets;
  std::size_t front = 2;
  if (bay.splay > 0) {
    front = 1;
    facets = extrude(
        draft, panel.frame.turned().turned(),
        {{{0, r.u0}, {bay.depth, r.u0 + bay.splay}, {bay.depth, r.u1 - bay.splay}, {0, r.u1}},
         r.v0,
         r.v1},
        Matter::solid, {object},
        {{kNewFacet, kNewFacet, kNewFacet, panel.facet}, ground, kNewFacet});
  } else {
    facets = extrude(
        draft, panel.frame.turned(),
        {{{r.v0, 0}, {r.v1, 0}, {r.v1 - bay.fall, bay.depth}, {r.v0, bay.depth}}, r.u0, r.u1},
        Matter::solid, {object}, {{panel.facet, kNewFacet, kNewFacet, ground}});
  }
  const Rect usable{r.u0 + bay.splay + 150_mm, r.u1 - bay.splay - 150_mm, r.v0,
                    r.v1 - bay.fall - 150_mm};
  return {facets.walls[front],
          panel.frame.moved(0, 0, bay.depth),
          kNewFacet,
          usable,
          {},
          object,
          false};
}

int add_canopy(Draft& draft, Panel& panel, const Rect& rect, Um depth, Um fall) {
  const int object = add_installation(draft, panel, Class::canopy, "canopy");
  panel.reserved.push_back(rect);
  extrude(
      draft, panel.frame.turned(),
      {{{rect.v0, 0}, {rect.v1, 0}, {rect.v1 - fall, depth}, {rect.v0, depth}}, rect.u0, rect.u1},
      Matter::solid, {object}, {{panel.facet}});
  return object;
}

int add_stairs(Draft& draft, Panel& panel, const Rect& rect, int steps, Um landing, Um tread) {
  const int object = add_installation(draft, panel, Class::stairs, "stairs");
  panel.reserved.push_back(rect);
  const Um riser = rect.v1 / steps;
  Prism prism{{{0, 0}}, rect.u0, rect.u1};
  PrismFacets joined{{panel.facet}};
  for (int step = 0; step < steps; ++step) {
    const Um level = rect.v1 - step * riser;
    prism.outline.push_back({level, step == 0 ? 0 : landing + (step - 1) * tread});
    prism.outline.push_back({level, landing + step * tread});
  }
  prism.outline.push_back({0, landing + (steps - 1) * tread});
  joined.walls.resize(prism.outline.size(), kNewFacet);
  joined.walls.back() = panel.ground;
  extrude(draft, panel.frame.turned(), prism, Matter::solid, {object}, joined);
  return object;
}

int add_decor(Draft& draft, Panel& panel, std::string_view subclass, const Rect& rect, Um depth) {
  const int object = add_installation(draft, panel, Class::other, subclass);
  panel.reserved.push_back(rect);
  add_block(draft, panel.frame, {rect.u0, rect.u1, rect.v0, rect.v1, 0, depth}, {object},
            {.bottom = below(panel, rect.v0), .back = panel.facet});
  return object;
}

}  // namespace oriel::generator
