#pragma once

#include "model/segmentation.h"
#include "model/solid.h"

#include <optional>

namespace oriel::fuzz {

/// Another judge, CGAL's Nef polyhedra: whether the CSG tree, evaluated by union and difference of
/// its cells, is the solid, exactly. Nothing if it cannot say: a corner is no whole multiple of
/// kUnit_m, a body touches itself in an edge, or there are too many triangles for its patience.
std::optional<bool> is_solid_by_nef(const Segmentation& segmentation, const Solid& solid);

}  // namespace oriel::fuzz
