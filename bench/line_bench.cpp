/// The straight line on one core: read, solidify, segment, describe, interpret, write; each stage
/// by itself, and reading beside a peer that only parses the same file. `bench/run.sh line` runs
/// it.
#include "bench/sample_file.h"
#include "interpret/labelling/interpret.h"
#include "interpret/pack/rule_base.h"
#include "interpret/surfaces/annotate.h"
#include "kernel/describe/describe.h"
#include "kernel/describe/surfaces.h"
#include "kernel/io/writer.h"
#include "kernel/segment/flush/imprints.h"
#include "kernel/segment/segment.h"
#include "kernel/solidify/solidify.h"

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
    const Building& building = document.buildings.at(0);
    const auto solid = solidify(building);
    Segmentation segmentation = segment(building, solid.value.value());
    add_imprints(building, *solid.value, segmentation);
    const Description description = describe(building, segmentation);
    const Interpretation verdicts = interpret(residential(), description.table, description.graph);
    const SurfaceTable surfaces =
        describe_surfaces(building, {}, {&*solid.value, &segmentation, &description.table});
    const std::string text =
        write_cityjson(document, {annotate(building, segmentation, description.table,
                                           description.graph, surfaces, verdicts, residential())});
    bytes += text.size();
    features = verdicts.verdicts.size();
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
