#pragma once

#include "examples/generator/house/body.h"
#include "examples/generator/random.h"

namespace oriel::generator {

/// The same body with every polygon cut into triangles without new vertices, in a random way: ears
/// are clipped in random order. A polygon that cannot be cut, as its vertices were moved over each
/// other, stays whole.
Body triangulated(const Body& body, Random& random);

}  // namespace oriel::generator
