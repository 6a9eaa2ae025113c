// Google Benchmark: how long a stage takes, over sizes.
// Trap: a result that nothing uses is optimised away, and the loop with it: DoNotOptimize keeps it.
// Trap: milliseconds of a shared machine mislead; quote ratios within one run.
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

void measure_lengths(benchmark::State& state) {
  const std::vector<double> squares(static_cast<std::size_t>(state.range(0)), 2.0);
  for (auto step : state) {
    double sum = 0;
    for (const double square : squares) sum += std::sqrt(square);
    benchmark::DoNotOptimize(sum);
  }
  state.SetComplexityN(state.range(0));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(measure_lengths)->RangeMultiplier(4)->Range(64, 4096)->Complexity(benchmark::oN);

BENCHMARK_MAIN();
