#include "cli/pipeline/line_surfaces.h"

#include <algorithm>
#include <array>
#include <exception>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

SurfaceContext context_of(const OnLine& line) {
  SurfaceContext context;
  if (line.solid && !line.is_open) context.solid = &*line.solid;
  if (line.segmentation) {
    context.segmentation = &*line.segmentation;
    context.features = &line.description.table;
  }
  return context;
}

/// The cheaper measures first.
class MeasuredWhenAsked : public MoreAttributes {
 public:
  explicit MeasuredWhenAsked(SurfaceSurvey& survey) : survey_(survey) {}

  [[nodiscard]] bool is_pending(std::size_t column) const override {
    const auto measure = measure_of(column);
    const auto pending = std::span(kSurfaceMeasures).subspan(done_);
    return measure && std::ranges::find(pending, *measure) != pending.end();
  }
  void measure(std::span<const int> rows) override {
    survey_.measure(kSurfaceMeasures.at(done_++), rows);
  }

 private:
  SurfaceSurvey& survey_;
  std::size_t done_ = 0;
};

/// Runs `describe`; what it throws is a fault of ours in this building.
template <class Describe>
void measured_describe(const Building& building, Timings& timings, OnLine& line,
                       Describe describe) {
  try {
    timings.measure(Stage::describe, describe);
  } catch (const std::exception& fault) {
    line.issues.push_back(building_issue(Severity::error, Code::E901, building.id,
                                         fmt::format("a fault of oriel's own: {}", fault.what())));
  }
}

}  // namespace

void describe_line_surfaces(const Building& building, const Tolerances& tolerances,
                            Timings& timings, OnLine& line) {
  measured_describe(building, timings, line, [&] {
    line.surfaces = describe_surfaces(building, tolerances, context_of(line));
  });
}

void name_line_surfaces(const Building& building, const Tolerances& tolerances,
                        const RuleBase& rules, Timings& timings, OnLine& line) {
  static const Segmentation none;
  const Segmentation& segmentation = line.segmentation ? *line.segmentation : none;
  measured_describe(building, timings, line, [&] {
    const PolygonOwners& owners = line.owners.emplace(polygon_owners(segmentation, building));
    const auto rows = rows_to_name(building, owners, line.interpretation, rules);
    SurfaceContext context = context_of(line);
    context.owners = &owners;
    SurfaceSurvey survey(building, tolerances, context, rows);
    SurfaceTable& table = survey.table();
    table = with_parts(std::move(table), building, owners, line.interpretation, rules, rows);
    MeasuredWhenAsked more(survey);
    line.named_surfaces = interpret_surfaces(rules, table, rows, more);
    line.surfaces = std::move(table);
  });
}

}  // namespace oriel::cli
