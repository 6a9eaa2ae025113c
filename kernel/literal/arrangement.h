#pragma once

#include "kernel/base/work.h"
#include "kernel/literal/bits.h"
#include "model/solid.h"
#include "model/vec3.h"

#include <optional>
#include <vector>

namespace oriel::literal {

/// A convex piece of space that no plane of the arrangement cuts.
struct SpaceRegion {
  /// By plane of the arrangement: it lies in front.
  Bits front;
  /// It reaches the border of the arrangement, and counts as without end.
  bool is_endless = false;
  double volume_m3 = 0;
  /// A point inside, in no regular place: not above an edge of a symmetric body, say.
  Vec3 inside;
};

/// What two regions share: a convex piece of a plane, the first region behind it.
struct Partition {
  int behind = -1;
  int before = -1;
  int plane = -1;
  double area_m2 = 0;
};

/// The regions around an edge where two or more planes meet.
using RegionsAtEdge = std::vector<int>;

/// All planes of a solid, without orientation, and the regions into which they divide the space
/// around it: a box that is larger than the solid by three times its longest side on every side.
/// Any body whose facets lie in these planes is a set of regions, so cutting it needs no geometry.
///
/// Exact: vertices are rational points, and on which side of a plane one lies is decided by
/// integers. Only areas and volumes are doubles.
struct PlaneArrangement {
  /// Each geometric plane once, in the orientation of the first facet in it.
  std::vector<Plane> planes;
  std::vector<SpaceRegion> regions;
  std::vector<Partition> partitions;
  /// Of edges within the box.
  std::vector<RegionsAtEdge> edges;
};

/// The arrangement of the planes that the solid's facets lie in. Nothing if `work` is used up: a
/// step is a look at a corner of a region.
std::optional<PlaneArrangement> arrange(const Solid& solid, Work& work);

}  // namespace oriel::literal
