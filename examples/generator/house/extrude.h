#pragma once

#include "examples/generator/house/draft.h"

#include <vector>

namespace oriel::generator {

/// A polygon in the (u, v) plane of a frame, counter-clockwise, drawn out from w = low to w = high.
struct Prism {
  std::vector<Uv> outline;
  Um low = 0, high = 0;
};

/// The facets of a prism; walls[i] stands on the outline's edge from corner i to the next.
struct PrismFacets {
  std::vector<FacetId> walls;
  FacetId low = kNewFacet, high = kNewFacet;
};

/// Puts a prism onto the draft (solid) or takes one away (hollow).
enum class Matter { solid, hollow };

/// Returns the facets of the prism. A face for which `joined` names a facet is summed into that
/// facet; all others become new facets of `owner`. `joined.walls` may be empty.
PrismFacets extrude(Draft& draft, const Frame& frame, const Prism& prism, Matter matter,
                    Owner owner, PrismFacets joined = {});

/// A box in a frame.
struct Block {
  Um u0 = 0, u1 = 0, v0 = 0, v1 = 0, w0 = 0, w1 = 0;
};

/// The six facets of a block: left and right at u0 and u1, bottom and top at v0 and v1, back and
/// front at w0 and w1.
struct BlockFacets {
  FacetId left = kNewFacet, right = kNewFacet, bottom = kNewFacet, top = kNewFacet,
          back = kNewFacet, front = kNewFacet;
};

/// As extrude, for a box.
BlockFacets add_block(Draft& draft, const Frame& frame, const Block& block, Owner owner,
                      const BlockFacets& joined = {});
BlockFacets carve_block(Draft& draft, const Frame& frame, const Block& block, Owner owner,
                        const BlockFacets& joined = {});

/// The rectangle at height w of the frame, its normal along +w.
Ring rectangle(const Frame& frame, const Rect& rect, Um w);
Ring reversed(Ring ring);

}  // namespace oriel::generator
