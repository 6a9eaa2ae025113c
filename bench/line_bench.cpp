/// A building from file to file on one core: read, label, write, as the command does it; two of the
/// stages by themselves, and reading beside a peer that only parses the same file. `bench/run.sh
/// line` runs it.
#include "bench/sample_file.h"
#include "kernel/segment/segment.h"
#include "kernel/solidify/solidify.h"
#include "oriel/oriel.h"

#include <fstream>
#include <string>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

namespace {

using namespace oriel;

using bench::SampleFile;

/// A generated house of about so many windows.
SampleFile house(const benchmark::State& state) {
  generator::Options options;
  options.seed = 3;
  options.windows = static_cast<int>(state.range(0));
  return SampleFile(options);
}

const RuleBase& residential() {
  static const RuleBase base = *load_pack_file("residential").value;
  return base;
}

void line(benchmark::State& state) {
  const SampleFile file = house(state);
  std::size_t bytes = 0, features = 0;
  for (auto _ : state) {
    const Document document = file.document();
    OutputRecord output;
    const PipelineResult result = label(document.buildings.at(0), residential());
    add(result.output, output);
    bytes += write(document, output).size();
    features = result.interpretation.verdicts.size();
  }
  state.counters["features"] = static_cast<double>(features);
  benchmark::DoNotOptimize(bytes);
}

void read(benchmark::State& state) {
  const SampleFile file = house(state);
  for (auto _ : state) benchmark::DoNotOptimize(file.document());
}

/// The peer: nlohmann-json parses the file and does nothing else.
void read_nlohmann(benchmark::State& state) {
  const SampleFile file = house(state);
  for (auto _ : state) {
    std::ifstream in(file.path());
    benchmark::DoNotOptimize(nlohmann::json::parse(in));
  }
}

void solidify_only(benchmark::State& state) {
  const SampleFile file = house(state);
  const Document document = file.document();
  for (auto _ : state) benchmark::DoNotOptimize(solidify(document.buildings.at(0)));
}

void segment_only(benchmark::State& state) {
  const SampleFile file = house(state);
  const Document document = file.document();
  const auto solid = solidify(document.buildings.at(0));
  SegmentOptions options;
  options.order = state.range(1) != 0 ? Order::paper : Order::natural;
  for (auto _ : state)
    benchmark::DoNotOptimize(segment(document.buildings.at(0), solid.value.value(), options));
}

BENCHMARK(line)->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(read)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(read_nlohmann)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(solidify_only)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(segment_only)
    ->ArgNames({"windows", "paper"})
    ->ArgsProduct({{100, 1000}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
