#include "kernel/literal/arrangement.h"

#include "tests/support/houses.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <map>
#include <set>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using doctest::Approx;
using literal::arrange;
using literal::PlaneArrangement;

PlaneArrangement arranged(const Solid& solid) {
  Work work;
  auto arrangement = arrange(solid, work);
  REQUIRE(arrangement);
  return std::move(*arrangement);
}

double volume_of(const PlaneArrangement& arrangement) {
  double sum = 0;
  for (const literal::SpaceRegion& region : arrangement.regions) sum += region.volume_m3;
  return sum;
}

TEST_SUITE("kernel/literal") {
  TEST_CASE("the planes of a box make 27 regions and only the box has an end") {
    const Solid solid = test::solid_of(test::BoxBody().add({0, 0, 0}, {3, 2, 1}).build());
    const PlaneArrangement a = arranged(solid);
    CHECK(a.planes.size() == 6);
    CHECK(a.regions.size() == 27);
    // 2 partitions a plane and axis: between the 3 × 3 columns of each axis.
    CHECK(a.partitions.size() == 54);
    const auto has_end = [](const literal::SpaceRegion& r) { return !r.is_endless; };
    REQUIRE(std::ranges::count_if(a.regions, has_end) == 1);
    CHECK(std::ranges::find_if(a.regions, has_end)->volume_m3 == Approx(6).epsilon(1e-9));
    // A box seven times as long on every side.
    CHECK(volume_of(a) == Approx(21.0 * 20 * 19).epsilon(1e-6));
  }

  TEST_CASE("regions fill the space and touch across one plane each") {
    for (const Building& building :
         {test::full_house(), test::cross_gable(), test::ridge_chimney(), test::three_notches()}) {
      const Solid solid = test::solid_of(building);
      const PlaneArrangement a = arranged(solid);
      const Box box = box_of(solid);
      const Vec3 size = box.max - box.min;
      const double margin = 6 * std::max({size.x, size.y, size.z});
      CHECK(volume_of(a) ==
            Approx((size.x + margin) * (size.y + margin) * (size.z + margin)).epsilon(1e-6));
      std::set<std::vector<std::uint64_t>> signs;
      for (const literal::SpaceRegion& region : a.regions) {
        CHECK(region.volume_m3 > 0);
        CHECK(signs.insert(region.front.words()).second);
        for (int p = 0; p < std::ssize(a.planes); ++p) {
          const Plane& plane = a.planes[static_cast<std::size_t>(p)];
          CHECK((dot(plane.normal, region.inside) > plane.offset_m) == region.front.has(p));
        }
      }
      for (const literal::Partition& partition : a.partitions) {
        literal::Bits behind = a.regions[static_cast<std::size_t>(partition.behind)].front;
        behind.add(partition.plane);
        CHECK(behind == a.regions[static_cast<std::size_t>(partition.before)].front);
        CHECK(partition.area_m2 > 0);
      }
      // Around an edge of m planes there are 2m regions, which the m planes tell apart.
      for (const literal::RegionsAtEdge& around : a.edges) {
        CHECK(around.size() >= 4);
        CHECK(around.size() % 2 == 0);
      }
    }
  }

  TEST_CASE("planes that are turned round are one plane") {
    // Both blocks have a side at x = 1, and they look at each other.
    const Solid solid = test::solid_of(test::BoxBody()
                                           .add({0, 0, 0}, {2, 1, 1})
                                           .add({0, 0, 1}, {1, 1, 2})
                                           .add({0, 0, 2}, {2, 1, 3})
                                           .add({1, 0, 3}, {2, 1, 4})
                                           .build());
    CHECK(solid.planes.size() == 11);
    CHECK(arranged(solid).planes.size() == 10);
  }

  TEST_CASE("an arrangement ends where its budget does") {
    const Solid solid = test::solid_of(test::three_notches());
    Work work(1000);
    CHECK_FALSE(arrange(solid, work));
    CHECK(work.is_used_up());
  }
}

}  // namespace
}  // namespace oriel
