/// Labels of stored features under settings of a pack.
///   bench_experiment full RECORDS PACK RUNS     microseconds of interpret() and score() a building
#include "bench/timing.h"
#include "interpret/labelling/labelling.h"
#include "interpret/labelling/interpret.h"
#include "interpret/pack/rule_base.h"
#include "kernel/io/records/feature_tables.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

using namespace oriel;

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const auto rules = load_pack_file(argv[3]);
  const auto tables = read_feature_tables(argv[2]);
  if (!rules.value || !tables.value) return 1;
  const auto runs = static_cast<std::size_t>(std::atoi(argv[4]));
  std::size_t rows = 0;
  const double ms = bench::cpu_ms_of(runs, [&] {
    rows = 0;
    for (const auto& b : *tables.value) rows += interpret(*rules.value, b.table, b.graph).verdicts.size();
  });
  const auto n = static_cast<double>(tables.value->size());
  const double context_ms = bench::cpu_ms_of(runs, [&] {
    for (const auto& b : *tables.value) rules::EvaluationContext(rules.value->pack(), b.table, b.graph);
  });
  fmt::print("buildings={} rows={} interpret_us={:.1f} context_us={:.1f}\n", n, rows, ms * 1e3 / n, context_ms * 1e3 / n);
  const rules::Pack& pack = rules.value->pack();
  for (std::size_t s = 0; s < pack.steps.size(); ++s) {
    fmt::print("step {} {} {}:", s, pack.steps[s].is_decision ? "decision" : "predicates", pack.steps[s].is_recursive ? "recursive" : "");
    for (int r : pack.steps[s].rules) fmt::print(" {}", pack.rules[size_t(r)].id);
    fmt::print("\n");
  }
  // by rule
  std::vector<double> us(pack.rules.size());
  for (const auto& b : *tables.value) {
    rules::EvaluationContext context(pack, b.table, b.graph);
    rules::Labelling(pack, context).run();
    rules::Evaluator evaluator(pack, context);
    for (std::size_t r = 0; r < pack.rules.size(); ++r) {
      us[r] += 1e3 * bench::cpu_ms_of(1, [&] {
        evaluator.forget();
        for (int k = 0; k < 10; ++k) { evaluator.forget(); judge(pack, pack.rules[r], evaluator, context.row_numbers); }
      }) / 10;
    }
  }
  double all = 0;
  for (std::size_t r = 0; r < us.size(); ++r) { fmt::print("{:8.2f} {}\n", us[r] / n, pack.rules[r].id); all += us[r] / n; }
  fmt::print("{:8.2f} all\n", all);
}
