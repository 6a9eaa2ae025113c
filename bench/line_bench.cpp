/// The straight line on one core: read, solidify, segment, describe, interpret, write; each stage
/// by itself, and reading beside a peer that only parses the same file. `bench/run.sh` runs it.
#include "examples/generator/cityjson.h"
#include "examples/generator/generate.h"
#include "examples/generator/random.h"
#include "interpret/annotate.h"
#include "interpret/interpret.h"
#include "interpret/rule_base.h"
#include "kernel/describe/describe.h"
#include "kernel/io/output_file.h"
#include "kernel/io/reader.h"
#include "kernel/io/writer.h"
#include "kernel/segment/segment.h"
#include "kernel/solidify/solidify.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

namespace {

using namespace oriel;

/// A generated house of about that many windows as a file that goes with the object.
class SampleFile {
 public:
  explicit SampleFile(int windows) {
    generator::Options options;
    options.seed = 3;
    options.windows = windows;
    generator::Random random(options.seed);
    generator::Building house{"house", generator::generate(options, 0), options.origin};
    house.body = generator::shuffled(house.body, random);
    path_ = (std::filesystem::temp_directory_path() /
             ("oriel-bench-" + std::to_string(windows) + ".city.json"))
                .string();
    write_file(path_, generator::cityjson(house, generator::Content::stripped));
  }
  ~SampleFile() { std::remove(path_.c_str()); }
  SampleFile(const SampleFile&) = delete;
  SampleFile& operator=(const SampleFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] Document document() const { return std::move(*Reader(path_).next()->value); }

 private:
  std::string path_;
};

const RuleBase& residential() {
  static const RuleBase base = *load_pack_file("residential").value;
  return base;
}

void line(benchmark::State& state) {
  const SampleFile file(static_cast<int>(state.range(0)));
  std::size_t bytes = 0, features = 0;
  for (auto _ : state) {
    const Document document = file.document();
    const Building& building = document.buildings.at(0);
    const auto solid = solidify(building);
    const Segmentation segmentation = segment(building, solid.value.value());
    const Description description = describe(building, segmentation);
    const Interpretation verdicts = interpret(residential(), description.table, description.graph);
    const std::string text =
        write_cityjson(document, {annotate(building, segmentation, description.table,
                                           description.graph, verdicts, residential())});
    bytes += text.size();
    features = verdicts.verdicts.size();
  }
  state.counters["features"] = static_cast<double>(features);
  benchmark::DoNotOptimize(bytes);
}

void read(benchmark::State& state) {
  const SampleFile file(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(file.document());
}

/// The peer: nlohmann-json parses the file and does nothing else.
void read_nlohmann(benchmark::State& state) {
  const SampleFile file(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    std::ifstream in(file.path());
    benchmark::DoNotOptimize(nlohmann::json::parse(in));
  }
}

void solidify_only(benchmark::State& state) {
  const SampleFile file(static_cast<int>(state.range(0)));
  const Document document = file.document();
  for (auto _ : state) benchmark::DoNotOptimize(solidify(document.buildings.at(0)));
}

void segment_only(benchmark::State& state) {
  const SampleFile file(static_cast<int>(state.range(0)));
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
