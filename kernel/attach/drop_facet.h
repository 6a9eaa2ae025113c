#pragma once

#include "model/solid.h"

#include <optional>
#include <string>

namespace oriel {

/// A solid without one of its facets, or why that cannot be.
struct DroppedFacet {
  std::optional<Solid> solid;
  /// If there is no solid.
  std::string reason;
};

/// Takes a facet of three or four corners out of a solid: those beside it keep their planes and
/// become longer or shorter until they meet. In place of a triangle three meet in a point; in place
/// of four corners the two at its longer sides meet in an edge, and its shorter sides become the
/// ends of that.
///
/// The result is closed and exact by construction: its new corners are meetings of three planes of
/// the solid, so there is no new normal. It is refused with a reason
///  - if the facet has holes, or another number of corners;
///  - if more than three planes meet in one of its corners;
///  - if its neighbours do not meet, or meet more than `reach_m` from a corner that goes there;
///  - if one beside it would have less than three corners left, or an edge would vanish or turn
///    round;
///  - if anything else lies in the box, in the facet's own axes, that its corners and the new ones
///    span.
/// Source: Staufenbiel 1973 and Sester 2000 for outlines (too short a side goes, those beside it
/// are made longer); paper, section 5.2.
DroppedFacet drop_facet(const Solid& solid, FacetId facet, double reach_m);

}  // namespace oriel
