#include "cli/timings.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel::cli {

std::string Timings::to_json() const {
  constexpr std::array<const char*, kStages> kNames = {
      "read", "solidify", "segment", "describe", "interpret", "generalise", "write"};
  std::string out = "{";
  for (std::size_t s = 0; s < kStages; ++s) {
    std::vector<double> values;
    for (const auto& run : runs_) values.push_back(run[s]);
    std::ranges::sort(values);
    const std::size_t n = values.size();
    const double median = n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
    out += fmt::format("\"{}_ms\":{:.3f},", kNames[s], median);
  }
  return out + fmt::format("\"runs\":{}}}\n", runs_.size());
}

}  // namespace oriel::cli
