#pragma once

#include "kernel/solidify/mend/cells.h"
#include "kernel/solidify/soup/soup.h"

#include <optional>

namespace oriel::detail {

/// How often the surface that the polygons of a body make winds round the cell in front of each
/// polygon: 0 outside, 1 inside, 2 where it overlaps itself, −1 where it is turned inside out;
/// round the cell behind the polygon once more. Nothing if that is contradictory: then the polygons
/// of a body are no closed surfaces, all of them oriented, that meet in common edges only.
std::optional<Numbers> find_windings(const Soup& soup, const PolygonCells& cells);

}  // namespace oriel::detail
