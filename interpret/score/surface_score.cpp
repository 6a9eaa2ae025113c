#include "interpret/score/surface_score.h"

#include "interpret/surfaces/polygon_shape.h"

#include <limits>

namespace oriel {

namespace {

bool is_opening(const std::string& type) { return type == "Window" || type == "Door"; }

/// What we call a polygon that they call `theirs`: "" if nothing.
std::string our_type(const LabelledBuilding& labelled, int polygon, const std::string& theirs,
                     OpeningPolicy policy) {
  const auto source = static_cast<std::size_t>(polygon);
  if (source >= labelled.surface_of_polygon.size()) return "";
  const int number = labelled.surface_of_polygon[source];
  if (number < 0) return "";
  const SemanticSurface& surface = labelled.surfaces[static_cast<std::size_t>(number)];
  if (!is_opening(surface.type) || surface.parent < 0) return surface.type;
  const std::string& around = labelled.surfaces[static_cast<std::size_t>(surface.parent)].type;
  return policy == OpeningPolicy::as_host || around == theirs ? around : surface.type;
}

double ratio(double part, double whole) {
  return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void compare_surfaces(const Building& building, const LabelledBuilding& labelled,
                      const SurfaceTable& surfaces, OpeningPolicy policy, SurfaceScore& score) {
  for (std::size_t row = 0; row < building.polygons.size(); ++row) {
    const Polygon& polygon = building.polygons[row];
    const double area_m2 = surfaces.number(row, SurfaceAttribute::area).value_or(0);
    ++score.polygons;
    if (polygon.hint.empty()) {
      score.unnamed_m2 += area_m2;
      continue;
    }
    if (policy == OpeningPolicy::as_host && is_opening(polygon.hint)) {
      score.openings_m2 += area_m2;
      continue;
    }
    const std::string ours = our_type(labelled, polygon.source, polygon.hint, policy);
    score.area_m2[{polygon.hint, ours}] += area_m2;
    if (ours == polygon.hint) continue;
    const Box box = rules::box_of(building, polygon).moved(building.frame.origin_m);
    score.differences.push_back(
        {building.id, polygon.source, polygon.hint, ours, area_m2, 0.5 * (box.min + box.max)});
  }
}

double SurfaceScore::recall(const std::string& type) const {
  double agreed = 0, all = 0;
  for (const auto& [types, area] : area_m2) {
    if (types.first != type) continue;
    all += area;
    if (types.second == type) agreed += area;
  }
  return ratio(agreed, all);
}

double SurfaceScore::precision(const std::string& type) const {
  double agreed = 0, all = 0;
  for (const auto& [types, area] : area_m2) {
    if (types.second != type) continue;
    all += area;
    if (types.first == type) agreed += area;
  }
  return ratio(agreed, all);
}

double SurfaceScore::agreement() const {
  double agreed = 0, all = 0;
  for (const auto& [types, area] : area_m2) {
    all += area;
    if (types.first == types.second) agreed += area;
  }
  return ratio(agreed, all);
}

}  // namespace oriel
