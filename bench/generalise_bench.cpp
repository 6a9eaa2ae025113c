/// Generalising a labelled building, in memory to in memory, over size: to one scale, to LoD 2.0,
/// and a series of eight scales, its levels alone and with the operations between them.
/// `bench/run.sh generalise` runs it.
#include "bench/peak_memory.h"
#include "bench/sample_file.h"
#include "generalise/generalise.h"
#include "generalise/series/scale_series.h"
#include "generalise/series/series_levels.h"
#include "interpret/plan/plan.h"
#include "oriel/drawing/targets.h"
#include "oriel/label.h"

#include <cmath>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace oriel;

const RuleBase& residential() {
  static const RuleBase base = *load_pack_file("residential").value;
  return base;
}

const std::vector<double> kScales{500, 1000, 1500, 2000, 2500, 3500, 5000, 10000};

/// A generated house of about so many windows, labelled, and what is asked of it.
struct LabelledHouse : SeriesOrder {
  Building building;
  PipelineResult result;

  explicit LabelledHouse(const benchmark::State& state) {
    generator::Options options;
    options.seed = 3;
    options.windows = static_cast<int>(state.range(0));
    building = std::move(bench::SampleFile(options).document().buildings.at(0));
    result = label(building, residential());
  }

  [[nodiscard]] Plan plan_at(double scale) const override {
    return plan(residential(), result.description.table, result.description.graph,
                result.interpretation, scale);
  }

  /// As the command asks for it without a profile.
  [[nodiscard]] Invariants invariants_at(double scale) const override {
    Invariants invariants;
    invariants.least_edge_m = kGapOnMap_m * scale;
    return invariants;
  }

  [[nodiscard]] RedrawContext context() const {
    return redraw_context(building, result, result.output);
  }

  [[nodiscard]] Redrawn at_scale(double scale) const {
    RedrawContext at = context();
    at.invariants = invariants_at(scale);
    return redraw(at, std::move(generalise(at, plan_at(scale)).value.value()));
  }
};

/// The place of a point in a file of whole millimetres.
MicrometrePoint on_millimetres(Vec3 local_m) {
  const auto place = [](double m) { return 1000 * std::llround(1000 * m); };
  return {place(local_m.x), place(local_m.y), place(local_m.z)};
}

double megabytes(std::size_t bytes) { return static_cast<double>(bytes) / 1e6; }

/// Peak memory above the labelled building, the result in it.
void to_scale(benchmark::State& state) {
  const LabelledHouse house(state);
  const auto scale = static_cast<double>(state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(house.at_scale(scale));
  Redrawn result;
  state.counters["peak_MB"] =
      megabytes(bench::peak_bytes_of([&] { result = house.at_scale(scale); }));
  state.counters["facets"] =
      static_cast<double>(result.labelled.geometry.value_or(*house.result.solid).facets.size());
}

void series_of_eight(benchmark::State& state) {
  const LabelledHouse house(state);
  const RedrawContext context = house.context();
  const bool with_log = state.range(1) != 0;
  std::size_t operations = 0;
  const auto run = [&] {
    const auto levels = series_levels(context, house, kScales).value.value();
    if (!with_log) return levels.size();
    const FiringScales firing(kScales, plan_bounds(residential()), house);
    return scale_series(context, house, levels, firing, on_millimetres).operations.size();
  };
  for (auto _ : state) operations = run();
  state.counters["peak_MB"] = megabytes(bench::peak_bytes_of([&] { operations = run(); }));
  state.counters[with_log ? "operations" : "levels"] = static_cast<double>(operations);
}

BENCHMARK(to_scale)
    ->ArgNames({"windows", "scale"})
    ->ArgsProduct({{20, 100, 500, 2000}, {1000, 2500, 10000}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(series_of_eight)
    ->ArgNames({"windows", "log"})
    ->ArgsProduct({{20, 100, 500, 2000}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
