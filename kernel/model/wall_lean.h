#pragma once

namespace oriel {

/// Facets that lean more than this from upright (the sine of 10 degrees) are no walls: where growth
/// is described, and where roofs are told from walls by it.
inline constexpr double kWallLean = 0.1736;

}  // namespace oriel
