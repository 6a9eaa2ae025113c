#pragma once

#include "model/solid.h"

#include <optional>
#include <string>

namespace oriel {

/// A solid of which one facet moved, or why that cannot be.
struct MovedFacet {
  std::optional<Solid> solid;
  /// If there is no solid.
  std::string reason;
};

/// Moves a facet along its normal, outwards by `out_m` or inwards by -`out_m`. The facets around it
/// keep their planes and become longer or shorter; holes in the facet move along with it, as long
/// as they are deep.
///
/// The result is closed and exact by construction: the corners of the moved facet are meetings of
/// its new plane and the two others of the corner. It is refused with a reason
///  - if more than three planes meet in one of its corners, or two that are parallel;
///  - if an edge of it, or one that leads to it, would vanish or turn round;
///  - if anything else lies in its way: a vertex, or a part of a facet, in the box in the facet's
///    own axes that it passes through.
MovedFacet move_facet(const Solid& solid, FacetId facet, double out_m);

/// The plane parallel to `plane` that lies `out_m` in front of it, its offset rounded to the grid.
Plane plane_in_front(const Plane& plane, double out_m, double grid_m);

}  // namespace oriel
