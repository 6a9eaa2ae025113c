#pragma once

/// Which buildings of a city touch, and what lies before their walls: NeighbourSearch, for
/// LabelOptions::neighbours.
#include "kernel/neighbours/neighbours.h"  // IWYU pragma: export
