#pragma once

#include "kernel/mesh/mesh.h"

namespace oriel {

/// The symmetric Hausdorff distance of two surfaces in m: how far a point of either lies at most
/// from the other surface. No further off than `error_m` (CGAL, bounded error: Tang et al. 2009,
/// refined where a triangle may still hold the maximum). Both are in one frame; none is empty.
/// Faces that are no triangles are triangulated.
double hausdorff_m(const Mesh& a, const Mesh& b, double error_m = 0.001);
double hausdorff_m(const Solid& a, const Solid& b, double error_m = 0.001);

}  // namespace oriel
