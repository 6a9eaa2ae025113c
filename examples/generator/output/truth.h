#pragma once

#include "examples/generator/output/cityjson.h"

#include <string>

namespace oriel::generator {

/// The building's ground truth in the format of the shared data (docs/generator.md), one line with
/// its line break. `faces` count the polygons of this body in this order, so pass the body that was
/// written.
std::string truth_json(const Building& building);

}  // namespace oriel::generator
