#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/model/solid.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// A half-space: what lies behind a plane.
struct HalfSpaceM {
  Vec3 normal;
  double offset_m = 0;
};

/// The area of the part of a facet that lies behind all `limits`; the facet may have any shape.
double area_within(std::span<const Vertex> vertices, const Facet& facet, Vec3 normal,
                   const std::vector<HalfSpaceM>& limits);

}  // namespace oriel::detail
