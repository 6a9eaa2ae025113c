#include "kernel/validate/validate_closely.h"

#include "kernel/validate/polygons/polygon_checks.h"
#include "kernel/validate/polygons/snapped.h"
#include "kernel/validate/proof/valid_solid.h"

#include <algorithm>

namespace oriel {

namespace {

/// True if there are vertices that are one to a judge who takes points of this distance for one.
bool has_doubtful_vertices(const Building& building) {
  const auto used = [&](double snap_m) {
    std::vector<int> vertices;
    const auto judged = detail::snapped(building, snap_m);
    if (!judged) return vertices;
    for (const detail::SnappedPolygon& polygon : judged->polygons)
      for (const auto& ring : polygon.rings)
        vertices.insert(vertices.end(), ring.begin(), ring.end());
    return vertices;
  };
  return used(ValidateOptions{}.snap_m) != used(kSurelyApart_m);
}

/// It has two triangles at most, which validate() has compared.
bool is_soon_judged(const detail::SnappedPolygon& polygon) {
  constexpr std::size_t kCornersOfTwo = 4;
  return polygon.rings.size() == 1 && polygon.rings[0].size() <= kCornersOfTwo;
}

/// Where polygons, which validate() found good, are folded between any two of their triangles.
std::vector<Finding> folds_in(const Building& building) {
  const auto judged = detail::snapped(building, ValidateOptions{}.snap_m);
  if (!judged) return {};
  detail::FindingList findings(*judged);
  for (const detail::SnappedPolygon& polygon : judged->polygons)
    if (!is_soon_judged(polygon))
      detail::judge(*judged, polygon, {}, findings, detail::FoldsBetween::any_two);
  return findings.take();
}

/// It is soon seen that nothing is wrong: no two vertices are near each other, and the rest is
/// proved.
bool is_surely_valid(const Building& written) {
  if (!written.is_solid || written.is_composite || !written.installations.empty()) return false;
  const auto judged = detail::snapped(written, kSurelyApart_m);
  return judged && judged->are_all_apart && detail::is_surely_valid_solid(*judged, {});
}

}  // namespace

std::vector<Finding> validate_closely(const Building& written) {
  if (is_surely_valid(written)) return {};
  auto findings = validate(written);
  if (findings.empty()) findings = folds_in(written);
  if (!findings.empty() || !has_doubtful_vertices(written)) return findings;
  ValidateOptions wide;
  wide.snap_m = kSurelyApart_m;
  return validate(written, wide);
}

}  // namespace oriel
