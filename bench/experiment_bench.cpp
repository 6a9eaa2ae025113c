/// Labels of stored features under many settings of a pack: processor time on one thread, features
/// and truth in memory.
///   bench_experiment sweep RECORDS TRUTH PACK VALUES   every param with a range at so many values
///   bench_experiment ablate RECORDS TRUTH PACK         without each piece that can be left out
///   bench_experiment random RECORDS TRUTH PACK COUNT   so many settings, all params at random
///   bench_experiment learn RECORDS TRUTH PACK FOLDS SEED [RESTARTS]
///                              learns all params from values at random; seed 0: from the pack's
/// One line, but for learn: samples, features, settings, seconds in all, microseconds a sample and
/// setting, those of interpret() and score() for comparison, and bytes a feature above the features
/// themselves.
#include "bench/peak_memory.h"
#include "bench/timing.h"
#include "interpret/labelling/interpret.h"
#include "interpret/learn/count_variants.h"
#include "interpret/pack/rule_base.h"
#include "kernel/base/random.h"
#include "oriel/learn.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <fmt/format.h>

namespace {

using namespace oriel;

std::vector<Sample> samples_in(const std::string& records, const std::string& truth,
                               const RuleBase& rules) {
  auto samples = read_samples(std::span(&records, 1), std::span(&truth, 1), rules);
  if (!samples.value) throw std::runtime_error(to_string(samples.issues.front()));
  return std::move(*samples.value);
}

std::vector<Variant> swept(const RuleBase& rules, int values) {
  std::vector<Variant> variants;
  for (const PackParam& param : params_of(rules)) {
    if (!param.range) continue;
    const auto [low, high] = *param.range;
    for (int i = 0; i < values; ++i)
      variants.push_back(
          variant_with(rules, {{param.name, low + (high - low) * i / std::max(1, values - 1)}}));
  }
  return variants;
}

std::vector<Variant> drawn(const RuleBase& rules, int count) {
  Random random(1);
  std::vector<Variant> variants;
  for (int i = 0; i < count; ++i) {
    std::vector<ParamValue> values;
    for (const PackParam& param : params_of(rules))
      if (param.range)
        values.push_back(
            {param.name,
             param.range->first + (param.range->second - param.range->first) * random.unit()});
    variants.push_back(variant_with(rules, std::move(values)));
  }
  return variants;
}

double microseconds_alone(const RuleBase& rules, const std::vector<Sample>& samples) {
  std::size_t labelled = 0;
  const double ms = bench::cpu_ms_of(3, [&] {
    for (const Sample& sample : samples) {
      std::vector<Prediction> predictions;
      for (const Verdict& verdict :
           interpret(rules, sample.features.table, sample.features.graph).verdicts) {
        Prediction& prediction = predictions.emplace_back();
        prediction.building = sample.features.table.building();
        prediction.id = sample.features.table.id(verdict.feature);
        prediction.label = verdict.label;
        prediction.box = sample.boxes[verdict.feature.index()];
      }
      labelled += score(predictions, sample.truth).classes.size();
    }
  });
  return labelled == 0 ? 0 : ms * 1e3 / static_cast<double>(samples.size());
}

/// Every param somewhere in its range, if the seed is not 0.
RuleBase moved(const RuleBase& rules, std::uint64_t seed) {
  RuleBase at = rules;
  Random random(seed);
  for (const PackParam& param : params_of(rules)) {
    if (seed == 0 || !param.range) continue;
    const double value =
        param.range->first + (param.range->second - param.range->first) * random.unit();
    const std::vector<ParamValue> values{{param.name, value}};
    if (auto next = with_params(at, values); next.value) at = *next.value;
  }
  return at;
}

void on_two_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  const std::jthread other(take);
  take();
}

int learn(const std::vector<std::string>& arguments) {
  const auto rules = load_pack_file(arguments[2]);
  if (!rules.value) return EXIT_FAILURE;
  const std::vector<Sample> samples = samples_in(arguments[0], arguments[1], *rules.value);
  const auto folds = static_cast<std::size_t>(std::atoi(arguments[3].c_str()));
  const auto seed = static_cast<std::uint64_t>(std::atoi(arguments[4].c_str()));
  LearnOptions options;
  if (arguments.size() > 5) options.restarts = std::atoi(arguments[5].c_str());
  const auto parts = folds_of(samples.size(), folds, 1);
  const auto start = std::chrono::steady_clock::now();
  const auto learnt =
      learn_params(moved(*rules.value, seed), samples, parts, options, on_two_threads);
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (const Issue& issue : learnt.issues) fmt::print("{}\n", to_string(issue));
  if (!learnt.value) return EXIT_FAILURE;
  const Learnt& l = *learnt.value;
  const std::vector<Variant> as_it_is{{"as it is", {}, {}, {}}};
  const double shipped = macro_f1(count_variants(*rules.value, as_it_is, samples).value->total(0));
  fmt::print(
      "learn s={:.1f} all {:.4f} -> {:.4f}, held out {:.4f} -> {:.4f} [{:+.4f} {:+.4f}], shipped "
      "{:.4f} {}\n",
      s, l.before, l.after, l.held_out_before, l.held_out_after, l.held_out_gain.low,
      l.held_out_gain.high, shipped, l.reason);
  for (const LearntParam& p : l.params)
    fmt::print("  {} {:.4f} -> {} gain {:.4f} [{:.4f} {:.4f}] folds {}\n", p.value.name, p.before,
               p.value.value, p.gain, p.interval.low, p.interval.high, p.folds);
  for (const auto& fold : l.by_fold) {
    fmt::print("  fold:");
    for (const ParamValue& p : fold) fmt::print(" {}={}", p.name, p.value);
    fmt::print("\n");
  }
  for (const KnifeEdge& e : l.knife_edges)
    fmt::print("  knife edge {} = {}: {:+.4f} at {:.4f} ({:.2f} %), {} objects\n", e.param, e.value,
               e.change, e.flip, 100 * e.distance_share, e.objects);
  return EXIT_SUCCESS;
}

int run(const std::string& what, const std::vector<std::string>& arguments) {
  const auto rules = load_pack_file(arguments[2]);
  if (!rules.value) return EXIT_FAILURE;
  const std::vector<Sample> samples = samples_in(arguments[0], arguments[1], *rules.value);
  std::size_t rows = 0;
  for (const Sample& sample : samples) rows += sample.features.table.rows();
  const int count = arguments.size() > 3 ? std::atoi(arguments[3].c_str()) : 0;
  std::vector<Variant> variants = what == "sweep"    ? swept(*rules.value, count)
                                  : what == "random" ? drawn(*rules.value, count)
                                                     : ablations(*rules.value);
  std::erase_if(variants,
                [&](const Variant& v) { return !with_params(*rules.value, v.params).value; });
  double best = 0;
  std::size_t bytes = 0;
  const double ms = bench::cpu_ms_of(1, [&] {
    bytes = bench::peak_bytes_of([&] {
      const auto counted = count_variants(*rules.value, variants, samples).value.value();
      for (std::size_t v = 0; v < counted.variants(); ++v)
        best = std::max(best, macro_f1(counted.total(v)));
    });
  });
  const double runs = static_cast<double>(variants.size()) * static_cast<double>(samples.size());
  fmt::print(
      "{} samples={} features={} settings={} s={:.3f} us/run={:.1f} alone_us={:.1f} "
      "bytes/feature={} best={:.4f}\n",
      what, samples.size(), rows, variants.size(), ms / 1e3, ms * 1e3 / runs,
      microseconds_alone(*rules.value, samples), bytes / std::max<std::size_t>(1, rows), best);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + std::min(argc, 2), argv + argc);
  const std::string_view what = argc > 1 ? argv[1] : "";
  const bool is_counted = what == "sweep" || what == "random";
  const bool is_learn = what == "learn" && arguments.size() >= 5;
  if (!is_learn &&
      ((what != "ablate" && !is_counted) || arguments.size() != (is_counted ? 4U : 3U))) {
    fmt::print(stderr,
               "usage: bench_experiment sweep|random RECORDS TRUTH PACK COUNT | ablate RECORDS "
               "TRUTH PACK | learn RECORDS TRUTH PACK FOLDS SEED [RESTARTS]\n");
    return 2;
  }
  return what == "learn" ? learn(arguments) : run(std::string(what), arguments);
}
