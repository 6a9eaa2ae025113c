#include "cli/line.h"

#include "interpret/interpret.h"
#include "kernel/segment/imprints.h"
#include "kernel/solidify/solidify.h"

#include <exception>
#include <iterator>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

void append(std::vector<Issue>& all, std::vector<Issue> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

OnLine run_line(const Building& building, const SegmentOptions& options, const RuleBase* rules,
                Timings& timings) {
  OnLine out;
  try {
    auto solid =
        timings.measure(Stage::solidify, [&] { return solidify(building, options.tolerances); });
    append(out.issues, std::move(solid.issues));
    if (!solid.value) return out;
    out.solid = std::move(solid.value);
    Segmentation segmentation =
        timings.measure(Stage::segment, [&] { return segment(building, *out.solid, options); });
    timings.measure(Stage::segment,
                    [&] { add_imprints(building, *out.solid, segmentation, options.tolerances); });
    append(out.issues, segmentation.issues);
    out.description =
        timings.measure(Stage::describe, [&] { return describe(building, segmentation); });
    if (rules != nullptr) {
      out.interpretation = timings.measure(Stage::interpret, [&] {
        return interpret(*rules, out.description.table, out.description.graph);
      });
      append(out.issues, out.interpretation.issues);
    }
    out.segmentation = std::move(segmentation);
  } catch (const std::exception& fault) {
    out.issues.push_back(building_issue(Severity::error, "E901", building.id,
                                        fmt::format("a fault of oriel's own: {}", fault.what())));
  }
  return out;
}

}  // namespace oriel::cli
