#pragma once

#include "examples/generator/house/house.h"

namespace oriel::generator {

/// A band of decor around the foot of the house's four walls, interrupted where something stands on
/// the ground. For houses without a wing; nothing may stand nearer than `thickness` to a corner.
void add_plinth(Draft& draft, House& house, Um height, Um thickness);

}  // namespace oriel::generator
