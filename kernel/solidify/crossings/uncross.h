#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/soup/soup.h"
#include "model/tolerances.h"

#include <optional>
#include <vector>

namespace oriel::detail {

/// What is left of a soup of closed surfaces that run through themselves or each other.
struct Uncrossed {
  /// The boundary of their inside, every polygon's front outside.
  Soup soup;
  /// Polygons that were cut, or are a boundary only in parts.
  int cut = 0;
  /// Polygons (their sources) of which nothing bounds the inside, sorted.
  std::vector<int> left_out;
  double left_out_m2 = 0;
};

/// Makes the boundary of what the closed surfaces of a soup enclose, body by body: of the points
/// that they wind round once or more, as the polygons are oriented.
/// 1. polygons are cut where they run through each other, with their own rings, and at the edges of
///    others that lie on them (crossings.h);
/// 2. vertices on edges are put into them (t_vertices.h), equal pieces that look opposite ways go;
/// 3. the cells between the pieces are found (cells.h), and how often the surface winds round each;
/// 4. a piece stays if it has the outside (0 or less) in front and the inside behind it.
/// As many polygons must run one way along every edge as the other way, else there is nothing; a
/// body that is inside out as a whole is turned round. Tried with points within plane_offset_m of a
/// plane counting as on it, then with a tenth and a hundredth of that; nothing if the pieces close
/// with none, or once `work` is used up.
std::optional<Uncrossed> uncross(const Soup& soup, const Tolerances& tolerances, Work& work);

}  // namespace oriel::detail
