#pragma once

#include "kernel/segment/detail/patch.h"

#include <cstdint>
#include <vector>

namespace oriel::detail {

/// The holes that `order` planes cap without following existing edges (paper, section 4, figure 3):
/// the air behind all planes of a set. The sets come from the surface: facets that hang together
/// over reflex edges, capped by some of the planes beyond their rim. For every set that cuts such a
/// hole, all its holes are returned, natural ones too, with the body in which the planes are
/// imprinted.
///
/// Sets are tried until `work` passes `budget`.
std::vector<Patch> find_corner_holes(const Boundary& body, int order,
                                     const std::vector<int>& own_planes, double weld_m,
                                     std::int64_t budget, std::int64_t& work);

/// Removes the edges between coplanar facets that an imprint has left where nothing was cut.
void remove_seams(Boundary& body);

}  // namespace oriel::detail
