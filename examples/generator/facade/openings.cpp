#include "examples/generator/facade/openings.h"

#include "examples/generator/house/extrude.h"

#include <cmath>
#include <utility>

namespace oriel::generator {
namespace {

/// Sinks a grid of panes into the frame, a facet at depth w of the panel.
void sink_panes(Draft& draft, const Panel& panel, const Opening& opening, FacetId frame, Um w) {
  const Rect& all = opening.rect;
  const Um width =
      (all.width() - (opening.columns + 1) * kFrameWidth) / opening.columns / 1000 * 1000;
  const Um height = (all.height() - (opening.rows + 1) * kFrameWidth) / opening.rows / 1000 * 1000;
  for (int column = 0; column < opening.columns; ++column)
    for (int row = 0; row < opening.rows; ++row) {
      const Um u = all.u0 + kFrameWidth + column * (width + kFrameWidth);
      const Um v = all.v0 + kFrameWidth + row * (height + kFrameWidth);
      carve_block(draft, panel.frame, {u, u + width, v, v + height, w - kPaneDepth, w},
                  draft.owner(frame), {.front = frame});
    }
}

}  // namespace

int add_opening(Draft& draft, Panel& panel, const Opening& opening) {
  const bool has_panes = opening.columns * opening.rows > 1;
  const Um recess = opening.recess + (has_panes ? kPaneDepth : 0);
  const int object = draft.add_object({opening.kind,
                                       opening.subclass,
                                       draft.owner(panel.facet).object,
                                       panel.installation,
                                       recess,
                                       {}});
  const FacetId leaf = draft.add_facet({object});
  const Rect& r = opening.rect;
  if (opening.recess > 0) {
    carve_block(
        draft, panel.frame, {r.u0, r.u1, r.v0, r.v1, -opening.recess, 0}, {object, true},
        {.bottom = r.v0 == 0 ? panel.ground : kNewFacet, .back = leaf, .front = panel.facet});
  } else {
    draft.add_ring(panel.facet, reversed(rectangle(panel.frame, r, 0)));
    draft.add_ring(leaf, rectangle(panel.frame, r, 0));
  }
  if (has_panes) sink_panes(draft, panel, opening, leaf, -opening.recess);
  panel.reserved.push_back(r);
  return object;
}

int add_roof_window(Draft& draft, RoofPlane& plane, const Rect& rect, Um drop) {
  const double cosine = 1 / std::hypot(1.0, plane.slope.per_mille / 1000.0);
  const int object = draft.add_object({Class::window,
                                       "roofWindow",
                                       draft.owner(plane.facet).object,
                                       -1,
                                       std::llround(cosine * static_cast<double>(drop)),
                                       {}});
  const Uv corners[] = {
      {rect.u0, rect.v0}, {rect.u1, rect.v0}, {rect.u1, rect.v1}, {rect.u0, rect.v1}};
  const Point down = drop * plane.frame.w;
  Ring rim, pane;
  for (std::size_t i = 0; i < 4; ++i) {
    const Point a = plane.at(corners[i]), b = plane.at(corners[(i + 1) % 4]);
    rim.push_back(a);
    pane.push_back(a - down);
    if (drop > 0) draft.add_ring(kNewFacet, {object, true}, {a, b, b - down, a - down});
  }
  draft.add_ring(plane.facet, reversed(std::move(rim)));
  draft.add_ring(kNewFacet, {object, false}, pane);
  plane.reserved.push_back(rect);
  return object;
}

}  // namespace oriel::generator
