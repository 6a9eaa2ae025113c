#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/mend/cells.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <span>

namespace oriel::detail {

/// Polygons that would be left out as inner faces though they lie outside what is enclosed.
struct ExposedFaces {
  int polygons = 0;
  double area = 0;   ///< grid units squared
  double share = 0;  ///< of their area and that of the boundary together, 0…1
};

/// Cells are told by edges: of a surface with a hole both sides are one cell, and if a closing face
/// elsewhere makes another cell the outer one, all of that surface counts as inner. Whether it is
/// told by where it lies: what a partition, the double wall between two parts or the back of a
/// window box has on one side at least is inside the boundary of what is enclosed. What has the
/// outside on both sides, `reach` (grid units) off, can be seen from there and would be lost.
/// Caps (kNoSource) are no polygons of the building. Once `work` is used up no more are looked for.
ExposedFaces find_exposed_faces(const Soup& soup, std::span<const PolygonShape> shapes,
                                const PolygonCells& cells, double reach, Work& work);

}  // namespace oriel::detail
