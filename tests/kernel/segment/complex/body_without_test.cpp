#include "kernel/segment/complex/body_without.h"

#include "kernel/segment/complex/cell_complex.h"
#include "tests/kernel/segment/complex_checks.h"
#include "tests/support/changed.h"
#include "tests/support/houses.h"
#include "tests/support/near.h"
#include "tests/support/segmented.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::nearly;
using test::segmented;
using test::Segmented;

constexpr std::array kBody{CellId{0}};

/// What is left without the leaves of a feature.
CellComplex left_of(const Segmented& s, FeatureId feature) {
  Work work;
  return body_without(s.solid, s.segmentation, vertices_of(s.segmentation, {}),
                      cells_of(s.segmentation, feature), work)
      .value();
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("a body without the leaves of a feature has its volume less and closes") {
    std::size_t compared = 0;
    for (const auto& [name, make] : test::bodies())
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(std::string(name));
        const Segmented s = segmented(make(), order);
        for (const FeatureId id : test::all_features(s.segmentation)) {
          const Feature& feature = s.segmentation.features[id.index()];
          if (!feature.node.is_valid()) continue;
          const CellComplex left = left_of(s, id);
          CHECK(left.open_edge_count() == 0);
          CHECK(test::volume_m3(s.segmentation, left, kBody) ==
                nearly(test::volume_without(s, {id})));
          ++compared;
        }
      }
    CHECK(compared > 50);
  }

  TEST_CASE("facets of a body that leaves do not touch keep their corners") {
    const Segmented s = segmented(test::BoxBody()
                                      .add({0, 0, 0}, {10, 8, 6})
                                      .add({2, 2, 6}, {3, 3, 7})
                                      .add({7, 5, 6}, {8, 6, 8})
                                      .build());
    const FeatureId low = test::feature_in(s.segmentation, {2, 2, 6}, {3, 3, 7});
    const CellComplex left = left_of(s, low);
    std::set<std::vector<int>> before, after;  // corners of facets
    const auto corners = [](const std::vector<Loop>& loops) {
      std::vector<int> all;
      for (const Loop& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
      std::ranges::sort(all);
      return all;
    };
    for (const Facet& facet : s.solid.facets) before.insert(corners(facet.loops));
    for (const Face& face : left.faces()) after.insert(corners(face.loops));
    std::vector<std::vector<int>> kept;
    std::ranges::set_intersection(before, after, std::back_inserter(kept));
    CHECK(before.size() == 16);
    CHECK(after.size() == 11);
    CHECK(kept.size() == 10);  // all but the roof, which closes over the block
  }

  TEST_CASE(
      "where vertices lie off their planes a body without leaves closes as a complex does not") {
    int open = 0, closed = 0, compared = 0;
    for (const auto make : {test::ridge_chimney, test::dormer_with_window, test::chimney_with_head})
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const Segmented s = segmented(test::with_noise(make(), 0.002, seed));
        open += cell_complex(s.segmentation).open_edge_count() == 0 ? 0 : 1;
        for (const FeatureId id : test::all_features(s.segmentation)) {
          if (!s.segmentation.features[id.index()].node.is_valid()) continue;
          const CellComplex left = left_of(s, id);
          closed += left.open_edge_count() == 0 ? 1 : 0;
          ++compared;
        }
      }
    CHECK(open == 12);
    CHECK(compared > 60);
    CHECK(closed >= compared * 95 / 100);  // a chord may pass a vertex by a hair
  }
}

}  // namespace
}  // namespace oriel
