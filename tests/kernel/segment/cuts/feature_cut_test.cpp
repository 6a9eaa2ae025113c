#include "kernel/segment/cuts/feature_cut.h"

#include "tests/support/houses.h"
#include "tests/support/segmented.h"

#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::Segmented;

/// Loop by loop, half-edge by half-edge.
std::vector<std::vector<EdgeId>> rims_of(const detail::CutCap& cap) {
  std::vector<std::vector<EdgeId>> rims;
  for (const detail::CapLoop& loop : cap.loops) {
    rims.emplace_back();
    for (const detail::CapEdge& edge : loop.edges) rims.back().push_back(edge.rim);
  }
  return rims;
}

/// Asks for the cut of each feature with one plane and calls visit(body, feature, cut) for those
/// that follow edges.
template <class Visit>
void for_each_bare_cut(const Segmented& s, Visit visit) {
  detail::World world{detail::PlaneTable(s.solid.planes),
                      detail::PointTable(s.solid, world.planes)};
  detail::Boundary body = boundary_of(s.solid, 0, world);
  for (const Feature& f : s.segmentation.features) {
    const bool is_material = f.sense == Sense::protrusion;
    if (f.planes.size() != 1 || (!is_material && f.sense != Sense::hole)) continue;
    const auto side = world.planes.find(s.segmentation.planes[f.planes[0].index()]);
    if (!side) continue;
    const int direction = ((*side & 1) == 0) == is_material ? 1 : -1;
    const auto cut = find_feature_cut(body, *side >> 1, direction, is_material, f.cap_point,
                                      {-1, 0.001, false, true});
    if (cut && cut->caps) visit(body, f, *cut);
  }
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("the lump of a cut along edges is the feature and its caps are what imprint makes") {
    int count = 0;
    for (const auto& [name, make] : test::bodies()) {
      CAPTURE(std::string(name));
      for_each_bare_cut(test::segmented(make()), [&](detail::Boundary& body, const Feature& f,
                                                     const detail::FeatureCut& cut) {
        CHECK(cut.lump.volume == doctest::Approx(f.volume_m3));
        detail::Boundary other = body;
        std::vector<PointId> touched;
        const auto caps = imprint(other, cut.section, cut.lump, touched);
        CHECK(touched.empty());
        REQUIRE(caps.size() == cut.caps->size());
        for (std::size_t i = 0; i < caps.size(); ++i) {
          CHECK(caps[i].side == (*cut.caps)[i].side);
          CHECK(rims_of(caps[i]) == rims_of((*cut.caps)[i]));
        }
        CHECK(take_off(body, *cut.caps, f.sense == Sense::hole, {}, {}));
        ++count;
      });
    }
    CHECK(count > 30);
  }

  TEST_CASE("a part that is not accepted stays on the body as it was") {
    int asked = 0;
    for_each_bare_cut(
        test::segmented(test::two_boxes_on_a_slab()),
        [&](detail::Boundary& body, const Feature& f, const detail::FeatureCut& cut) {
          const double volume_m3 = body.volume();
          const int edges = body.half_edge_count();
          const auto accepts = [&](const detail::Boundary& lump) {
            CHECK(lump.volume() == doctest::Approx(f.volume_m3));
            ++asked;
            return false;
          };
          CHECK_FALSE(take_off(body, *cut.caps, f.sense == Sense::hole, {}, {}, accepts));
          CHECK(body.half_edge_count() == edges);
          CHECK(body.dead_edge_count() == 0);
          CHECK(body.volume() == volume_m3);
        });
    CHECK(asked > 0);
  }
}

}  // namespace
}  // namespace oriel
