#include "interpret/surfaces/surfaces.h"

#include "kernel/describe/surfaces.h"
#include "oriel/pipeline/outlook.h"
#include "oriel/pipeline/pipeline.h"

#include <algorithm>
#include <array>
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

}  // namespace

FoundSurfaces describe_all_surfaces(const Building& building, const LabelOptions& options,
                                    const PipelineResult& result) {
  return measured(
      options.observer, Stage::describe, "described surfaces", building,
      [&] {
        FoundSurfaces found{
            describe_surfaces(building, result.tolerances, context_of(result)), {}, {}};
        std::vector<int> rows(found.surfaces.rows());
        std::iota(rows.begin(), rows.end(), 0);
        describe_outlook_of_surfaces(building, rows, options, result.surroundings, found.surfaces);
        return found;
      },
      [](const FoundSurfaces& found) { return fmt::format("surfaces={}", found.surfaces.rows()); });
}

FoundSurfaces name_surfaces(const Building& building, const RuleBase& rules,
                            const LabelOptions& options, const PipelineResult& result) {
  static const Segmentation none;
  std::vector<int> rows;
  return measured(
      options.observer, Stage::describe, "named surfaces", building,
      [&] {
        const Segmentation& segmentation = result.segmentation ? *result.segmentation : none;
        PolygonOwners owners = polygon_owners(segmentation, building);
        rows = rows_to_name(building, owners, result.interpretation, rules);
        SurfaceContext context = context_of(result);
        context.owners = &owners;
        SurfaceSurvey survey(building, result.tolerances, context, rows);
        SurfaceTable& table = survey.table();
        describe_outlook_of_surfaces(building, rows, options, result.surroundings, table);
        table = with_parts(std::move(table), building, owners, result.interpretation, rules, rows);
        MeasuredWhenAsked more(survey);
        auto named = interpret_surfaces(rules, table, rows, more);
        return FoundSurfaces{std::move(table), std::move(named), std::move(owners)};
      },
      [&](const FoundSurfaces& /*found*/) { return fmt::format("surfaces={}", rows.size()); });
}

}  // namespace oriel
