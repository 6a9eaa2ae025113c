#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/model/solid.h"

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace oriel::detail {

/// Finds again which input polygons a figure lies in. Refers to the solid, which must outlive it.
class PolygonsAround {
 public:
  /// Points up to `weld_m` off a plane are in it, as vertices may be.
  PolygonsAround(const Solid& solid, double weld_m);

  /// The input polygons of the facets of the solid that a figure in a plane lies in, whichever way
  /// they look; none if it is new. The plane is exact: those of a segmentation are its solid's.
  [[nodiscard]] std::set<int> of(const std::vector<Outline>& shape, const Plane& plane) const;

 private:
  const Solid& solid_;
  double weld_m_;
  std::map<std::array<std::int64_t, 3>, std::vector<int>> facets_along_;  ///< by direction
};

}  // namespace oriel::detail
