#include "kernel/segment/rings/feature_index.h"

#include "kernel/base/indexed_vector.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// The caps of a feature fill this part of a ring's rectangle: it is the ring's. As for the boxes
/// of objects in bench/recall.sh.
constexpr double kSameRing = 0.8;
/// Normals of planes that look away from each other are as far apart as rounding makes them.
constexpr double kOpposite = 1 - 1e-9;  // tolerance of doubles

/// Of the outline that ring_of() makes of the loop.
Reach reach_of_ring(const Solid& solid, const Facet& facet, const Loop& loop,
                    const ReachAxes& axes) {
  const Plane& plane = solid.planes[facet.plane.index()];
  Reach reach;
  for (const int v : loop) axes.grow(reach, laid_on(plane, solid.vertices[at(v)].point));
  return reach;
}

}  // namespace

FeatureIndex::FeatureIndex(const Segmentation& segmentation, const Tolerances& tolerances,
                           Work& work)
    : segmentation_(segmentation),
      tolerances_(tolerances),
      work_(work),
      planes_(segmentation.planes.size()) {
  for (const FeatureId i : ids_below<FeatureId>(segmentation.features.size()))
    for (const PlaneId plane : segmentation.features[i.index()].planes)
      planes_[plane.index()].features.push_back(i);
}

const std::vector<FeatureIndex::PlacedCap>& FeatureIndex::on(PlaneId plane) {
  OfPlane& here = planes_[plane.index()];
  if (!here.is_known) {
    here.is_known = true;
    here.caps.reserve(here.features.size());
    for (const FeatureId id : here.features) here.caps.push_back({id, cap_of(id, plane)});
    std::ranges::stable_sort(here.caps, {}, [](const PlacedCap& r) { return r.cap.u0; });
  }
  return here.caps;
}

Reach FeatureIndex::cap_of(FeatureId id, PlaneId number) const {
  const Plane& plane = segmentation_.planes[number.index()];
  const ReachAxes axes = axes_in(plane.normal);
  Reach cap;
  work_.add(std::ssize(segmentation_.features[id.index()].vertices));
  for (const int v : segmentation_.features[id.index()].vertices) {
    const Vec3 p = segmentation_.vertices[at(v)].point;
    if (std::abs(dot(plane.normal, p) - plane.offset_m) <= tolerances_.plane_offset_m)
      axes.grow(cap, p);
  }
  return cap;
}

template <class Test>
bool FeatureIndex::any_within(PlaneId plane, const Reach& reach, Test test) {
  const std::vector<PlacedCap>& caps = on(plane);
  const double slack = tolerances_.weld_m + tolerances_.plane_offset_m;
  auto r = std::ranges::lower_bound(caps, reach.u0 - slack, {},
                                    [](const PlacedCap& resident) { return resident.cap.u0; });
  for (; r != caps.end() && r->cap.u0 <= reach.u1; ++r) {
    work_.add(1);
    if (reach.holds(r->cap, slack) && test(*r)) return true;
  }
  return false;
}

std::vector<FeatureId> FeatureIndex::within(PlaneId plane, const Reach& reach) {
  std::vector<FeatureId> found;
  any_within(plane, reach, [&](const PlacedCap& r) {
    found.push_back(r.id);
    return false;
  });
  return found;
}

bool FeatureIndex::fills(PlaneId plane, const Reach& reach) {
  if (work_.is_used_up()) return true;
  const double least_m2 = kSameRing * reach.area();
  if (any_within(plane, reach, [&](const PlacedCap& r) { return r.cap.area() >= least_m2; }))
    return true;
  work_.add(std::ssize(segmentation_.features));
  return std::ranges::any_of(segmentation_.features, [&](const Feature& feature) {
    return is_cut_off_there(feature, segmentation_.planes[plane.index()], reach);
  });
}

/// The cut of a part looks the other way than the plane does, and lies in the rectangle.
bool FeatureIndex::is_cut_off_there(const Feature& feature, const Plane& plane,
                                    const Reach& reach) const {
  if (feature.sense != Sense::protrusion || feature.planes.size() != 1) return false;
  const Plane& cut = segmentation_.planes[feature.planes[0].index()];
  if (dot(cut.normal, plane.normal) > -kOpposite ||
      std::abs(cut.offset_m + plane.offset_m) > tolerances_.plane_offset_m)
    return false;
  Reach point;
  axes_in(plane.normal).grow(point, feature.cap_point);
  return reach.holds(point, 0);
}

bool are_all_rings_filled(const Solid& solid, FeatureIndex& caps, const Tolerances& tolerances) {
  for (const FacetId f : ids_below<FacetId>(solid.facets.size())) {
    const Facet& facet = solid.facets[f.index()];
    if (facet.loops.size() == 1) continue;
    const ReachAxes axes = axes_in(solid.planes[facet.plane.index()].normal);
    for (std::size_t l = 1; l < facet.loops.size(); ++l)
      if (!caps.fills(facet.plane, reach_of_ring(solid, facet, facet.loops[l], axes)) &&
          !is_slit(ring_of(solid, f, facet.loops[l]), tolerances))
        return false;
  }
  return true;
}

}  // namespace oriel::detail
