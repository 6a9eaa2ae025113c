#include "kernel/segment/cuts/ring_cut.h"

#include "kernel/segment/cuts/feature_cut.h"
#include "tests/support/houses.h"
#include "tests/support/segmented.h"

#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::Segmented;

/// A body that is asked for the cuts of its features.
struct CutBody {
  explicit CutBody(const Segmented& from)
      : s(from),
        world{detail::PlaneTable(s.solid.planes), detail::PointTable(s.solid, world.planes)},
        body(boundary_of(s.solid, 0, world)),
        rings(body) {}

  /// Calls visit(feature, by_ring, by_section) with the caps of each feature of one plane, as the
  /// body is by then.
  template <class Visit>
  void for_each_cut(Visit visit) {
    for (const Feature& f : s.segmentation.features) {
      const bool is_material = f.sense == Sense::protrusion;
      if (f.planes.size() != 1 || (!is_material && f.sense != Sense::hole)) continue;
      const auto side = world.planes.find(s.segmentation.planes[f.planes[0].index()]);
      if (!side) continue;
      const int direction = ((*side & 1) == 0) == is_material ? 1 : -1;
      const auto by_ring =
          rings.find(body, *side >> 1, direction, is_material, f.cap_point, facets_of(f));
      auto cut = find_feature_cut(body, *side >> 1, direction, is_material, f.cap_point,
                                  {-1, 0.001, false, true});
      visit(f, by_ring, cut ? cut->caps : std::nullopt);
    }
  }

  [[nodiscard]] std::vector<FacetId> facets_of(const Feature& f) const {
    std::vector<FacetId> facets;
    for (int i = 0; i < std::ssize(s.solid.facets); ++i)
      for (const int polygon : s.solid.facets[static_cast<std::size_t>(i)].polygons)
        if (std::ranges::binary_search(f.source_polygons, polygon)) facets.push_back(FacetId{i});
    return facets;
  }

  const Segmented& s;
  detail::World world;
  detail::Boundary body;
  detail::RingCuts rings;
};

std::vector<EdgeId> rim_of(const detail::CutCap& cap) {
  std::vector<EdgeId> rim;
  for (const detail::CapLoop& loop : cap.loops)
    for (const detail::CapEdge& edge : loop.edges) rim.push_back(edge.rim);
  return rim;
}

/// How many cuts are found by rings while features come off one after the other.
int count_rings(const Segmented& s) {
  int count = 0;
  CutBody cuts(s);
  cuts.for_each_cut([&](const Feature& f, const auto& by_ring, const auto& by_section) {
    if (by_ring) {
      REQUIRE(by_section);
      REQUIRE(by_ring->size() == 1);
      REQUIRE(by_section->size() == 1);
      CHECK(by_ring->front().side == by_section->front().side);
      CHECK(rim_of(by_ring->front()) == rim_of(by_section->front()));
      ++count;
    }
    if (by_section) CHECK(take_off(cuts.body, *by_section, f.sense == Sense::hole, {}, {}));
  });
  return count;
}

/// A wall with a pocket, and a beam before it, fastened beside the pocket, whose end hangs in the
/// air of the pocket.
Building pocket_with_a_hook() {
  return test::BoxBody()
      .add({0, 0, 0}, {12, 6, 8})
      .remove({4, 0, 3}, {8, 2, 6})
      .add({9, -2, 4}, {10, 0, 5})
      .add({5, -2, 4}, {9, -1, 5})
      .add({5, -1, 4}, {6, 1, 5})
      .build();
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("the ring around a feature tells the cut that a section finds") {
    int count = 0;
    for (const auto& [name, make] : test::bodies()) {
      CAPTURE(std::string(name));
      count += count_rings(test::segmented(make()));
    }
    CHECK(count > 15);
    CHECK(count_rings(test::segmented(test::six_pockets())) == 6);
    CHECK(count_rings(test::segmented(test::two_boxes_on_a_slab())) == 2);
  }

  TEST_CASE("a ring with a part of the body hanging inside is left to a section") {
    const Segmented s = test::segmented(pocket_with_a_hook());
    CutBody cuts(s);
    int pockets = 0;
    cuts.for_each_cut([&](const Feature& f, const auto& by_ring, const auto&) {
      if (f.sense != Sense::hole) return;
      CHECK_FALSE(by_ring);
      ++pockets;
    });
    CHECK(pockets == 1);
  }
}

}  // namespace
}  // namespace oriel
