#include "kernel/segment/flush/draw_imprints.h"

#include "kernel/base/index.h"
#include "kernel/geometry/outlines.h"
#include "kernel/segment/flush/facet_splitter.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace oriel {

namespace {

using detail::Outline;

auto key_of(const Plane& plane) { return std::pair(plane.coefficients, plane.offset); }

class ImprintDrawer {
 public:
  ImprintDrawer(Solid solid, const Segmentation& segmentation, double snap_m)
      : segmentation_(segmentation), splitter_(std::move(solid), snap_m) {
    for (int f = 0; f < std::ssize(facets()); ++f) enter(f);
  }

  Solid run(const std::vector<FeatureId>& imprints) {
    for (const FeatureId id : imprints) draw(segmentation_.features[id.index()]);
    return splitter_.take();
  }

 private:
  [[nodiscard]] const std::vector<Facet>& facets() const { return splitter_.solid().facets; }

  void enter(int f) {
    for (const int polygon : facets()[at(f)].polygons) facets_of_[polygon].push_back(FacetId{f});
  }

  void draw(const Feature& imprint) {
    Outline outline;
    for (const int v : imprint.outline) outline.push_back(segmentation_.vertices[at(v)].point);
    const Plane& plane = segmentation_.planes[imprint.planes.front().index()];
    const auto home = home_of(imprint, plane);
    if (!home) return;
    const auto before = static_cast<int>(facets().size());
    splitter_.split(*home, outline, imprint.source_polygons);
    for (int f = before; f < std::ssize(facets()); ++f) enter(f);
  }

  /// The facet of its plane around the middle of an imprint.
  [[nodiscard]] std::optional<FacetId> home_of(const Feature& imprint, const Plane& plane) const {
    std::vector<FacetId> candidates;
    for (const int polygon : imprint.source_polygons)
      if (const auto found = facets_of_.find(polygon); found != facets_of_.end())
        candidates.insert(candidates.end(), found->second.begin(), found->second.end());
    std::ranges::sort(candidates);
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    for (const FacetId f : candidates) {
      if (key_of(splitter_.solid().planes[facets()[f.index()].plane.index()]) != key_of(plane))
        continue;
      const auto outlines =
          detail::outlines_of(splitter_.solid().vertices, facets()[f.index()].loops);
      // The middle may lie in the recess that a sash makes: then the outer loop decides.
      if (detail::contains({outlines.data(), 1}, plane.normal, imprint.cap_point) &&
          has_polygon_of(imprint, facets()[f.index()]))
        return f;
    }
    return std::nullopt;
  }

  [[nodiscard]] static bool has_polygon_of(const Feature& imprint, const Facet& facet) {
    std::vector<int> common;
    std::ranges::set_intersection(imprint.source_polygons, facet.polygons,
                                  std::back_inserter(common));
    return !common.empty();
  }

  const Segmentation& segmentation_;
  detail::FacetSplitter splitter_;
  /// By Polygon::source; facets that have been split since may no longer name the polygon.
  std::unordered_map<int, std::vector<FacetId>> facets_of_;
};

}  // namespace

Solid draw_imprints(Solid solid, const Segmentation& segmentation,
                    const std::vector<FeatureId>& imprints, const Tolerances& tolerances) {
  if (imprints.empty()) return solid;
  const double snap_m = tolerances.plane_offset_m + tolerances.weld_m;
  return ImprintDrawer(std::move(solid), segmentation, snap_m).run(imprints);
}

}  // namespace oriel
