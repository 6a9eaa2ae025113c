/// Labels every building of some files and prints what it costs per polygon: one row for the set
/// and one for each of its slowest buildings, with the stage that takes most of their time.
/// `bench_slowest NAME LOD ROWS INPUT…`, LOD `-` for the highest; bench/slowest.sh runs it.
/// Fails if a building takes more than kMostTimes the set's median per polygon.
#include "bench/timing.h"
#include "oriel/oriel.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <ranges>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace {

using namespace oriel;

/// A building's time is the median of so many calls.
constexpr std::size_t kCalls = 3;
/// Issue 28: no building costs more than this many times the median per polygon.
constexpr double kMostTimes = 100;

constexpr std::array<const char*, 7> kStageNames{"read",      "solidify",   "segment", "describe",
                                                 "interpret", "generalise", "write"};

struct Cost {
  std::string id;
  std::size_t polygons = 0;
  double ms = 0;
  std::size_t stage = 0;  ///< that takes most of it
  double share = 0;       ///< of the time of all stages

  [[nodiscard]] double us_per_polygon() const { return 1e3 * ms / static_cast<double>(polygons); }
};

Cost cost_of(const Building& building, const RuleBase& rules) {
  std::array<double, kStageNames.size()> stages{};
  LabelOptions options;
  options.observer = [&](Stage stage, double ms) {
    stages.at(static_cast<std::size_t>(stage)) += ms;
  };
  Cost cost;
  cost.id = building.id;
  cost.polygons = building.polygons.size();
  cost.ms = bench::cpu_ms_of(kCalls, [&] { label(building, rules, options); });
  const auto slowest = std::ranges::max_element(stages);
  double sum = 0;
  for (const double ms : stages) sum += ms;
  cost.stage = static_cast<std::size_t>(slowest - stages.begin());
  cost.share = sum > 0 ? *slowest / sum : 0;
  return cost;
}

std::vector<Cost> costs_of(const RuleBase& rules, const std::string& lod, int count, char** paths) {
  std::vector<Cost> costs;
  ReadOptions options;
  if (lod != "-") options.lod = lod;
  for (int i = 0; i < count; ++i) {
    Reader reader(paths[i], options);
    while (auto record = reader.next()) {
      if (!record->value) continue;
      for (const Building& building : record->value->buildings)
        if (!building.polygons.empty()) costs.push_back(cost_of(building, rules));
    }
  }
  std::ranges::stable_sort(costs, std::ranges::greater(), &Cost::us_per_polygon);
  return costs;
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t rows = 0;
  if (argc > 4) {
    const std::string text = argv[3];
    std::from_chars(text.data(), text.data() + text.size(), rows);
  }
  if (rows == 0) {
    fmt::print(stderr, "usage: bench_slowest NAME LOD ROWS INPUT...\n");
    return 2;
  }
  const auto rules = load_pack_file("residential");
  const std::vector<Cost> costs = costs_of(*rules.value, argv[2], argc - 4, argv + 4);
  if (costs.empty()) {
    fmt::print(stderr, "bench_slowest: no building in {}\n", argv[1]);
    return 2;
  }
  const double median = costs[costs.size() / 2].us_per_polygon();
  for (const Cost& cost : costs | std::views::take(rows))
    fmt::print("{:<18}{:>10}{:>10.1f} | {:>9}{:>10.1f}{:>10.1f}{:>8.1f}  {:<9}{:>4.0f} %  {}\n",
               argv[1], costs.size(), median, cost.polygons, cost.ms, cost.us_per_polygon(),
               cost.us_per_polygon() / median, kStageNames.at(cost.stage), 100 * cost.share,
               cost.id);
  return costs.front().us_per_polygon() > kMostTimes * median ? 1 : 0;
}
