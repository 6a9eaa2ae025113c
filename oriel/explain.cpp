#include "oriel/explain.h"

#include "interpret/surfaces/surfaces.h"
#include "kernel/model/polygon_owners.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel {

std::vector<FeatureId> find_features(const PipelineResult& result, std::string_view id) {
  const FeatureTable& table = result.description.table;
  if (const FeatureId exact = table.find(id); exact.is_valid()) return {exact};
  std::vector<FeatureId> found;
  for (int i = 0; i < static_cast<int>(table.rows()); ++i)
    if (table.id(FeatureId{i}).starts_with(id)) found.push_back(FeatureId{i});
  return found;
}

Explanation explain(const PipelineResult& result, const RuleBase& rules, FeatureId feature) {
  const auto& [table, graph] = result.description;
  return explain(rules, table, graph, result.interpretation, feature);
}

std::string explain_surface(const Building& building, const PipelineResult& result,
                            const RuleBase& rules, std::size_t polygon) {
  const SurfaceTable table =
      with_parts(result.surfaces, building, result.segmentation.value_or(Segmentation{}),
                 result.interpretation, rules);
  return fmt::format("{}: polygon {} is ", building.id, building.polygons[polygon].source) +
         explain_surface(rules, table, polygon);
}

FeatureId feature_of(const Building& building, const PipelineResult& result, std::size_t polygon) {
  if (!result.is_done()) return {};
  const auto owners = polygon_owners(*result.segmentation, building);
  const auto& features = owners[static_cast<std::size_t>(building.polygons[polygon].source)];
  if (features.empty()) return {};
  const auto labelled = std::ranges::find_if(features, [&](int feature) {
    return !result.interpretation.verdicts[static_cast<std::size_t>(feature)].label.empty();
  });
  return FeatureId{labelled == features.end() ? features.front() : *labelled};
}

}  // namespace oriel
