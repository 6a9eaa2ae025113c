#pragma once

/// Which buildings of a city touch, and what lies before their walls: NeighbourSearch, for
/// LabelOptions::neighbours. Which of them become one at a scale: CityGroups, for
/// GeneraliseOptions::groups.
#include "generalise/city/city_groups.h"   // IWYU pragma: export
#include "kernel/neighbours/neighbours.h"  // IWYU pragma: export
