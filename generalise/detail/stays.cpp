#include "generalise/detail/stays.h"

#include <algorithm>
#include <set>

namespace oriel::detail {

namespace {

std::set<int> polygons_named(const Solid& solid) {
  std::set<int> polygons;
  for (const Facet& facet : solid.facets)
    polygons.insert(facet.polygons.begin(), facet.polygons.end());
  return polygons;
}

}  // namespace

bool loses_what_stays(const Solid& before, const Solid& left, const Segmentation& segmentation,
                      const std::vector<FeatureId>& gone) {
  const std::set<int> had = polygons_named(before), has = polygons_named(left);
  const auto is_named = [](const std::set<int>& polygons, const std::vector<int>& its) {
    return std::ranges::any_of(its, [&](int polygon) { return polygons.contains(polygon); });
  };
  std::vector<char> goes(segmentation.features.size(), 0);
  for (const FeatureId id : gone) goes[id.index()] = 1;
  const auto carries_gone = [&](const std::vector<int>& its) {
    return std::ranges::any_of(gone, [&](FeatureId id) {
      const auto& inner = segmentation.features[id.index()].source_polygons;
      return !inner.empty() && std::ranges::includes(its, inner);
    });
  };
  for (std::size_t i = 0; i < segmentation.features.size(); ++i) {
    const auto& its = segmentation.features[i].source_polygons;
    if (goes[i] != 0 || its.empty() || carries_gone(its)) continue;
    if (is_named(had, its) && !is_named(has, its)) return true;
  }
  return false;
}

}  // namespace oriel::detail
