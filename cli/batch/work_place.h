#pragma once

#include <cstddef>
#include <cstdint>

namespace oriel::cli {

inline constexpr std::size_t kNoBuilding = SIZE_MAX;

/// Work begins on building number `building` of the record at hand, or on the record as a whole:
/// what is blamed if a worker of --isolate ends here. Costs nothing without it.
void now_at_building(std::size_t building);

}  // namespace oriel::cli
