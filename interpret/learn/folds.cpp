#include "interpret/learn/folds.h"

#include "kernel/base/random.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace oriel {

SamplePart all_samples(std::size_t count) {
  SamplePart all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

SamplePart outside(const SamplePart& part, const SamplePart& samples) {
  SamplePart rest;
  std::ranges::set_difference(samples, part, std::back_inserter(rest));
  return rest;
}

std::vector<SamplePart> folds_of(std::size_t samples, std::size_t folds, std::uint64_t seed) {
  SamplePart all = all_samples(samples);
  std::vector<SamplePart> parts(std::min(folds == 0 ? samples : folds, samples));
  if (folds != 0) Random(seed).shuffle(all);
  for (std::size_t i = 0; i < all.size(); ++i) parts[i % parts.size()].push_back(all[i]);
  for (SamplePart& part : parts) std::ranges::sort(part);
  return parts;
}

}  // namespace oriel
