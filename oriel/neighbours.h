#pragma once

/// Which buildings of a city touch, and what lies before their walls: NeighbourSearch, for
/// LabelOptions::neighbours. Which of them become one at a scale: CityGroups, for
/// GeneraliseOptions::groups.
#include "generalise/city/city_groups.h"    // IWYU pragma: export
#include "kernel/neighbours/kept_ground.h"  // IWYU pragma: export
#include "kernel/neighbours/neighbours.h"   // IWYU pragma: export
#include "oriel/read.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace oriel {

/// Adds all buildings of a file to a search that is not finished. Calls `tell` with what is wrong
/// in each of its records; throws InputError as read() does.
void add_buildings(const std::string& file, const ReadOptions& options, NeighbourSearch& search,
                   const std::function<void(const std::vector<Issue>&)>& tell);

/// Errors of a file that is only looked at cost its buildings and nothing else: as warnings. The
/// rest is left out.
std::vector<Issue> faults_beside(std::vector<Issue> issues);

/// Roads and parcels of files of GeoJSON or CityJSON, for CityGroups (read_ground_areas). Throws
/// InputError: E101, E103, E104 and E190 as that does; E192 if all of it lies more than a kilometre
/// off the buildings of `search`, which may be null: probably it has another reference system.
std::shared_ptr<const KeptGround> read_kept_ground(const std::vector<std::string>& files,
                                                   const NeighbourSearch* search);

}  // namespace oriel
