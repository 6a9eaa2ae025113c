#pragma once

#include "examples/generator/addition.h"
#include "examples/generator/house/house.h"
#include "examples/generator/random.h"

#include <vector>

namespace oriel::generator {

/// Puts what was asked for onto the bare house; what the house draws itself keeps clear of it. On
/// walls it keeps 0.1 m from everything else and from the top, on roofs 0.2 m; holes of different
/// surfaces do not meet inside the house. Returns the positions in the list of those without a
/// position of their own that found no room. Throws AdditionError E141 where one with a position
/// does not fit there, or where the house does not have its surface.
std::vector<int> place_additions(Draft& draft, House& house, const std::vector<Addition>& additions,
                                 Um wall_height, Random& random);

}  // namespace oriel::generator
