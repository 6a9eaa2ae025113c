#pragma once

#include "examples/generator/house/body.h"
#include "examples/generator/options.h"

namespace oriel::generator {

/// House `index` of the options: built, checked, then triangulated, rotated, shaken and moved as
/// they say. Vertices are relative to options.origin. Throws std::logic_error if the body is not a
/// valid solid with complete truth: a fault of the generator, never of the options.
Body generate(const Options& options, int index);

}  // namespace oriel::generator
