#include "kernel/segment/cuts/kept_sections.h"

#include "tests/support/houses.h"
#include "tests/support/segmented.h"

#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::Segmented;

/// The same lump and the same caps, half-edge by half-edge.
void check_same(const std::optional<detail::FoundCut>& one,
                const std::optional<detail::FoundCut>& other) {
  REQUIRE(one.has_value() == other.has_value());
  if (!one) return;
  CHECK(one->lump.is_finite == other->lump.is_finite);
  CHECK(one->lump.is_sound == other->lump.is_sound);
  CHECK(one->lump.volume == doctest::Approx(other->lump.volume));
  REQUIRE(one->caps.has_value() == other->caps.has_value());
  if (!one->caps) return;
  REQUIRE(one->caps->size() == other->caps->size());
  for (std::size_t i = 0; i < one->caps->size(); ++i) {
    const detail::CutCap &cap = (*one->caps)[i], &same = (*other->caps)[i];
    CHECK(cap.side == same.side);
    REQUIRE(cap.loops.size() == same.loops.size());
    for (std::size_t l = 0; l < cap.loops.size(); ++l) {
      std::vector<EdgeId> rim, same_rim;
      for (const detail::CapEdge& edge : cap.loops[l].edges) rim.push_back(edge.rim);
      for (const detail::CapEdge& edge : same.loops[l].edges) same_rim.push_back(edge.rim);
      CHECK(rim == same_rim);
    }
  }
}

/// Takes features off one after the other and asks for each cut twice. Returns how many came off.
int take_off_all(const Segmented& s) {
  detail::World world{detail::PlaneTable(s.solid.planes),
                      detail::PointTable(s.solid, world.planes)};
  detail::Boundary body = boundary_of(s.solid, 0, world);
  const detail::SectionOptions options{-1, 0.001, false, true};
  detail::KeptSections kept(options);
  int count = 0;
  for (const Feature& f : s.segmentation.features) {
    const bool is_material = f.sense == Sense::protrusion;
    if (f.planes.size() != 1 || (!is_material && f.sense != Sense::hole)) continue;
    const auto side = world.planes.find(s.segmentation.planes[f.planes[0].index()]);
    if (!side) continue;
    const int direction = ((*side & 1) == 0) == is_material ? 1 : -1;
    detail::KeptSections fresh(options);
    const auto expected = fresh.find(body, *side >> 1, direction, is_material, f.cap_point);
    const auto cut = kept.find(body, *side >> 1, direction, is_material, f.cap_point);
    check_same(cut, expected);
    if (!cut || !cut->caps) continue;
    const std::vector<detail::CutCap> caps = *cut->caps;
    const auto carved = take_off(body, caps, f.sense == Sense::hole, {}, {});
    if (!carved) continue;
    kept.forget();
    ++count;
  }
  return count;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("sections that are kept until a part comes off show the cuts that new ones show") {
    int count = 0;
    for (const auto& [name, make] : test::bodies()) {
      CAPTURE(std::string(name));
      count += take_off_all(test::segmented(make()));
    }
    CHECK(count > 30);
  }

  TEST_CASE("a part that is not accepted stays on the body as it was") {
    const Segmented s = test::segmented(test::two_boxes_on_a_slab());
    detail::World world{detail::PlaneTable(s.solid.planes),
                        detail::PointTable(s.solid, world.planes)};
    detail::Boundary body = boundary_of(s.solid, 0, world);
    const double volume_m3 = body.volume();
    const int edges = body.half_edge_count();
    int asked = 0;
    for (const Feature& f : s.segmentation.features) {
      const auto side = world.planes.find(s.segmentation.planes[f.planes[0].index()]);
      if (!side || f.planes.size() != 1) continue;
      const bool is_material = f.sense == Sense::protrusion;
      const int direction = ((*side & 1) == 0) == is_material ? 1 : -1;
      detail::KeptSections sections({-1, 0.001, false, true});
      const auto cut = sections.find(body, *side >> 1, direction, is_material, f.cap_point);
      if (!cut || !cut->caps) continue;
      const auto accepts = [&](const detail::Boundary& lump) {
        CHECK(lump.volume() == doctest::Approx(f.volume_m3));
        ++asked;
        return false;
      };
      CHECK_FALSE(take_off(body, *cut->caps, f.sense == Sense::hole, {}, {}, accepts));
    }
    CHECK(asked > 0);
    CHECK(body.half_edge_count() == edges);
    CHECK(body.dead_edge_count() == 0);
    CHECK(body.volume() == volume_m3);
  }
}

}  // namespace
}  // namespace oriel
