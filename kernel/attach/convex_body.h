#pragma once

#include "kernel/geometry/exact.h"
#include "kernel/model/solid.h"

#include <array>
#include <optional>
#include <vector>

namespace oriel::detail {

/// The boundary of a bounded convex body.
struct ConvexBody {
  struct Corner {
    exact::Rational point;
    std::array<int, 3> planes{};  ///< ascending
  };
  std::vector<Corner> corners;
  /// For each plane its facet, counter-clockwise seen from outside; empty if the plane does not
  /// touch the body.
  std::vector<Loop> loops;
};

/// What lies behind all planes. Nothing if that is empty or not bounded, or if four planes meet in
/// one of its corners. Exact; takes time n⁴ in the number of planes, which are few.
std::optional<ConvexBody> convex_body(const std::vector<Plane>& planes);

}  // namespace oriel::detail
