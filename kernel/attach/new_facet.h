#pragma once

#include "model/solid.h"

namespace oriel::detail {

/// Adds a facet without polygons to the shell of another one. Its plane is one of the solid's if
/// there is the same.
FacetId add_facet(Solid& solid, const Plane& plane, Loop loop, FacetId beside);

}  // namespace oriel::detail
