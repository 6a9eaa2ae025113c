#pragma once

#include "cli/pipeline/line.h"

namespace oriel::cli {

/// Fills line.surfaces, whether the building came to the end of the line or not. A fault of ours is
/// E901.
void describe_line_surfaces(const Building& building, const Tolerances& tolerances,
                            Timings& timings, OnLine& line);

/// Fills line.surfaces as far as its surfaces cannot be named without, and names them. Their
/// attributes are not to be asked for.
void name_line_surfaces(const Building& building, const Tolerances& tolerances,
                        const RuleBase& rules, Timings& timings, OnLine& line);

}  // namespace oriel::cli
