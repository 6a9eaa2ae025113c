#pragma once

#include "generalise/series/scale_series.h"

#include <vector>

namespace oriel::detail {

/// The operations of scale_series() that lead from one level to the next. `state` is the one
/// before and becomes the one after them.
std::vector<SeriesOperation> operations_between(const SeriesInput& input, const SeriesLevel& before,
                                                const SeriesLevel& after, LevelState& state,
                                                const FiringScales& firing, const Placer& place);

}  // namespace oriel::detail
