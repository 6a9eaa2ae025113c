#pragma once

#include "examples/generator/house/house.h"
#include "examples/generator/house/plan.h"

namespace oriel::generator {

/// Places chimneys, dormers with their windows, roof windows and vents on the roof, at least 0.2 m
/// apart as seen from above.
void lay_out_roof(Draft& draft, House& house, const Plan& plan, Random& random);

}  // namespace oriel::generator
