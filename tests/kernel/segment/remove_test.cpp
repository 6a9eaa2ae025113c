#include "kernel/segment/remove.h"

#include "tests/support/corpus.h"
#include "tests/support/houses.h"
#include "tests/support/inside.h"
#include "tests/support/segmented.h"

#include <numeric>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using doctest::Approx;
using test::all_features;
using test::segmented;
using test::Segmented;
using test::volume_without;

Remainder removed(const Segmented& s, const std::vector<FeatureId>& features,
                  const SegmentOptions& options = {}) {
  return remove_features(s.solid, s.segmentation, features, options);
}

/// What every remainder is: closed, told of once, its facets maximal and flat.
void check_remainder(const Segmented& s, const Remainder& rest) {
  if (!rest.solid.facets.empty()) CHECK(is_closed(rest.solid));
  CHECK(std::ranges::is_sorted(rest.removed));
  for (const Refusal& refusal : rest.refused) {
    CHECK_FALSE(refusal.reason.empty());
    CHECK_FALSE(std::ranges::binary_search(rest.removed, refusal.feature));
  }
  for (const Facet& facet : rest.solid.facets) {
    const Plane& plane = rest.solid.planes[facet.plane.index()];
    CHECK(area_m2(rest.solid.vertices, facet, plane.normal) > 0);
    for (const int p : facet.polygons)
      for (const FeatureId id : rest.removed)
        CHECK_FALSE(
            std::ranges::binary_search(s.segmentation.features[id.index()].source_polygons, p));
  }
}

std::size_t plain_facets(const Building& plain) { return test::solid_of(plain).facets.size(); }

TEST_SUITE("kernel/segment") {
  TEST_CASE("removing nothing leaves the solid as it is") {
    for (const auto& [name, make] : test::bodies()) {
      CAPTURE(std::string(name));
      const Segmented s = segmented(make());
      const Remainder rest = removed(s, {});
      check_remainder(s, rest);
      CHECK(rest.removed.empty());
      CHECK(rest.refused.empty());
      CHECK(rest.solid.facets.size() == s.solid.facets.size());
      CHECK(rest.solid.vertices.size() == s.solid.vertices.size());
      CHECK(rest.solid.shells.size() == s.solid.shells.size());
      CHECK(volume_m3(rest.solid) == Approx(volume_m3(s.solid)).epsilon(1e-12));
      CHECK(surface_m2(rest.solid) == Approx(surface_m2(s.solid)).epsilon(1e-12));
    }
  }

  TEST_CASE("removing everything leaves the plain body without a seam") {
    const Building slab = test::BoxBody().add({0, 0, 0}, {1, 1, 1}).build();
    const Building gable = test::gabled_house();
    for (const auto& [name, make] : test::bodies()) {
      const std::string body = name;
      CAPTURE(body);
      const Segmented s = segmented(make());
      const Remainder rest = removed(s, all_features(s.segmentation));
      check_remainder(s, rest);
      for (const Refusal& refusal : rest.refused) MESSAGE(refusal.reason);
      CHECK(rest.refused.empty());
      CHECK(rest.removed.size() == s.segmentation.features.size());
      CHECK(volume_m3(rest.solid) ==
            Approx(volume_without(s, all_features(s.segmentation))).epsilon(1e-9));
      // All but these are boxes or gabled houses with features.
      if (body == "cavity_and_lumps") continue;
      const bool is_gable = std::ranges::any_of(
          rest.solid.planes, [](const Plane& p) { return p.normal.z > 0.1 && p.normal.z < 0.9; });
      CHECK(rest.solid.facets.size() == plain_facets(is_gable ? gable : slab));
      CHECK(segment(s.building, rest.solid).features.empty());
    }
  }

  TEST_CASE("each feature alone takes its volume along and no other") {
    for (const auto& [name, make] : test::bodies()) {
      CAPTURE(std::string(name));
      const Segmented s = segmented(make());
      for (const FeatureId id : all_features(s.segmentation)) {
        CAPTURE(id.value);
        const Remainder rest = removed(s, {id});
        check_remainder(s, rest);
        if (!rest.refused.empty()) {
          CHECK(rest.refused.size() == 1);
          CHECK(rest.refused[0].feature == id);
          CHECK(rest.removed.empty());
          CHECK(volume_m3(rest.solid) == Approx(volume_m3(s.solid)).epsilon(1e-12));
          CHECK(rest.solid.facets.size() == s.solid.facets.size());
          continue;
        }
        CHECK(std::ranges::binary_search(rest.removed, id));
        for (const FeatureId gone : rest.removed) {
          if (gone == id) continue;
          const Feature& f = s.segmentation.features[gone.index()];
          CHECK((std::ranges::binary_search(rest.removed, f.parent) ||
                 std::ranges::binary_search(rest.removed, f.host)));
        }
      }
    }
  }

  TEST_CASE("windows are filled one by one and a wall without windows is one facet") {
    const Segmented s = segmented(test::six_pockets());
    REQUIRE(s.segmentation.features.size() == 6);
    std::vector<FeatureId> some;
    for (const FeatureId id : all_features(s.segmentation)) {
      some.push_back(id);
      const Remainder rest = removed(s, some);
      check_remainder(s, rest);
      CHECK(rest.removed == some);
      CHECK(volume_m3(rest.solid) == Approx(volume_without(s, some)).epsilon(1e-9));
      CHECK(rest.solid.facets.size() == 6 + 5 * (6 - some.size()));
      const Segmentation again = segment(s.building, rest.solid);
      CHECK(again.features.size() == 6 - some.size());
    }
  }

  TEST_CASE("a dormer takes its window along and a window leaves its dormer") {
    const Segmented s = segmented(test::dormer_with_window());
    REQUIRE(s.segmentation.features.size() == 2);
    const Remainder without_dormer = removed(s, {FeatureId{0}});
    CHECK(without_dormer.removed == all_features(s.segmentation));
    CHECK(volume_m3(without_dormer.solid) == Approx(720).epsilon(1e-5));
    const Remainder without_window = removed(s, {FeatureId{1}});
    CHECK(without_window.removed == std::vector{FeatureId{1}});
    check_remainder(s, without_window);
    CHECK(volume_m3(without_window.solid) ==
          Approx(volume_m3(s.solid) + s.segmentation.features[1].volume_m3).epsilon(1e-9));
  }

  TEST_CASE(
      "a part is refused if something would go with it that does not sit on it and is to stay") {
    Segmented s = segmented(test::dormer_with_window());
    const FeatureId dormer{0}, window{1};
    Feature& alone = s.segmentation.features[window.index()];
    alone.host = alone.parent = {};
    const Remainder refused = removed(s, {dormer});
    REQUIRE(refused.refused.size() == 1);
    CHECK(refused.refused[0].reason == "a feature that stays would go with it");
    CHECK(volume_m3(refused.solid) == Approx(volume_m3(s.solid)));
  }

  TEST_CASE("a filled terrace takes the block on its floor along and a removed block leaves it") {
    const Segmented s = segmented(test::terrace_with_block());
    const FeatureId terrace = test::feature_in(s.segmentation, {2, 2, 4}, {8, 6, 6});
    const FeatureId block = test::feature_in(s.segmentation, {3, 3, 4}, {6, 5, 5.5});
    const Remainder filled = removed(s, {terrace});
    check_remainder(s, filled);
    CHECK(filled.removed.size() == 2);
    CHECK(volume_m3(filled.solid) == Approx(480).epsilon(1e-6));
    const Remainder cleared = removed(s, {block});
    check_remainder(s, cleared);
    CHECK(cleared.removed == std::vector{block});
    CHECK(volume_m3(cleared.solid) == Approx(480 - 48).epsilon(1e-6));
    CHECK(cleared.solid.facets.size() == 11);
  }

  TEST_CASE("a filled cavity leaves one shell") {
    const Segmented s = segmented(test::cavity_and_lumps());
    const Remainder rest = removed(s, all_features(s.segmentation));
    check_remainder(s, rest);
    CHECK(rest.removed.size() == 1);
    CHECK(std::ranges::none_of(rest.solid.shells, &Shell::is_cavity));
  }

  TEST_CASE(
      "a part with a cavity that is to stay is refused and goes with it if both are asked for") {
    const Segmented s = segmented(test::BoxBody()
                                      .add({0, 0, 0}, {10, 8, 6})
                                      .add({3, 3, 6}, {6, 6, 9})
                                      .remove({4, 4, 7}, {5, 5, 8})
                                      .build());
    const FeatureId tower = test::feature_in(s.segmentation, {3, 3, 6}, {6, 6, 9});
    const FeatureId cavity = test::feature_in(s.segmentation, {4, 4, 7}, {5, 5, 8});
    REQUIRE(tower.is_valid());
    REQUIRE(cavity.is_valid());
    const Remainder one = removed(s, {tower});
    CHECK(one.removed.empty());
    REQUIRE(one.refused.size() == 1);
    CHECK(volume_m3(one.solid) == Approx(volume_m3(s.solid)).epsilon(1e-12));
    const Remainder both = removed(s, {tower, cavity});
    CHECK(both.removed.size() == 2);
    CHECK(volume_m3(both.solid) == Approx(480).epsilon(1e-12));
    CHECK(both.solid.facets.size() == 6);
  }

  TEST_CASE("what sits on a refused feature stays with it") {
    // The step under the setback cannot be filled while the niche through its edge stays; the
    // niche in the wall behind it went first.
    const Segmented s = segmented(test::niche_over_an_edge());
    const FeatureId step = test::feature_in(s.segmentation, {0, 0, 6}, {10, 1, 9});
    const FeatureId niche = test::feature_in(s.segmentation, {4, 1, 6}, {6, 1.5, 8});
    REQUIRE(step.is_valid());
    REQUIRE(niche.is_valid());
    CHECK(s.segmentation.features[niche.index()].host == step);
    const Remainder rest = removed(s, {step});
    REQUIRE(rest.refused.size() == 1);
    CHECK(rest.refused[0].feature == step);
    CHECK(rest.removed.empty());
    CHECK(volume_m3(rest.solid) == Approx(volume_m3(s.solid)).epsilon(1e-12));
    // All was done again without it: that is counted, and without work left nothing is taken off.
    Work work(1);
    const Remainder stopped =
        remove_features(s.solid, s.segmentation, {step}, SegmentOptions{}, &work);
    CHECK(work.is_used_up());
    CHECK(stopped.removed.empty());
    REQUIRE(stopped.refused.size() == 1);
    CHECK(stopped.refused[0].code == Code::E502);
    CHECK(stopped.solid.facets.size() == s.solid.facets.size());
    // Asked for by name, the niche goes all the same.
    const Remainder both = removed(s, {step, niche});
    CHECK(both.removed == std::vector{niche});
    CHECK(both.refused.size() == 1);
  }

  TEST_CASE("a feature of another solid is refused with a reason and the solid stays") {
    const Segmented s = segmented(test::six_pockets());
    const Segmented other = segmented(test::two_boxes_on_a_slab());
    const Remainder rest =
        remove_features(other.solid, s.segmentation, {FeatureId{0}}, SegmentOptions{});
    REQUIRE(rest.refused.size() == 1);
    CHECK_FALSE(rest.refused[0].reason.empty());
    CHECK(is_closed(rest.solid));
    CHECK(volume_m3(rest.solid) == Approx(volume_m3(other.solid)).epsilon(1e-12));
  }
}

}  // namespace
}  // namespace oriel
