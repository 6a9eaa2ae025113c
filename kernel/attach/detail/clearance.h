#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/model/solid.h"

#include <span>
#include <utility>
#include <vector>

namespace oriel::detail {

/// A half-space: what lies behind a plane.
struct HalfSpaceM {
  Vec3 normal;
  double offset_m = 0;
};

/// Parts of facets smaller than this are not met but touched.
inline constexpr double kTouch_m2 = 1e-9;

/// The area of the part of a facet that lies behind all `limits`.
double area_within(std::span<const Vertex> vertices, const Facet& facet, Vec3 normal,
                   const std::vector<HalfSpaceM>& limits);

/// How near two segments come to each other.
double distance(std::pair<Vec3, Vec3> p, std::pair<Vec3, Vec3> q);

}  // namespace oriel::detail
