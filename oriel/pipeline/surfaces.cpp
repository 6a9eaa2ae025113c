#include "interpret/surfaces/surfaces.h"

#include "kernel/describe/surfaces.h"
#include "oriel/pipeline/outlook.h"
#include "oriel/pipeline/pipeline.h"

#include <algorithm>
#include <array>
#include <exception>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel {

namespace {

SurfaceContext context_of(const PipelineResult& result) {
  SurfaceContext context;
  if (result.is_solid()) context.solid = &*result.solid;
  if (result.segmentation) {
    context.segmentation = &*result.segmentation;
    context.features = &result.description.table;
  }
  return context;
}

/// The cheaper measures first.
class MeasuredWhenAsked : public MoreAttributes {
 public:
  explicit MeasuredWhenAsked(SurfaceSurvey& survey) : survey_(survey) {}

  [[nodiscard]] bool is_pending(SurfaceAttribute attribute) const override {
    const auto measure = measure_of(attribute);
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

/// Runs `describe`, which returns the number of surfaces; what it throws is a fault of ours in this
/// building, which is rejected.
template <class Describe>
void measured_describe(const Building& building, const StageObserver& observer,
                       PipelineResult& result, const char* done, Describe describe) {
  try {
    measured(observer, Stage::describe, done, building, describe,
             [](std::size_t surfaces) { return fmt::format("surfaces={}", surfaces); });
  } catch (const std::exception& fault) {
    result.segmentation.reset();  // nothing is drawn or counted of it
    result.issues.push_back(own_fault(building, fault));
  }
}

}  // namespace

void describe_all_surfaces(const Building& building, const Tolerances& tolerances,
                           const LabelOptions& options, PipelineResult& result) {
  measured_describe(building, options.observer, result, "described surfaces", [&] {
    SurfaceTable table = describe_surfaces(building, tolerances, context_of(result));
    std::vector<int> rows(table.rows());
    std::iota(rows.begin(), rows.end(), 0);
    describe_outlook_of_surfaces(building, rows, options, result, table);
    result.surfaces = std::move(table);
    return result.surfaces.rows();
  });
}

void name_surfaces(const Building& building, const Tolerances& tolerances, const RuleBase& rules,
                   const LabelOptions& options, PipelineResult& result) {
  static const Segmentation none;
  const Segmentation& segmentation = result.segmentation ? *result.segmentation : none;
  measured_describe(building, options.observer, result, "named surfaces", [&] {
    const PolygonOwners& owners = result.owners.emplace(polygon_owners(segmentation, building));
    const auto rows = rows_to_name(building, owners, result.interpretation, rules);
    SurfaceContext context = context_of(result);
    context.owners = &owners;
    SurfaceSurvey survey(building, tolerances, context, rows);
    SurfaceTable& table = survey.table();
    describe_outlook_of_surfaces(building, rows, options, result, table);
    table = with_parts(std::move(table), building, owners, result.interpretation, rules, rows);
    MeasuredWhenAsked more(survey);
    result.named_surfaces = interpret_surfaces(rules, table, rows, more);
    result.surfaces = std::move(table);
    return rows.size();
  });
}

}  // namespace oriel
