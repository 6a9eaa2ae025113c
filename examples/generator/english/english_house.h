#pragma once

#include "examples/generator/house/body.h"
#include "examples/generator/options.h"
#include "examples/generator/random.h"

namespace oriel::generator {

/// A row, pair or block of English brick houses as one body, not yet checked. Of the options,
/// `flush` and `jitter` count.
Body build_english_house(const Options& options, Random& random);

}  // namespace oriel::generator
