/// The eight rules of ../shared/peers/rules by a pack, as the peers do them: processor time on one
/// thread from columns in memory to labels, relations included. bench/rules.sh runs it beside them.
///   bench_rules FEATURES.csv PACK.yaml RUNS    one line as the peers print it
///   bench_rules --load RULES RUNS              milliseconds to load and check a pack of so many
///   bench_rules --explain FEATURES.csv PACK.yaml RUNS
///                                              the same with bare labels, with what is kept for
///                                              explanations, and with all reasons written
#include "bench/facade_features.h"
#include "bench/timing.h"
#include "interpret/explain/explain.h"
#include "interpret/labelling/groups.h"
#include "interpret/labelling/interpret.h"
#include "interpret/labelling/labelling.h"
#include "interpret/pack/rule_base.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <vector>

#include <fmt/format.h>

namespace {

using namespace oriel;

/// What the peers' checksum goes by.
struct Labelled {
  std::uint8_t label = 0;
  bool is_in_row = false;
};

std::uint8_t number_of_label(std::string_view label) {
  static constexpr std::array<std::string_view, 7> kLabels = {
      "", "chimney", "door", "window", "window_weak", "dormer", "balcony"};
  for (std::size_t i = 0; i < kLabels.size(); ++i)
    if (label == kLabels[i]) return static_cast<std::uint8_t>(i);
  if (label == "light") return 3;
  throw std::runtime_error("the peers have no label " + std::string(label));
}

std::vector<Labelled> label(const RuleBase& rules,
                            const std::vector<bench::FacadeBuilding>& buildings) {
  std::vector<Labelled> all;
  Name last;
  std::uint8_t code = 0;
  for (const bench::FacadeBuilding& building : buildings) {
    const Interpretation said = interpret(rules, building.table, relate(building));
    const std::size_t first = all.size();
    for (const Verdict& verdict : said.verdicts) {
      if (verdict.label != last) code = number_of_label(verdict.label);
      last = verdict.label;
      all.push_back({code, false});
    }
    for (const Group& row : said.groups)
      for (const FeatureId member : row.members) all[first + member.index()].is_in_row = true;
  }
  return all;
}

std::uint64_t checksum(const std::vector<Labelled>& labels) {
  std::uint64_t sum = 0;
  for (const Labelled& l : labels)
    sum = sum * 1099511628211U + l.label * 2U + (l.is_in_row ? 1U : 0U) + 1U;
  return sum;
}

long resident_kb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

int measure_labels(const std::string& features, const std::string& pack, std::size_t runs) {
  const auto rules = load_pack_file(pack);
  for (const Issue& issue : rules.issues) fmt::print(stderr, "{}\n", to_string(issue));
  if (!rules.value) return EXIT_FAILURE;
  const long before = resident_kb();
  const auto buildings = bench::read_facade_features(features);
  std::vector<Labelled> labels;
  const double ms = bench::cpu_ms_of(runs, [&] { labels = label(*rules.value, buildings); });
  fmt::print("oriel n={} run_s={:.6f} facts/s={:.0f} rss_kb={} cs={:016x}\n", labels.size(),
             ms / 1e3, static_cast<double>(labels.size()) / (ms / 1e3), resident_kb() - before,
             checksum(labels));
  return EXIT_SUCCESS;
}

/// Rules of the usual size, each with an id of its own.
std::string pack_of(int rules) {
  std::string text =
      "schema: oriel/1\npack: {name: many, version: 1.0.0}\n"
      "params:\n  sill_max: {value: 0.6 m, range: 0.3 m .. 1 m, why: door sills}\n"
      "classes: {opening: {abstract: true}, window: {is: opening}, door: {is: opening}}\n"
      "macros: {vertical: 'inclination in 80 deg .. 100 deg'}\nrules:\n"
      "  - {id: opening.shape, label: opening, require: 'sense in [hole, imprint] and vertical'}\n";
  for (int i = 1; i < rules; ++i)
    text += fmt::format(
        "  - id: {0}.r{1}\n    label: {0}\n    priority: {1}\n    require:\n"
        "      - self is opening and host is wall and base_height > $sill_max\n"
        "      - b in 0.3 m .. 2.{1} m and depth <= 0.6 m\n"
        "      - count(same_facade where is opening and abs(base_height - self.base_height) <= 0.2 "
        "m) >= 2\n"
        "    unless: [quality > 0.9 and not natural]\n"
        "    score:\n      - a: {{rise: 1.6 m .. 2.0 m, fall: 2.6 m .. 3.2 m, weight: 2}}\n"
        "      - count(alike where is opening): {{rise: 0 .. 3}}\n",
        i % 2 == 0 ? "window" : "door", i);
  return text;
}

/// A label and groups, nothing that an explanation needs: neither the rule nor its score nor the
/// margin nor the runner-up leave the labelling.
struct BareVerdict {
  FeatureId feature;
  Name label;
};

std::size_t label_barely(const rules::Pack& pack, const bench::FacadeBuilding& building) {
  const FeatureGraph graph = relate(building);
  rules::EvaluationContext context(pack, rules::PackValues(pack), building.table, graph);
  rules::Labelling labelling(pack, context);
  const auto choices = labelling.run();
  const auto groups = rules::find_groups(pack, context, building.table);
  std::vector<BareVerdict> verdicts(choices.size());
  for (std::size_t row = 0; row < verdicts.size(); ++row) {
    verdicts[row].feature = FeatureId{static_cast<int>(row)};
    if (choices[row].rule >= 0)
      verdicts[row].label = pack.rules[at(choices[row].rule)].name_of_label;
  }
  return verdicts.size() + groups.size();
}

/// The reason of every feature that has a label, in one line, as label --explain writes it.
std::size_t explain_all(const RuleBase& rules, const FeatureTable& table, const FeatureGraph& graph,
                        const Interpretation& interpretation) {
  const Explainer explainer(rules, table, graph, interpretation);
  std::size_t written = 0;
  for (const Verdict& verdict : interpretation.verdicts)
    if (!verdict.label.empty()) written += reason(explainer.explain(verdict.feature)).size();
  return written;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Bare and off take turns, so that what else the machine does hits both; the ratio is the median
/// of those of each turn. On takes long, and so no more than three turns.
int measure_explain(const std::string& features, const std::string& pack, std::size_t runs) {
  const auto rules = load_pack_file(pack);
  if (!rules.value) return EXIT_FAILURE;
  const auto buildings = bench::read_facade_features(features);
  constexpr std::size_t kMostOn = 3;
  std::vector<double> bare, off, on, ratios;
  std::size_t rows = 0, written = 0;
  for (std::size_t run = 0; run < runs; ++run) {
    bare.push_back(bench::cpu_ms_of(1, [&] {
      for (const auto& b : buildings) label_barely(rules.value->pack(), b);
    }));
    off.push_back(bench::cpu_ms_of(1, [&] {
      rows = 0;
      for (const auto& b : buildings)
        rows += interpret(*rules.value, b.table, relate(b)).verdicts.size();
    }));
    ratios.push_back(off.back() / bare.back());
    if (run >= kMostOn) continue;
    on.push_back(bench::cpu_ms_of(1, [&] {
      written = 0;
      for (const auto& b : buildings) {
        const FeatureGraph graph = relate(b);
        const Interpretation said = interpret(*rules.value, b.table, graph);
        written += explain_all(*rules.value, b.table, graph, said);
      }
    }));
  }
  fmt::print(
      "explain n={} bare_ms={:.1f} off_ms={:.1f} off/bare={:.3f} on_ms={:.0f} written_mb={:.1f}\n",
      rows, median(bare), median(off), median(ratios), median(on),
      static_cast<double>(written) / 1e6);
  return EXIT_SUCCESS;
}

int measure_load(int count, std::size_t runs) {
  const std::string text = pack_of(count);
  std::size_t rules = 0;
  const double ms = bench::cpu_ms_of(runs, [&] {
    const auto loaded = load_pack(text, "many.yaml");
    rules = loaded.value ? loaded.value->rule_count() : 0;
  });
  fmt::print("load rules={} ms={:.2f}\n", rules, ms);
  return rules == static_cast<std::size_t>(count) ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  const bool is_of_reasons = argc == 5 && std::string_view(argv[1]) == "--explain";
  if (argc != 4 && !is_of_reasons) {
    fmt::print(stderr,
               "usage: bench_rules FEATURES.csv PACK.yaml RUNS | --load RULES RUNS | --explain "
               "FEATURES.csv PACK.yaml RUNS\n");
    return 2;
  }
  const auto runs = static_cast<std::size_t>(std::max(1, std::atoi(argv[argc - 1])));
  if (is_of_reasons) return measure_explain(argv[2], argv[3], runs);
  if (std::string_view(argv[1]) == "--load") return measure_load(std::atoi(argv[2]), runs);
  return measure_labels(argv[1], argv[2], runs);
}
