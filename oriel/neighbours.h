#pragma once

/// Which buildings of a city touch, and what lies before their walls: NeighbourSearch, for
/// LabelOptions::neighbours. Which of them become one at a scale: CityGroups, for
/// GeneraliseOptions::groups.
#include "generalise/city/city_groups.h"    // IWYU pragma: export
#include "kernel/neighbours/kept_ground.h"  // IWYU pragma: export
#include "kernel/neighbours/neighbours.h"   // IWYU pragma: export

#include <memory>
#include <string>
#include <vector>

namespace oriel {

/// Roads and parcels of files of GeoJSON or CityJSON, for CityGroups (read_ground_areas). Throws
/// InputError: E101, E103, E104 and E190 as that does; E192 if all of it lies more than a kilometre
/// off the buildings of `search`, which may be null: probably it has another reference system.
std::shared_ptr<const KeptGround> read_kept_ground(const std::vector<std::string>& files,
                                                   const NeighbourSearch* search);

}  // namespace oriel
