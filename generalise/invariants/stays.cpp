#include "generalise/invariants/stays.h"

#include "generalise/invariants/fineness.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace oriel::detail {

std::set<int> polygons_named(const Solid& solid) {
  std::set<int> polygons;
  for (const Facet& facet : solid.facets)
    polygons.insert(facet.polygons.begin(), facet.polygons.end());
  return polygons;
}

bool loses_what_stays(const Solid& before, const Solid& left, const Segmentation& segmentation,
                      const std::vector<FeatureId>& gone) {
  return loses_what_stays(polygons_named(before), polygons_named(left), segmentation, gone);
}

bool loses_what_stays(const std::set<int>& had, const std::set<int>& has,
                      const Segmentation& segmentation, const std::vector<FeatureId>& gone) {
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

StayingFeatures::StayingFeatures(const Segmentation& segmentation,
                                 const std::vector<FeatureId>& removed) {
  for (const FeatureId i : ids_below<FeatureId>(segmentation.features.size())) {
    if (std::ranges::binary_search(removed, i)) continue;
    const Feature& feature = segmentation.features[i.index()];
    if (!feature.outline.empty())
      outlines_.push_back(segmentation.vertices[at(feature.outline[0])].point);
    polygons_.insert(polygons_.end(), feature.source_polygons.begin(),
                     feature.source_polygons.end());
  }
  std::ranges::sort(polygons_);
}

std::optional<std::string> StayingFeatures::why_it_stays(const Solid& left,
                                                         const Facet& facet) const {
  const Plane& plane = left.planes[facet.plane.index()];
  Box box;
  for (const int v : facet.loops[0]) box.grow(left.vertices[at(v)].point);
  const auto lies_in = [&](Vec3 corner) {
    return std::abs(dot(plane.normal, corner) - plane.offset_m) <= kOnBox_m &&
           contains(box, corner, kOnBox_m);
  };
  if (std::ranges::any_of(outlines_, lies_in)) return "an outline is drawn in it";
  const auto is_theirs = [&](int polygon) {
    return std::ranges::binary_search(polygons_, polygon);
  };
  if (!facet.polygons.empty() && std::ranges::all_of(facet.polygons, is_theirs))
    return "it is of a feature that stays";
  return std::nullopt;
}

}  // namespace oriel::detail
