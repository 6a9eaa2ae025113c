#pragma once

#include "kernel/validate/solids/closed_surface.h"

namespace oriel::detail {

/// relate() of bodies whose surfaces touch, by Nef polyhedra.
SurfaceRelation relate_by_nef(const ClosedSurface& first, const ClosedSurface& second);

/// count_pieces() by Nef polyhedra.
int count_pieces_by_nef(const ClosedSurface& outer,
                        const std::vector<const ClosedSurface*>& cavities);

}  // namespace oriel::detail
