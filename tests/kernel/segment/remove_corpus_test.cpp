#include "kernel/segment/remove.h"
#include "tests/support/corpus.h"
#include "tests/support/inside.h"
#include "tests/support/segmented.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::all_features;
using test::segmented;
using test::Segmented;

struct Tally {
  std::size_t features = 0, refused = 0;
};

/// Takes everything off, then every fifth feature alone, and looks at what is left.
void check_removal(const Building& building, Tally& tally) {
  CAPTURE(building.id);
  const Segmented s = segmented(building);
  const auto all = all_features(s.segmentation);
  const Remainder rest = remove_features(s.solid, s.segmentation, all);
  tally.features += all.size();
  tally.refused += rest.refused.size();
  CHECK(is_closed(rest.solid));
  CHECK(rest.solid.facets.size() < s.solid.facets.size());
  for (const Refusal& refusal : rest.refused) CHECK_FALSE(refusal.reason.empty());
  for (const Facet& facet : rest.solid.facets)
    CHECK(area_m2(rest.solid.vertices, facet, rest.solid.planes[facet.plane.index()].normal) > 0);
  for (std::size_t i = 0; i < all.size(); i += 5) {
    CAPTURE(i);
    const Remainder one = remove_features(s.solid, s.segmentation, {all[i]});
    CHECK(is_closed(one.solid));
    if (!one.refused.empty())
      CHECK(volume_m3(one.solid) == doctest::Approx(volume_m3(s.solid)).epsilon(1e-12));
  }
}

/// The remainder is inside where the solid was, or was no more than a feature's box away from it.
void check_volume(const Building& building) {
  CAPTURE(building.id);
  const Segmented s = segmented(building);
  double volume = volume_m3(s.solid);
  const Remainder rest = remove_features(s.solid, s.segmentation, all_features(s.segmentation));
  if (!rest.refused.empty()) return;
  for (const Feature& f : s.segmentation.features)
    if (!f.parent.is_valid()) volume += f.sense == Sense::protrusion ? -f.volume_m3 : f.volume_m3;
  CHECK(volume_m3(rest.solid) == doctest::Approx(volume).epsilon(1e-6));
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("features come off the samples and leave a closed solid") {
    Tally tally;
    for (const Building& building : test::samples().buildings) {
      check_removal(building, tally);
      check_volume(building);
    }
    CHECK(tally.features > 200);
    CAPTURE(tally.refused);
    CHECK(tally.refused * 20 < tally.features);
  }

  TEST_CASE("features come off random3dcity and leave a closed solid") {
    ORIEL_NEEDS_SHARED(shared);
    Tally tally;
    auto files = test::files_in(shared / "data" / "random3dcity", ".stripped.city.json");
    files.resize(std::min<std::size_t>(files.size(), 25));
    for (const Building& building : test::corpus_of(files).buildings) {
      check_removal(building, tally);
      check_volume(building);
    }
    CHECK(tally.features > 200);
    CAPTURE(tally.refused);
    CHECK(tally.refused * 20 < tally.features);
  }
}

}  // namespace
}  // namespace oriel
