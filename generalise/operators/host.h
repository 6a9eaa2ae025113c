#pragma once

#include "kernel/attach/attach.h"
#include "kernel/model/segmentation.h"
#include "kernel/model/solid.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace oriel::detail {

/// A wall or a roof that features are put back on, with its axes: u horizontal along it, v up in
/// it, n out of it. Of a facet that lies flat u is along a wall.
struct Host {
  FacetId facet;
  Plane plane;
  Vec3 u, v, n;
};

/// The facet of `plane` that has the point in it, or nothing.
std::optional<Host> host_at(const Solid& solid, const Plane& plane, Vec3 point);

/// The extents of some points along the axes of a host; `out` counts from its plane.
struct Extents {
  double u0, u1, v0, v1, out0, out1;

  [[nodiscard]] double width() const { return u1 - u0; }
  [[nodiscard]] double height() const { return v1 - v0; }
  /// How far it reaches from the plane to either side.
  [[nodiscard]] double depth() const { return std::max(out1, -out0); }
};
Extents extents_of(const Host& host, const Segmentation& segmentation, const Feature& feature);

/// What an operator made: the solid, with the facets that are new and the feature each belongs to;
/// or the reason why not.
struct Placed {
  std::optional<Solid> solid;
  std::string reason;
};

/// A recess or a block with the outline u0…u1 × v0…v1 on a host and the given depth; its facets get
/// `polygons`. Its sides are horizontal and vertical if the host is a wall. A recess whose lower
/// edge lies on the ground under the wall is open there.
Placed place_box(const Solid& solid, const Host& host, Extents where, double depth_m, Attach kind,
                 double clear_m, const std::vector<int>& polygons);

/// Attaches a body and gives its facets `polygons`.
Placed place(const Solid& solid, const std::vector<FacetId>& contacts,
             const std::vector<Plane>& planes, Attach kind, double clear_m,
             const std::vector<int>& polygons);

/// A feature is a box on its host if its volume is no less than this share of width × height ×
/// depth: reveals may lean a little.
inline constexpr double kBoxShare = 0.95;
bool is_box(const Feature& feature, const Extents& extents);

/// The directions of what is added are those of planes nearer than this.
inline constexpr double kSameDirection_deg = 0.5;

}  // namespace oriel::detail
