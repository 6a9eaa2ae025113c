#pragma once

#include "interpret/experiment/learn/learning_set.h"
#include "interpret/experiment/learn/search/param_search.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace oriel {

/// Moves several params of a run together, where moving one after the other leads no further: a
/// controlled random search (NLopt's GN_CRS2_LM) in the neighbourhood of where the run stands, with
/// so many measurements at most. The run changes only if its objective grows. The same seed gives
/// the same result; one thread at a time may search.
void search_jointly(const LearningSet& set, SearchRun& run, std::span<const std::size_t> params,
                    int most_measurements, std::uint64_t seed);

}  // namespace oriel
