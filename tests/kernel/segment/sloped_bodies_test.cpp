#include "kernel/segment/remove.h"
#include "tests/kernel/segment/invariants.h"
#include "tests/support/convex_body.h"

#include <random>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::segmented;
using test::Segmented;

/// A gabled house with up to four pieces added or taken away: boxes, and boxes under a roof of
/// their own, so that slopes meet slopes.
Building sloped_body(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](int n) {
    return static_cast<double>(random() % static_cast<std::uint64_t>(n));
  };
  test::ConvexBody body;
  body.add({{{-1, 0, 0}, 0},
            {{1, 0, 0}, 12},
            {{0, -1, 0}, 0},
            {{0, 1, 0}, 8},
            {{0, 0, -1}, 0},
            {{0, -3, 4}, 24},
            {{0, 3, 4}, 48}});
  for (int i = 1 + static_cast<int>(below(4)); i > 0; --i) {
    const Vec3 min{below(24) / 2, below(20) / 2 - 1, below(18) / 2};
    const Vec3 max = min + Vec3{0.5 + below(6) / 2, 0.5 + below(6) / 2, 0.5 + below(8) / 2};
    auto piece = test::box(min, max);
    if (below(2) == 0) {
      // A ridge in the middle of the piece, its slopes down from the top.
      const double middle = (min.y + max.y) / 2;
      piece.push_back({{0, -1, 1}, max.z - middle});
      piece.push_back({{0, 1, 1}, max.z + middle});
    }
    if (below(3) != 0)
      body.add(piece);
    else
      body.remove(piece);
  }
  return body.build("sloped-" + std::to_string(seed));
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("random sloped bodies are the sum of their cells and lose features by the book") {
    std::size_t features = 0, refused = 0, solids = 0;
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
      CAPTURE(seed);
      const Building building = sloped_body(seed);
      if (!solidify(building, {}).value) continue;
      ++solids;
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(to_string(order));
        const Segmented s = segmented(building, order);
        test::check_segmentation(s, {1e-9, 1e-5, 60});
        test::check_balanced(s.segmentation);
        if (order == Order::paper) continue;
        features += s.segmentation.features.size();
        std::vector<std::vector<FeatureId>> sets{test::all_features(s.segmentation)};
        for (const FeatureId id : test::all_features(s.segmentation)) sets.push_back({id});
        for (const auto& set : sets) {
          const Remainder rest = remove_features(s.solid, s.segmentation, set);
          if (!rest.solid.facets.empty()) CHECK(is_closed(rest.solid));
          CHECK(std::abs(volume_m3(rest.solid) - test::volume_without(s, rest.removed)) < 1e-3);
          refused += rest.refused.size();
        }
      }
    }
    CHECK(solids > 70);
    CHECK(features > 150);
    CHECK(refused < features);
  }
}

}  // namespace
}  // namespace oriel
