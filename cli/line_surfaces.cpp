#include "cli/line_surfaces.h"

#include <exception>

#include <fmt/format.h>

namespace oriel::cli {

void describe_line_surfaces(const Building& building, const Tolerances& tolerances,
                            Timings& timings, OnLine& line) {
  SurfaceContext context;
  if (line.solid && !line.is_open) context.solid = &*line.solid;
  if (line.segmentation) {
    context.segmentation = &*line.segmentation;
    context.features = &line.description.table;
  }
  try {
    line.surfaces = timings.measure(
        Stage::describe, [&] { return describe_surfaces(building, tolerances, context); });
  } catch (const std::exception& fault) {
    line.issues.push_back(building_issue(Severity::error, "E901", building.id,
                                         fmt::format("a fault of oriel's own: {}", fault.what())));
  }
}

}  // namespace oriel::cli
