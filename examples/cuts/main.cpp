/// Draws how a building is cut: `oriel-cuts INPUT OUT.svg [natural|paper]`, the first building of
/// INPUT. The picture of docs/segmentation.md is made by it.
#include "examples/cuts/svg.h"
#include "io/files/output_file.h"
#include "io/reader.h"
#include "kernel/segment/segment.h"
#include "kernel/solidify/solidify.h"

#include <exception>
#include <string>

#include <fmt/format.h>

namespace {

using namespace oriel;

int draw(const std::string& input, const std::string& output, Order order) {
  Reader reader(input);
  for (auto record = reader.next(); record; record = reader.next()) {
    if (!record->value || record->value->buildings.empty()) continue;
    const Building& building = record->value->buildings.front();
    const auto solid = solidify(building);
    if (!solid.value) break;
    SegmentOptions options;
    options.order = order;
    write_file(output, cuts::draw_cuts(segment(building, *solid.value, options)));
    return 0;
  }
  fmt::print(stderr, "oriel-cuts: no solid in {}; oriel segment says why\n", input);
  return 3;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string order = argc > 3 ? argv[3] : "natural";
  if (argc < 3 || argc > 4 || (order != "natural" && order != "paper")) {
    fmt::print(stderr, "usage: oriel-cuts INPUT OUT.svg [natural|paper]\n");
    return 2;
  }
  try {
    return draw(argv[1], argv[2], order == "paper" ? Order::paper : Order::natural);
  } catch (const std::exception& error) {
    fmt::print(stderr, "oriel-cuts: {}\n", error.what());
    return 5;
  }
}
