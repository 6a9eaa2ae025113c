#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// A face that would close a hole: its ring, in the sense of rotation of `normal`.
struct CapDraft {
  std::vector<int> ring;
  double area = 0;  ///< grid units squared
  int beside = -1;  ///< a polygon at whose open edge it lies
};

/// Faces that would close holes of up to `max_area` (grid units squared), each once.
///
/// At an edge of one polygon only two planes are looked at: that of the polygon, on whose empty
/// side the hole in it lies, and that of the edge with an open edge next to it (a box without lid).
/// In such a plane the smallest loop of edges is followed that has the open edge on its rim: edges
/// of any number of polygons, all their points within `reach` of the plane. It is a hole if it runs
/// round its inside, comes to no point twice, and no polygon lies in it along its rim.
///
/// What open edges are left then are followed from point to point, as long as there are two at
/// each; a loop of them that is not plane is cut into plane pieces by the chords that part the
/// largest of them (a strip of wall that is missing round a corner).
///
/// Once `work` is used up no more are looked for.
std::vector<CapDraft> find_caps(const Soup& soup, std::span<const PolygonShape> shapes,
                                double reach, double max_area, Work& work);

}  // namespace oriel::detail
