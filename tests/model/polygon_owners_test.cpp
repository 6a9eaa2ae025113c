#include "model/polygon_owners.h"

#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

Feature feature_with(double volume_m3, std::vector<int> polygons) {
  Feature feature;
  feature.node = NodeId{0};
  feature.volume_m3 = volume_m3;
  feature.source_polygons = std::move(polygons);
  return feature;
}

std::vector<int> owners_at(const PolygonOwners& owners, std::size_t polygon) {
  const auto features = owners[polygon];
  return {features.begin(), features.end()};
}

TEST_SUITE("model") {
  TEST_CASE("the smallest feature that lists a polygon owns it first") {
    Segmentation segmentation;
    segmentation.features = {feature_with(2, {0, 3}), feature_with(1, {3})};
    Building building;
    for (const int source : {3, 0, 4}) building.polygons.emplace_back().source = source;
    const PolygonOwners owners = polygon_owners(segmentation, building);
    REQUIRE(owners.polygons() == 5);
    CHECK(owners_at(owners, 0) == std::vector<int>{0});
    CHECK(owners_at(owners, 3) == std::vector<int>{1, 0});
    CHECK(owners_at(owners, 4).empty());
    CHECK(polygon_owners({}, Building{}).polygons() == 0);
  }

  TEST_CASE("a feature with a polygon that the building does not have is a fault") {
    Segmentation segmentation;
    segmentation.features = {feature_with(1, {1})};
    Building building;
    building.polygons.emplace_back().source = 0;
    CHECK_THROWS_AS((void)polygon_owners(segmentation, building), std::logic_error);
  }
}

}  // namespace
}  // namespace oriel
