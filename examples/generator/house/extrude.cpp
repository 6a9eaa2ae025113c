#include "examples/generator/house/extrude.h"

#include <algorithm>
#include <utility>

namespace oriel::generator {
namespace {

BlockFacets make_block(Draft& draft, const Frame& frame, const Block& block, Matter matter,
                       Owner owner, const BlockFacets& joined) {
  const Prism prism{
      {{block.u0, block.v0}, {block.u1, block.v0}, {block.u1, block.v1}, {block.u0, block.v1}},
      block.w0,
      block.w1};
  const PrismFacets facets =
      extrude(draft, frame, prism, matter, owner,
              {{joined.bottom, joined.right, joined.top, joined.left}, joined.back, joined.front});
  const std::vector<FacetId>& walls = facets.walls;
  return {walls[3], walls[1], walls[0], walls[2], facets.low, facets.high};
}

}  // namespace

Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

Ring rectangle(const Frame& frame, const Rect& rect, Um w) {
  return {frame.at(rect.u0, rect.v0, w), frame.at(rect.u1, rect.v0, w),
          frame.at(rect.u1, rect.v1, w), frame.at(rect.u0, rect.v1, w)};
}

PrismFacets extrude(Draft& draft, const Frame& frame, const Prism& prism, Matter matter,
                    Owner owner, PrismFacets joined) {
  const auto add = [&](FacetId facet, Ring ring) {
    return draft.add_ring(facet, owner,
                          matter == Matter::solid ? std::move(ring) : reversed(std::move(ring)));
  };
  const std::size_t corners = prism.outline.size();
  joined.walls.resize(corners, kNewFacet);
  Ring low, high;
  for (std::size_t i = 0; i < corners; ++i) {
    const Uv a = prism.outline[i], b = prism.outline[(i + 1) % corners];
    low.push_back(frame.at(a.u, a.v, prism.low));
    high.push_back(frame.at(a.u, a.v, prism.high));
    joined.walls[i] =
        add(joined.walls[i], {frame.at(a.u, a.v, prism.low), frame.at(b.u, b.v, prism.low),
                              frame.at(b.u, b.v, prism.high), frame.at(a.u, a.v, prism.high)});
  }
  joined.low = add(joined.low, reversed(std::move(low)));
  joined.high = add(joined.high, std::move(high));
  return joined;
}

BlockFacets add_block(Draft& draft, const Frame& frame, const Block& block, Owner owner,
                      const BlockFacets& joined) {
  return make_block(draft, frame, block, Matter::solid, owner, joined);
}

BlockFacets carve_block(Draft& draft, const Frame& frame, const Block& block, Owner owner,
                        const BlockFacets& joined) {
  return make_block(draft, frame, block, Matter::hollow, owner, joined);
}

}  // namespace oriel::generator
