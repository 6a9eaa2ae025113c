#pragma once

#include "model/building.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <optional>

namespace oriel {

/// The facets of a building whose polygons do not close (solidify refused it): planes, vertices and
/// facets as solidify makes them, but no shells. Every input polygon that has an area is in one
/// facet, except where welding has folded polygons onto themselves: they bound nothing. Edges are
/// met once, twice or more often; vertices are welded and stay where they are, off their planes by
/// up to plane_offset_m. Of triangles they are put into open edges that they lie on. Neighbours
/// look the same way, patches of them away from the middle of the building.
///
/// It is no solid: `segment` and what cuts must not be given it, `segment_open` may. Nothing if no
/// polygon is left, or if the building is larger than the exact range (solidify's E501).
/// Shuffling the input changes nothing but the numbers in Facet::polygons.
std::optional<Solid> open_shell(const Building& building, const Tolerances& tolerances = {});

}  // namespace oriel
