/// Segmentation and solidify by themselves, building in memory to result in memory, over size,
/// irregularity and order of cuts. `bench/run.sh segment` runs it.
#include "bench/peak_memory.h"
#include "bench/sample_file.h"
#include "kernel/segment/segment.h"
#include "kernel/solidify/solidify.h"

#include <benchmark/benchmark.h>

namespace {

using namespace oriel;

/// A gabled house of about so many windows on four plain walls, a door and a chimney. Jittered, no
/// two windows are in line: nearly every one has planes of its own.
Building house(const benchmark::State& state) {
  generator::Options options;
  options.seed = 3;
  options.roof = generator::RoofKind::gable;
  options.windows = static_cast<int>(state.range(0));
  if (state.range(1) != 0) options.jitter = 300'000;
  return std::move(bench::SampleFile(options).document().buildings.at(0));
}

double megabytes(std::size_t bytes) { return static_cast<double>(bytes) / 1e6; }

/// Peak memory above building and solid, the result in it.
void segmentation(benchmark::State& state) {
  const Building building = house(state);
  const Solid solid = solidify(building).value.value();
  SegmentOptions options;
  options.order = state.range(2) != 0 ? Order::paper : Order::natural;
  for (auto _ : state) benchmark::DoNotOptimize(segment(building, solid, options));
  Segmentation result;
  state.counters["peak_MB"] =
      megabytes(bench::peak_bytes_of([&] { result = segment(building, solid, options); }));
  state.counters["planes"] = static_cast<double>(solid.planes.size());
  state.counters["cells"] = static_cast<double>(result.cells.size());
}

/// Peak memory above the building, the solid in it.
void solidification(benchmark::State& state) {
  const Building building = house(state);
  for (auto _ : state) benchmark::DoNotOptimize(solidify(building));
  Checked<Solid> result;
  state.counters["peak_MB"] = megabytes(bench::peak_bytes_of([&] { result = solidify(building); }));
  state.counters["planes"] = static_cast<double>(result.value.value().planes.size());
}

BENCHMARK(segmentation)
    ->ArgNames({"windows", "jittered", "paper"})
    ->ArgsProduct({{20, 100, 500, 2000}, {0, 1}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(solidification)
    ->ArgNames({"windows", "jittered"})
    ->ArgsProduct({{20, 100, 500, 2000}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
