#pragma once

#include "cli/line.h"
#include "kernel/model/tolerances.h"

namespace oriel::cli {

/// Fills line.surfaces, whether the building came to the end of the line or not. A fault of ours is
/// an error E901 of that building.
void describe_line_surfaces(const Building& building, const Tolerances& tolerances,
                            Timings& timings, OnLine& line);

}  // namespace oriel::cli
