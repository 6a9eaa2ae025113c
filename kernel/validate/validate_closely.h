#pragma once

#include "kernel/model/building.h"
#include "kernel/validate/validate.h"

#include <vector>

namespace oriel {

/// Vertices this far apart are two to every judge with the default tolerance of 1 mm, in whatever
/// numbers it computes: a micrometre more, as far as coordinates are exact here.
inline constexpr double kSurelyApart_m = 0.001001;

/// What validate() finds with its default tolerances in a building that oriel is about to write,
/// and where that is nothing, what a judge finds whose decisions differ where the tolerances leave
/// them open: vertices exactly 1 mm apart are one to it, and any two triangles of a polygon may be
/// those that it compares (E345).
std::vector<Finding> validate_closely(const Building& written);

}  // namespace oriel
