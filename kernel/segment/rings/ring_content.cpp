#include "kernel/segment/rings/ring_content.h"

#include "kernel/base/index.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// What floats in an opening is no further from the rest than an old wall is thick; nothing that
/// belongs to an opening is deeper than a loggia.
constexpr double kGap_m = 0.5;
constexpr double kDeepest_m = 4;
/// What looks along the normal of the facet, or against it, by 45° or less is in front of it or
/// behind it; the rest are sides.
const double kParallel = std::sqrt(0.5);

class ContentFinder {
 public:
  ContentFinder(const Ring& ring, const Solid& solid, const PolygonGrid& grid)
      : ring_(ring),
        facet_(solid.facets[ring.facet.index()]),
        plane_(solid.planes[facet_.plane.index()]),
        grid_(grid),
        axes_(axes_in(plane_.normal)),
        reach_(axes_.reach_of(ring.outline)),
        is_rectangle_(ring.area_m2 >= kRectangle * reach_.area()) {}

  RingContent run() {
    for (const int p : grid_.within(room()))
      if (is_content(grid_.polygons()[at(p)])) place(p);
    take_outwards();
    take_inwards();
    out_.level_m = visible_level(parallel_, ring_.area_m2);
    std::ranges::sort(out_.polygons);
    return std::move(out_);
  }

 private:
  struct Layer {
    double near = Box::kInfinity, far = -Box::kInfinity;  ///< along the normal from the facet
    int polygon = -1;
  };

  [[nodiscard]] Box room() const {
    Box box;
    for (const Vec3 p : ring_.outline) {
      box.grow(p + kDeepest_m * plane_.normal);
      box.grow(p - kDeepest_m * plane_.normal);
    }
    box.grow(box.min - Vec3{kLean_m, kLean_m, kLean_m});
    box.grow(box.max + Vec3{kLean_m, kLean_m, kLean_m});
    return box;
  }

  [[nodiscard]] bool is_content(const PlacedPolygon& polygon) const {
    return !is_own(polygon.source) && is_within(polygon);
  }

  /// What the ring is cut into; a frame belongs to its opening.
  [[nodiscard]] bool is_own(int source) const {
    if (ring_.source < 0) return std::ranges::binary_search(facet_.polygons, source);
    return ring_.kind != Ring::Kind::frame && source == ring_.source;
  }

  /// By rectangle and, where the outline is no rectangle, by every corner.
  [[nodiscard]] bool is_within(const PlacedPolygon& polygon) const {
    if (!reach_.holds(axes_.reach_of(polygon.outline()), kLean_m)) return false;
    if (is_rectangle_) return true;
    const Outline& outline = ring_.outline;
    const double level = dot(outline[0], plane_.normal);
    return std::ranges::all_of(polygon.outline(), [&](Vec3 p) {
      const Vec3 q = p + (level - dot(p, plane_.normal)) * plane_.normal;
      if (contains({&outline, 1}, plane_.normal, q)) return true;
      for (std::size_t i = 0; i < outline.size(); ++i)
        if (distance_to_segment(q, outline[i], outline[(i + 1) % outline.size()]) <= kLean_m)
          return true;
      return false;
    });
  }

  void place(int p) {
    Layer layer;
    layer.polygon = p;
    for (const Vec3 q : grid_.polygons()[at(p)].outline()) {
      layer.near = std::min(layer.near, dot(q, plane_.normal) - plane_.offset_m);
      layer.far = std::max(layer.far, dot(q, plane_.normal) - plane_.offset_m);
    }
    const bool is_behind = layer.far < 0 || (layer.near < 0 && layer.far <= -layer.near);
    (is_behind ? behind_ : before_).push_back(layer);
  }

  void take_outwards() {
    std::ranges::stable_sort(before_, {}, &Layer::near);
    double reached = kGap_m;
    for (const Layer& layer : before_) {
      if (layer.near > reached) return;
      reached = std::max(reached, layer.far + kGap_m);
      take(layer);
    }
  }

  void take_inwards() {
    std::ranges::stable_sort(behind_, {}, [](const Layer& layer) { return -layer.far; });
    double reached = -kGap_m;
    for (const Layer& layer : behind_) {
      if (layer.far < reached) return;
      reached = std::min(reached, layer.near - kGap_m);
      take(layer);
    }
  }

  void take(const Layer& layer) {
    const PlacedPolygon& polygon = grid_.polygons()[at(layer.polygon)];
    out_.polygons.push_back(layer.polygon);
    const double across_m2 = std::abs(dot(polygon.area, plane_.normal));
    if (across_m2 < kParallel * length(polygon.area)) return;
    out_.parallel_m2 += across_m2;
    parallel_.push_back({(layer.near + layer.far) / 2, across_m2});
  }

  const Ring& ring_;
  const Facet& facet_;
  const Plane& plane_;
  const PolygonGrid& grid_;
  ReachAxes axes_;
  Reach reach_;
  bool is_rectangle_;
  std::vector<Layer> before_, behind_;
  std::vector<ParallelArea> parallel_;
  RingContent out_;
};

}  // namespace

RingContent content_of(const Ring& ring, const Solid& solid, const PolygonGrid& grid) {
  return ContentFinder(ring, solid, grid).run();
}

}  // namespace oriel::detail
