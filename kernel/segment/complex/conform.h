#pragma once

#include "kernel/model/cell_complex.h"

#include <vector>

namespace oriel::detail {

/// Gives loops the vertices of other loops that lie on their edges, within `near_m`, so that faces
/// in different planes meet along whole edges.
void conform(std::vector<Face>& faces, const std::vector<Vertex>& vertices, double near_m);

}  // namespace oriel::detail
