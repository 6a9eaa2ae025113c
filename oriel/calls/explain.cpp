#include "oriel/explain.h"

#include "interpret/surfaces/surfaces.h"
#include "kernel/base/text/printable.h"
#include "kernel/geometry/outlines.h"
#include "model/polygon_owners.h"
#include "model/vec3.h"
#include "oriel/corrections.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

SurfaceTable surfaces_with_parts(const Building& building, const PipelineResult& result,
                                 const RuleBase& rules) {
  static const Segmentation none;
  return with_parts(result.surfaces, building, result.segmentation ? *result.segmentation : none,
                    result.interpretation, rules);
}

/// Nothing where nobody corrected the feature.
std::optional<CorrectedLabel> correction_of(const PipelineResult& result, FeatureId feature) {
  const auto found = std::ranges::find(result.corrections, feature,
                                       [](const LabelCorrection& c) { return c.before.feature; });
  if (found == result.corrections.end()) return std::nullopt;
  const std::string& label = result.interpretation.verdicts.at(feature.index()).label.text();
  return CorrectedLabel{label.empty() ? "unknown" : label, found->by, found->why, found->place};
}

/// Places are given to the centimetre or so, and recesses that matter are deeper.
constexpr double kReach_m = 0.05;

}  // namespace

std::vector<std::string> names_of_features(const PipelineResult& result) {
  if (!result.is_done()) return {};
  return feature_names(*result.segmentation, result.description.table, &result.interpretation);
}

std::vector<FeatureId> find_features(const PipelineResult& result, std::string_view text) {
  const FeatureTable& table = result.description.table;
  if (const FeatureId exact = table.find(text); exact.is_valid()) return {exact};
  std::vector<FeatureId> found;
  for (int i = 0; i < static_cast<int>(table.rows()); ++i)
    if (table.id(FeatureId{i}).starts_with(text)) found.push_back(FeatureId{i});
  if (!found.empty()) return found;
  for (const std::size_t row : find_names(names_of_features(result), text))
    found.push_back(FeatureId{static_cast<int>(row)});
  return found;
}

Explanation explain(const PipelineResult& result, const RuleBase& rules, FeatureId feature) {
  const auto& [table, graph, issues] = result.description;
  const Interpretation by_rules = without_corrections(result);
  Explanation explanation = explain(rules, table, graph, by_rules, feature);
  explanation.name = names_of_features(result).at(feature.index());
  explanation.corrected = correction_of(result, feature);
  return explanation;
}

std::vector<Explanation> explain_features(const PipelineResult& result, const RuleBase& rules) {
  std::vector<Explanation> all;
  if (!result.is_done()) return all;
  const auto& [table, graph, issues] = result.description;
  const Interpretation by_rules = without_corrections(result);
  const Explainer explainer(rules, table, graph, by_rules);
  std::vector<std::string> names = names_of_features(result);
  for (int i = 0; i < static_cast<int>(table.rows()); ++i) {
    all.push_back(explainer.explain(FeatureId{i}));
    all.back().name = std::move(names[static_cast<std::size_t>(i)]);
    all.back().corrected = correction_of(result, FeatureId{i});
  }
  return all;
}

std::vector<SurfaceExplanation> explain_surfaces(const Building& building,
                                                 const PipelineResult& result,
                                                 const RuleBase& rules) {
  std::vector<SurfaceExplanation> all;
  if (!result.has_surfaces()) return all;
  const SurfaceTable table = surfaces_with_parts(building, result, rules);
  for (const SurfaceVerdict& verdict : interpret_surfaces(rules, table))
    all.push_back({verdict.type, {}});
  const std::vector<std::string> reasons = explain_surfaces(rules, table);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].reason = reasons[i];
  return all;
}

std::string explain_surface(const Building& building, const PipelineResult& result,
                            const RuleBase& rules, std::size_t polygon) {
  const SurfaceTable table = surfaces_with_parts(building, result, rules);
  return fmt::format("{}: polygon {} is ", printable(building.id),
                     building.polygons[polygon].source) +
         explain_surface(rules, table, polygon);
}

std::optional<PolygonAt> polygon_at(const Building& building, Vec3 point) {
  const Vec3 local = point - building.frame.origin_m;
  std::optional<PolygonAt> nearest;
  for (std::size_t i = 0; i < building.polygons.size(); ++i) {
    const auto outlines = outlines_of(building, building.polygons[i]);
    if (outlines.empty() || outlines[0].empty()) continue;
    const Vec3 normal = normalised(area_vector(outlines[0]));
    const double distance = std::abs(dot(local - outlines[0][0], normal));
    if (distance > kReach_m || (nearest && distance >= nearest->distance_m)) continue;
    if (contains(outlines, normal, local)) nearest = PolygonAt{i, distance};
  }
  return nearest;
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
