#include "kernel/segment/remove.h"
#include "tests/kernel/segment/invariants.h"
#include "tests/support/changed.h"
#include "tests/support/shapes.h"

#include <random>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::segmented;
using test::Segmented;

/// Bodies that touch themselves along an edge whose ends hang together otherwise are refused: the
/// half-edge mesh has no two edges between the same two vertices.
bool is_solid(const Building& building) {
  const auto solid = solidify(building, {});
  if (!solid.value) CHECK(solid.issues.at(0).code == Code::E303);
  return solid.value.has_value();
}

/// A block with up to eight boxes added or taken away at random, on a grid so coarse that planes
/// and edges coincide all the time.
Building random_body(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](int n) {
    return static_cast<int>(random() % static_cast<std::uint64_t>(n));
  };
  test::BoxBody body;
  body.add({0, 0, 0}, {8, 8, 8});
  for (int i = 1 + below(8); i > 0; --i) {
    int from[3], to[3];
    for (int a = 0; a < 3; ++a) {
      from[a] = below(11) - 2;
      to[a] = from[a] + 1 + below(4);
    }
    const Vec3 min{static_cast<double>(from[0]), static_cast<double>(from[1]),
                   static_cast<double>(from[2])};
    const Vec3 max{static_cast<double>(to[0]), static_cast<double>(to[1]),
                   static_cast<double>(to[2])};
    if (below(2) == 0)
      body.add(min, max);
    else
      body.remove(min, max);
  }
  return body.build("random-" + std::to_string(seed));
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("random bodies of boxes are the sum of their cells in both orders") {
    std::size_t features = 0, bodies = 0, merges = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed)
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(seed);
        CAPTURE(to_string(order));
        if (!is_solid(random_body(seed))) continue;
        ++bodies;
        const Segmented s = segmented(random_body(seed), order);
        test::check_segmentation(s, {1e-9, 1e-6, 60});
        features += s.segmentation.features.size();
        merges += test::check_balanced(s.segmentation);
      }
    CHECK(features > 1000);
    CHECK(merges > 10);
    CHECK(bodies > 2 * 300 * 9 / 10);
  }

  TEST_CASE("features come off random bodies and the books are kept") {
    std::size_t asked = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      CAPTURE(seed);
      if (!is_solid(random_body(seed))) continue;
      const Segmented s = segmented(random_body(seed));
      const auto all = test::all_features(s.segmentation);
      std::vector<std::vector<FeatureId>> sets{all};
      for (const FeatureId id : all) sets.push_back({id});
      for (const auto& set : sets) {
        CAPTURE(set.size() == 1 ? set[0].value : -1);
        const Remainder rest = remove_features(s.solid, s.segmentation, set);
        if (!rest.solid.facets.empty()) CHECK(is_closed(rest.solid));
        CHECK(std::abs(volume_m3(rest.solid) - test::volume_without(s, rest.removed)) < 1e-6);
        asked += set.size();
        refused += rest.refused.size();
      }
    }
    CHECK(asked > 500);
    CHECK(refused * 3 < asked);
  }
}

}  // namespace
}  // namespace oriel
