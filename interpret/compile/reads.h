#pragma once

#include "interpret/pack/pack.h"

namespace oriel::rules {

/// What the expressions and groups of a pack read of a building.
Reads find_reads(const Pack& pack);

}  // namespace oriel::rules
