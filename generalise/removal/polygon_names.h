#pragma once

#include "kernel/geometry/outlines.h"
#include "model/cell_complex.h"
#include "model/segmentation.h"
#include "model/solid.h"

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
  std::map<std::array<std::int64_t, 3>, std::vector<FacetId>> facets_along_;  ///< by direction
};

/// Keeps the input polygons that faces of a complex lie in, each looked for once. Refers to all
/// that it is made of.
class FaceNames {
 public:
  FaceNames(const CellComplex& complex, const PolygonsAround& around,
            const Segmentation& segmentation)
      : complex_(complex), around_(around), segmentation_(segmentation) {}

  const std::vector<int>& of(FaceId id);

 private:
  const CellComplex& complex_;
  const PolygonsAround& around_;
  const Segmentation& segmentation_;
  std::map<FaceId, std::vector<int>> known_;
};

}  // namespace oriel::detail
