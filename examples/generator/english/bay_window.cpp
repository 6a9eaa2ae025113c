#include "examples/generator/english/bay_window.h"

#include "examples/generator/house/extrude.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace oriel::generator {
namespace {

/// The roof from the eaves of front and sides to a short ridge on the wall. Its side planes are
/// triangles, so any inset of the ridge leaves them planar; this one gives them the front's slope.
void add_bay_roof(Draft& draft, Panel& panel, const BayWindow& bay, Owner owner) {
  const Rect& r = bay.rect;
  const Um cant = bay.is_canted ? bay.depth : 0;
  const Um equal = bay.is_canted ? bay.depth * 1414 / 1'000'000 * 1'000 : bay.depth;
  const Um inset = std::min(equal, r.width() * 4 / 10'000 * 1'000);
  const auto at = [&](Um u, Um v, Um w) { return panel.frame.at(u, v, w); };
  const Point a = at(r.u0, r.v1, 0), b = at(r.u0 + cant, r.v1, bay.depth);
  const Point c = at(r.u1 - cant, r.v1, bay.depth), d = at(r.u1, r.v1, 0);
  const Point left = at(r.u0 + inset, r.v1 + bay.rise, 0);
  const Point right = at(r.u1 - inset, r.v1 + bay.rise, 0);
  draft.add_ring(kNewFacet, owner, {b, c, right, left});
  draft.add_ring(kNewFacet, owner, {a, b, left});
  draft.add_ring(kNewFacet, owner, {c, d, right});
  draft.add_ring(panel.facet, reversed({a, d, right, left}));
}

}  // namespace

BayFaces add_bay_window(Draft& draft, Panel& panel, const BayWindow& bay) {
  const Rect& r = bay.rect;
  const Um slant = bay.is_canted ? 1 : 0, cant = slant * bay.depth;
  const int object = draft.add_object(
      {Class::bay, "bay", draft.owner(panel.facet).object, panel.installation, {}, {}});
  panel.reserved.push_back({r.u0, r.u1, r.v0, r.v1 + bay.rise});
  // In (w, u) from the wall's left end around the front.
  const std::vector<Uv> outline{
      {0, r.u0}, {bay.depth, r.u0 + cant}, {bay.depth, r.u1 - cant}, {0, r.u1}};
  const FacetId top = draft.add_facet({object});
  const PrismFacets facets = extrude(
      draft, panel.frame.turned().turned(), {outline, r.v0, r.v1}, Matter::solid, {object},
      {{kNewFacet, kNewFacet, kNewFacet, panel.facet}, r.v0 == 0 ? panel.ground : kNewFacet, top});
  if (bay.rise > 0) {
    Ring seam;
    for (const Uv& corner : outline) seam.push_back(panel.frame.at(corner.v, r.v1, corner.u));
    draft.add_ring(top, reversed(std::move(seam)));
    add_bay_roof(draft, panel, bay, {object});
  }
  const Frame& f = panel.frame;
  const Frame left{f.at(r.u0, 0, 0), f.w + slant * f.u, f.v, slant * f.w - f.u};
  const Frame right{f.at(r.u1 - cant, 0, bay.depth), slant * f.u - f.w, f.v, slant * f.w + f.u};
  const auto face = [&](FacetId facet, const Frame& frame, Um length) {
    return Panel{facet, frame, kNewFacet, {0, length, r.v0, r.v1}, {}, object, false};
  };
  return {face(facets.walls[0], left, bay.depth),
          face(facets.walls[1], f.moved(r.u0 + cant, 0, bay.depth), r.width() - 2 * cant),
          face(facets.walls[2], right, bay.depth), bay.is_canted ? std::numbers::sqrt2 : 1};
}

}  // namespace oriel::generator
