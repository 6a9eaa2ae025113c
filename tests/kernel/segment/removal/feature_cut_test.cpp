#include "kernel/segment/removal/feature_cut.h"

#include "tests/kernel/segment/removal/cut_body.h"
#include "tests/support/houses.h"

#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::CutBody;
using test::Segmented;

/// Calls visit(body, feature, cut) for the cuts that follow edges.
template <class Visit>
void for_each_bare_cut(const Segmented& s, Visit visit) {
  CutBody cuts(s);
  cuts.for_each_cut([&](const test::AskedCut& asked, const auto& cut) {
    if (cut && cut->caps) visit(cuts.body, asked.feature, *cut);
  });
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
          CHECK(test::rims_of(caps[i]) == test::rims_of((*cut.caps)[i]));
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
