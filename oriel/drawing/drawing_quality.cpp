#include "oriel/drawing/drawing_quality.h"

#include "io/levels/written_grid.h"
#include "kernel/base/index.h"
#include "oriel/label.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace oriel {

namespace {

/// An object is found again if a feature with its label and it have more in common than not, by
/// area.
constexpr double kLeastCommon = 0.5;

struct DrawnObject {
  std::string label;
  std::vector<int> polygons;  ///< ascending
};

/// What is written with a label: openings and installations.
std::vector<DrawnObject> objects_of(const LabelledBuilding& drawn) {
  std::vector<DrawnObject> of_surfaces, objects;
  for (const SemanticSurface& surface : drawn.surfaces)
    of_surfaces.push_back({surface.label->label, {}});
  for (std::size_t i = 0; i < drawn.surface_of_polygon.size(); ++i)
    if (const int surface = drawn.surface_of_polygon[i]; surface >= 0)
      of_surfaces[at(surface)].polygons.push_back(static_cast<int>(i));
  for (DrawnObject& object : of_surfaces)
    if (!object.label.empty() && !object.polygons.empty()) objects.push_back(std::move(object));
  for (const Installation& installation : drawn.installations) {
    DrawnObject object{installation.label->label, installation.polygons};
    std::ranges::sort(object.polygons);
    if (!object.label.empty() && !object.polygons.empty()) objects.push_back(std::move(object));
  }
  return objects;
}

/// The building that is read again, with what the file calls its polygons.
Building read_again(const Document& document, const Building& building,
                    const LabelledBuilding& drawn) {
  Building again = as_written(document, building, *drawn.geometry);
  if (!drawn.lod.empty()) again.lod = drawn.lod;
  for (Polygon& polygon : again.polygons) {
    const std::size_t number = at(polygon.source);
    const int surface =
        number < drawn.surface_of_polygon.size() ? drawn.surface_of_polygon[number] : -1;
    if (surface >= 0) polygon.hint = drawn.surfaces[at(surface)].type;
  }
  return again;
}

std::vector<double> areas_of(const Solid& solid) {
  std::vector<double> areas;
  for (const Facet& facet : solid.facets)
    areas.push_back(area_m2(solid.vertices, facet, solid.planes[facet.plane.index()].normal));
  return areas;
}

double sum_of(const std::vector<int>& polygons, const std::vector<double>& areas) {
  double sum = 0;
  for (const int polygon : polygons)
    if (at(polygon) < areas.size()) sum += areas[at(polygon)];
  return sum;
}

bool is_found(const DrawnObject& object, const PipelineResult& again,
              const std::vector<double>& areas) {
  return std::ranges::any_of(again.interpretation.verdicts, [&](const Verdict& verdict) {
    if (verdict.label != object.label) return false;
    const auto& polygons = again.segmentation->features[verdict.feature.index()].source_polygons;
    std::vector<int> common;
    std::ranges::set_intersection(object.polygons, polygons, std::back_inserter(common));
    const double both = sum_of(common, areas);
    const double either = sum_of(object.polygons, areas) + sum_of(polygons, areas) - both;
    return both > 0 && both >= kLeastCommon * either;
  });
}

DrawingQuality quality_of(const Building& building, const LabelledBuilding& labelled,
                          const Solid& solid, const FeatureTable* features, double least_m) {
  const auto openings = written_openings(building, labelled);
  return {legibility_of(solid, openings, features, least_m), facade_quality(openings)};
}

}  // namespace

DrawingQuality quality_before(const Building& building, const PipelineResult& result,
                              const RuleBase& rules, const LabelOptions& options, double least_m) {
  return quality_of(building, annotate(building, result, rules, options), *result.solid,
                    &result.description.table, least_m);
}

DrawingQuality quality_after(const Document& document, const Building& building,
                             const LabelledBuilding& drawn, const RuleBase& rules,
                             const LabelOptions& options, double least_m,
                             std::map<std::string, FoundAgain>& again) {
  LabelOptions alone = options;
  alone.observer = {};
  alone.neighbours = nullptr;
  alone.corrections = nullptr;
  alone.has_reasons = false;
  alone.has_output = false;
  alone.measures_features = true;
  const PipelineResult found = label(read_again(document, building, drawn), rules, alone);
  const std::vector<double> areas = areas_of(*drawn.geometry);
  for (const DrawnObject& object : objects_of(drawn)) {
    FoundAgain& count = again[object.label];
    ++count.drawn;
    if (found.is_done() && is_found(object, found, areas)) ++count.found;
  }
  return quality_of(building, drawn, *drawn.geometry,
                    found.is_done() ? &found.description.table : nullptr, least_m);
}

}  // namespace oriel
