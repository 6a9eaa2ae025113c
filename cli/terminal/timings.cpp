#include "cli/terminal/timings.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel::cli {

void Timings::add(const Timings& more) {
  for (std::size_t s = 0; s < ms_.size(); ++s) ms_[s] += more.ms_[s];
}

std::string to_json(const std::vector<Timings>& runs) {
  std::string out = "{";
  for (std::size_t s = 0; s < kStageNames.size(); ++s) {
    std::vector<double> values;
    for (const Timings& run : runs) values.push_back(run.ms(static_cast<Stage>(s)));
    std::ranges::sort(values);
    const std::size_t n = values.size();
    const double median = n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
    out += fmt::format("\"{}_ms\":{:.3f},", kStageNames[s], median);
  }
  return out + fmt::format("\"runs\":{}}}\n", runs.size());
}

}  // namespace oriel::cli
