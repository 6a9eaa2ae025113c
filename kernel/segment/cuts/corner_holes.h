#pragma once

#include "kernel/segment/cuts/patch.h"

#include <vector>

namespace oriel::detail {

struct CornerHoleOptions {
  int order = 2;
  /// Planes that are no split planes of the body.
  std::vector<int> own_planes;
  /// Not only planes beyond the rim of a group, but all that can cap a hole in it.
  bool has_all_sides = false;
  double weld_m = 0;
};

/// The holes that `order` planes cap (paper, section 4, figure 3), be the cut natural or not: the
/// air behind all planes of a set. The sets come from the surface: the planes beyond the rim of
/// facets that hang together over reflex edges, and if asked for those of these facets and of all
/// that cross them. Holes are numbered in the body in which their planes are imprinted.
std::vector<Patch> find_corner_holes(const Boundary& body, const CornerHoleOptions& options);

/// Removes the edges between coplanar facets that an imprint has left where nothing was cut.
void remove_seams(Boundary& body);

}  // namespace oriel::detail
