/// Segments every building of some files in both orders and prints one row an order: how many
/// solids and cells, how long a building takes, and why leaves that are not convex stayed whole.
/// `bench_corpus NAME LOD INPUT…`, LOD `-` for the highest; bench/corpus.sh runs it.
#include "bench/timing.h"
#include "io/reader.h"
#include "kernel/segment/segment.h"
#include "kernel/solidify/solidify.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace {

using namespace oriel;

/// A building's time is the median of so many calls.
constexpr std::size_t kCalls = 3;

struct Sample {
  Building building;
  Solid solid;
};

struct Corpus {
  std::size_t read = 0;
  std::vector<Sample> samples;
};

Corpus read_corpus(const std::string& lod, int count, char** paths) {
  Corpus corpus;
  ReadOptions options;
  if (lod != "-") options.lod = lod;
  for (int i = 0; i < count; ++i) {
    Reader reader(paths[i], options);
    while (auto record = reader.next()) {
      if (!record->value) continue;
      for (Building& building : record->value->buildings) {
        ++corpus.read;
        auto solid = solidify(building);
        if (solid.value) corpus.samples.push_back({std::move(building), std::move(*solid.value)});
      }
    }
  }
  return corpus;
}

/// The smallest of the sorted values that a share of them does not exceed.
double quantile(const std::vector<double>& sorted, double share) {
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

void report(const std::string& name, const Corpus& corpus, Order order) {
  SegmentOptions options;
  options.order = order;
  std::vector<double> times;
  std::size_t cells = 0;
  std::map<LeafFlag, int> leaves;
  for (const Sample& sample : corpus.samples) {
    Segmentation result;
    times.push_back(bench::cpu_ms_of(
        kCalls, [&] { result = segment(sample.building, sample.solid, options); }));
    cells += result.cells.size();
    for (const Cell& cell : result.cells) ++leaves[cell.flag];
  }
  std::ranges::sort(times);
  const std::string solids = fmt::format("{} of {}", corpus.samples.size(), corpus.read);
  fmt::print("{:<18}{:<8}  {:>12}{:>9} | {:>10.2f}{:>10.2f}{:>10.2f} | {:>6}{:>14}{:>7}{:>8}\n",
             name, to_string(order), solids, cells, quantile(times, 0.5), quantile(times, 0.99),
             times.back(), leaves[LeafFlag::own], leaves[LeafFlag::no_candidate],
             leaves[LeafFlag::cycle], leaves[LeafFlag::budget]);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: bench_corpus NAME LOD INPUT...\n");
    return 2;
  }
  const Corpus corpus = read_corpus(argv[2], argc - 3, argv + 3);
  if (corpus.samples.empty()) {
    fmt::print(stderr, "bench_corpus: no solid in {}\n", argv[1]);
    return 1;
  }
  for (const Order order : {Order::natural, Order::paper}) report(argv[1], corpus, order);
}
