#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oriel {

/// Samples by their numbers, ascending.
using SamplePart = std::vector<std::size_t>;

/// All of so many.
SamplePart all_samples(std::size_t count);

/// Those of `samples` that are not in the part.
SamplePart outside(const SamplePart& part, const SamplePart& samples);

/// Parts of so many samples, each to be held out in turn: drawn by the seed, as large as each other
/// but for one; with 0 folds each sample by itself. Never more parts than samples.
std::vector<SamplePart> folds_of(std::size_t samples, std::size_t folds, std::uint64_t seed);

}  // namespace oriel
