#pragma once

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace oriel::bench {

/// Milliseconds of processor time that a call of `work` takes: the median of so many calls. Other
/// programs on the machine hardly change it.
template <class Work>
double cpu_ms_of(std::size_t calls, const Work& work) {
  std::vector<double> times;
  for (std::size_t i = 0; i < calls; ++i) {
    const std::clock_t start = std::clock();
    work();
    const std::clock_t end = std::clock();
    times.push_back(1e3 * static_cast<double>(end - start) / CLOCKS_PER_SEC);
  }
  std::ranges::sort(times);
  return times[calls / 2];
}

}  // namespace oriel::bench
