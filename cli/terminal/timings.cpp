#include "cli/terminal/timings.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

void Timings::add(const Timings& more) {
  for (std::size_t s = 0; s < ms_.size(); ++s) ms_[s] += more.ms_[s];
}

std::string to_json(const std::vector<Timings>& runs) {
  constexpr std::array<std::pair<Stage, const char*>, 7> kStages = {
      {{Stage::read, "read"},
       {Stage::solidify, "solidify"},
       {Stage::segment, "segment"},
       {Stage::describe, "describe"},
       {Stage::interpret, "interpret"},
       {Stage::generalise, "generalise"},
       {Stage::write, "write"}}};
  std::string out = "{";
  for (const auto& [stage, name] : kStages) {
    std::vector<double> values;
    for (const Timings& run : runs) values.push_back(run.ms(stage));
    std::ranges::sort(values);
    const std::size_t n = values.size();
    const double median = n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
    out += fmt::format("\"{}_ms\":{:.3f},", name, median);
  }
  return out + fmt::format("\"runs\":{}}}\n", runs.size());
}

}  // namespace oriel::cli
