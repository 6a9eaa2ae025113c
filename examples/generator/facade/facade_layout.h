#pragma once

#include "examples/generator/house/house.h"
#include "examples/generator/house/plan.h"

namespace oriel::generator {

/// Places doors, bays, balconies, loggias, windows and decor on the walls and gables of a house,
/// without collision: each keeps to the cells of a grid of storeys and columns, and 0.1 m distance
/// to what does not belong to it.
void lay_out_facades(Draft& draft, House& house, const Plan& plan, Random& random);

}  // namespace oriel::generator
