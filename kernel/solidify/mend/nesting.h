#pragma once

#include "kernel/solidify/mend/cells.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <vector>

namespace oriel::detail {

/// What becomes of what a piece encloses.
enum class PieceRole : char {
  nothing,  ///< it encloses nothing
  lump,
  cavity,  ///< of the lumps around it
  within   ///< it lies in the material of another piece
};

/// The role of every piece of the soup. A piece in the material of others of the same body is a
/// cavity if the input says so (an inner shell of a solid, or, of loose surfaces, one whose
/// boundary faces inward), else it is within. `is_solid`: what the input says of shells counts.
std::vector<PieceRole> find_roles(const Soup& soup, const std::vector<PolygonShape>& shapes,
                                  const PolygonCells& cells, bool is_solid);

}  // namespace oriel::detail
