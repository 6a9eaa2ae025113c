#pragma once

#include "kernel/base/work.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/flush/polygon_grid.h"
#include "model/building.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <vector>

namespace oriel::detail {

/// What lies in an opening may lean, and frames overlap its ring, by this much.
inline constexpr double kLean_m = 0.02;
/// Sizes that differ by no more than about this share may be those of one thing.
inline constexpr double kAlike = 0.05;
/// An outline that fills this part of its rectangle is one.
inline constexpr double kRectangle = 0.999;

/// An outline in a facet that something may lie in, before or behind.
struct Ring {
  FacetId facet;
  Outline outline;  ///< in the facet's plane, counter-clockwise seen from outside
  double area_m2 = 0;
  enum class Kind {
    inner,  ///< an inner ring of the facet, or of an input polygon in it
    notch,  ///< a part of its outer ring that turns inward around three sides
    frame   ///< the outer ring of a frame, or of two that stand side by side
  } kind = Kind::inner;
  int source = -1;  ///< the input polygon it is a ring of, -1 if of the facet
};

/// A point moved onto a plane.
inline Vec3 laid_on(const Plane& plane, Vec3 p) {
  return p + (plane.offset_m - dot(p, plane.normal)) * plane.normal;
}

/// The ring that a loop of a facet is, whether a hole or its outer one.
Ring ring_of(const Solid& solid, FacetId facet, const Loop& loop);

/// So thin that it is no ring.
bool is_slit(const Ring& ring, const Tolerances& tolerances);

class FeatureIndex;

/// The rings of a solid's facets that no feature fills; of an open shell (no Solid::shells) also
/// those of the input polygons, narrow frames and notches. The largest first, then by place; slits
/// are none, and no ring counts twice, nor if one that is filled is like it. `grid` has the
/// polygons of the building that `solid` is of. Once `work` is used up no more are looked for.
std::vector<Ring> find_rings(const Solid& solid, const PolygonGrid& grid, FeatureIndex& features,
                             const Tolerances& tolerances, Work& work);

}  // namespace oriel::detail
