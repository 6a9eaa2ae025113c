#include "kernel/describe/features/facades.h"

#include "model/tolerances.h"

#include <doctest/doctest.h>

namespace oriel::detail {
namespace {

/// Adds an upright rectangle that looks to the south.
void add_wall(Segmentation& segmentation, double y, double west, double east, double low,
              double high) {
  Plane plane;
  plane.normal = {0, -1, 0};
  plane.offset_m = -y;
  Facet facet{PlaneId{static_cast<int>(segmentation.planes.size())}, {{}}, {}};
  segmentation.planes.push_back(plane);
  for (const Vec3 corner :
       {Vec3{west, y, low}, Vec3{east, y, low}, Vec3{east, y, high}, Vec3{west, y, high}}) {
    facet.loops[0].push_back(static_cast<int>(segmentation.vertices.size()));
    segmentation.vertices.push_back({corner, false});
  }
  segmentation.cells[0].facets.push_back(facet);
}

/// Whether what stands on a front of 1 x 2 m has the wall of 6 x 6 m behind it as its facade.
bool is_on_wall(double gap_m, double wall_low_m, double wall_west_m = -3) {
  Segmentation segmentation;
  segmentation.cells.resize(1);
  add_wall(segmentation, -gap_m, 0, 1, 0, 2);
  add_wall(segmentation, 0, wall_west_m, wall_west_m + 6, wall_low_m, wall_low_m + 6);
  Work work;
  Facades facades(segmentation, work);
  Feature feature;
  feature.host_facet = CellFacet{CellId{0}, 0};
  return facades.of(feature).value().facet == 1;
}

}  // namespace

TEST_SUITE("kernel/describe") {
  TEST_CASE("the facade of a front is the wall close behind it that it reaches") {
    CHECK(is_on_wall(kFacadeDepth_m, 0));
    CHECK_FALSE(is_on_wall(2 * kFacadeDepth_m, 0));
    CHECK_FALSE(is_on_wall(-kFacadeDepth_m, 0));
    // The wall may begin as far above the front as a facade is deep.
    CHECK(is_on_wall(kFacadeDepth_m, 2 + kFacadeDepth_m));
    CHECK_FALSE(is_on_wall(kFacadeDepth_m, 2 + 2 * kFacadeDepth_m));
    CHECK(is_on_wall(kFacadeDepth_m, -6 - kFacadeDepth_m / 2));
    CHECK_FALSE(is_on_wall(kFacadeDepth_m, -6 - 2 * kFacadeDepth_m));
    // To the side it may stand out by no more.
    CHECK(is_on_wall(kFacadeDepth_m, 0, kFacadeDepth_m / 2));
    CHECK_FALSE(is_on_wall(kFacadeDepth_m, 0, 2 * kFacadeDepth_m));
  }

  TEST_CASE("a feature without cap has no facade") {
    Segmentation segmentation;
    Work work;
    CHECK_FALSE(Facades(segmentation, work).of(Feature{}).has_value());
  }
}

}  // namespace oriel::detail
