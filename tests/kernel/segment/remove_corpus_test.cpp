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

void check_volume(const Segmented& s, const Remainder& rest) {
  CHECK(volume_m3(rest.solid) ==
        doctest::Approx(test::volume_without(s, rest.removed)).epsilon(1e-6));
}

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
    check_volume(s, one);
    if (!one.refused.empty()) CHECK(one.removed.empty());
  }
  check_volume(s, rest);
  const Segmentation again = segment(building, rest.solid);
  for (const Feature& f : again.features)
    for (const FeatureId gone : rest.removed) {
      const Feature& was = s.segmentation.features[gone.index()];
      CHECK_FALSE((f.box == was.box && f.sense == was.sense));
    }
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("features come off the samples and leave a closed solid") {
    Tally tally;
    for (const Building& building : test::samples().buildings) {
      check_removal(building, tally);
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
    }
    CHECK(tally.features > 200);
    CAPTURE(tally.refused);
    CHECK(tally.refused * 20 < tally.features);
  }
}

}  // namespace
}  // namespace oriel
