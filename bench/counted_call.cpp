/// One call of segment() or solidify() for callgrind to count: `bench_counted_call segment INPUT
/// ORDER` or `bench_counted_call solidify INPUT`. bench/instructions.sh runs it.
#include "io/reader.h"
#include "kernel/segment/segment.h"
#include "kernel/solidify/solidify.h"

#include <cstdio>
#include <string>

namespace {

using namespace oriel;

/// What is counted, and nothing else is: reading, and the call before that touches pages and binds
/// symbols, are outside.
extern "C" [[gnu::noinline]] void counted_call(const Building& building, const Solid* solid,
                                               const SegmentOptions& options) {
  if (solid != nullptr)
    segment(building, *solid, options);
  else
    solidify(building);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string stage = argc > 2 ? argv[1] : "";
  if (stage != "segment" && stage != "solidify") {
    std::fputs("usage: bench_counted_call segment|solidify INPUT [natural|paper]\n", stderr);
    return 2;
  }
  Reader reader(argv[2]);
  const Document document = std::move(*reader.next()->value);
  const Building& building = document.buildings.at(0);
  SegmentOptions options;
  if (argc > 3 && std::string(argv[3]) == "paper") options.order = Order::paper;
  const Solid solid = solidify(building).value.value();
  if (stage == "segment") segment(building, solid, options);
  counted_call(building, stage == "segment" ? &solid : nullptr, options);
}
