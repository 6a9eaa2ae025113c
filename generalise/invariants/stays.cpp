#include "generalise/invariants/stays.h"

#include "generalise/invariants/fineness.h"
#include "kernel/base/index.h"
#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace oriel::detail {

namespace {

std::set<int> polygons_named(const Solid& solid) {
  std::set<int> polygons;
  for (const Facet& facet : solid.facets)
    polygons.insert(facet.polygons.begin(), facet.polygons.end());
  return polygons;
}

/// A facet of a solid, to be asked for what lies in it.
class FacetPlace {
 public:
  FacetPlace(const Solid& solid, const Facet& facet) : plane_(solid.planes[facet.plane.index()]) {
    for (const int v : facet.loops[0]) box_.grow(solid.vertices[at(v)].point);
  }

  /// The outline, if there is one, lies in the facet.
  [[nodiscard]] bool has(const Loop& outline, const Segmentation& segmentation) const {
    if (outline.empty()) return false;
    const Vec3 corner = segmentation.vertices[at(outline[0])].point;
    return std::abs(dot(plane_.normal, corner) - plane_.offset_m) <= kOnBox_m &&
           contains(box_, corner, kOnBox_m);
  }

 private:
  const Plane& plane_;
  Box box_;
};

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

std::optional<std::string> why_it_stays(const Solid& left, const Facet& facet,
                                        const Segmentation& segmentation,
                                        const std::vector<FeatureId>& removed) {
  std::vector<int> others = facet.polygons;
  const FacetPlace place(left, facet);
  for (int i = 0; i < std::ssize(segmentation.features); ++i) {
    if (std::ranges::binary_search(removed, FeatureId{i})) continue;
    const Feature& feature = segmentation.features[at(i)];
    if (place.has(feature.outline, segmentation)) return "an outline is drawn in it";
    if (others.empty()) continue;
    std::erase_if(others, [&](int polygon) {
      return std::ranges::binary_search(feature.source_polygons, polygon);
    });
  }
  if (!facet.polygons.empty() && others.empty()) return "it is of a feature that stays";
  return std::nullopt;
}

}  // namespace oriel::detail
