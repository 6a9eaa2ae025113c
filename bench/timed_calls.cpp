/// Prints the milliseconds that solidify() and segment() take for the building of a file, medians
/// of RUNS calls: `bench_timed_calls INPUT natural|paper RUNS`. bench/peers.sh runs it.
#include "bench/timing.h"
#include "io/reader.h"
#include "kernel/segment/segment.h"
#include "kernel/solidify/solidify.h"

#include <charconv>
#include <string>

#include <fmt/format.h>

using namespace oriel;

int main(int argc, char** argv) {
  std::size_t runs = 0;
  if (argc == 4) {
    const std::string text = argv[3];
    std::from_chars(text.data(), text.data() + text.size(), runs);
  }
  if (runs == 0) {
    fmt::print(stderr, "usage: bench_timed_calls INPUT natural|paper RUNS\n");
    return 2;
  }
  Reader reader(argv[1]);
  const Document document = std::move(*reader.next()->value);
  const Building& building = document.buildings.at(0);
  SegmentOptions options;
  if (std::string(argv[2]) == "paper") options.order = Order::paper;
  Checked<Solid> solid;
  const double solidified = bench::cpu_ms_of(runs, [&] { solid = solidify(building); });
  const double segmented =
      bench::cpu_ms_of(runs, [&] { segment(building, solid.value.value(), options); });
  fmt::print("{:.3f} {:.3f}\n", solidified, segmented);
}
