#include "kernel/segment/removal/ring_cut.h"

#include "tests/kernel/segment/removal/cut_body.h"
#include "tests/support/houses.h"

#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::AskedCut;
using test::CutBody;
using test::Segmented;

std::vector<FacetId> facets_of(const Segmented& s, const Feature& f) {
  std::vector<FacetId> facets;
  for (int i = 0; i < std::ssize(s.solid.facets); ++i)
    for (const int polygon : s.solid.facets[static_cast<std::size_t>(i)].polygons)
      if (std::ranges::binary_search(f.source_polygons, polygon)) facets.push_back(FacetId{i});
  return facets;
}

/// What is found by rings of the body, which may have changed since.
std::optional<std::vector<detail::CutCap>> caps_by_ring(const CutBody& cuts,
                                                        detail::RingCuts& rings,
                                                        const AskedCut& asked) {
  return rings.find(cuts.body, asked.plane, asked.direction, asked.is_material,
                    asked.feature.cap_point, facets_of(cuts.s, asked.feature));
}

/// How many cuts are found by rings while features come off one after the other.
int count_rings(const Segmented& s) {
  int count = 0;
  CutBody cuts(s);
  detail::RingCuts rings(cuts.body);
  cuts.for_each_cut([&](const AskedCut& asked, const auto& cut) {
    const auto by_ring = caps_by_ring(cuts, rings, asked);
    if (by_ring) {
      REQUIRE(cut);
      REQUIRE(cut->caps);
      REQUIRE(by_ring->size() == 1);
      REQUIRE(cut->caps->size() == 1);
      CHECK(by_ring->front().side == cut->caps->front().side);
      CHECK(test::rims_of(by_ring->front()) == test::rims_of(cut->caps->front()));
      ++count;
    }
    const bool is_hole = asked.feature.sense == Sense::hole;
    if (cut && cut->caps) CHECK(take_off(cuts.body, *cut->caps, is_hole, {}, {}));
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
    detail::RingCuts rings(cuts.body);
    int pockets = 0;
    cuts.for_each_cut([&](const AskedCut& asked, const auto&) {
      if (asked.feature.sense != Sense::hole) return;
      CHECK_FALSE(caps_by_ring(cuts, rings, asked));
      ++pockets;
    });
    CHECK(pockets == 1);
  }
}

}  // namespace
}  // namespace oriel
