#include "generalise/removal/clear_edges.h"

#include "generalise/invariants/fineness.h"
#include "tests/generalise/bare_context.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

constexpr double kLeast_m = 0.5;

/// A block of 10 x 8 x 6 m of which two edges are cut off, the polygons 3 and 7.
Solid chamfered(double by_m) {
  const std::vector<Vec3> foot{{by_m, 0, 0}, {10 - by_m, 0, 0}, {10, by_m, 0},
                               {10, 8, 0},   {0, 8, 0},         {0, by_m, 0}};
  constexpr Vec3 kUp{0, 0, 6};
  std::vector<std::vector<Vec3>> polygons{{foot.rbegin(), foot.rend()}, {}};
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const Vec3 p = foot[i], q = foot[(i + 1) % foot.size()];
    polygons.push_back({p, q, q + kUp, p + kUp});
    polygons[1].push_back(p + kUp);
  }
  return solid_of(building_of(polygons));
}

/// The block had its edges cut off by 0.5 m, and is drawn with 0.25 m: four new edges of 0.35 m.
struct Drawn {
  Solid before = chamfered(0.5), drawn = chamfered(0.25);
  Segmentation segmentation{};
  RedrawContext context = bare_context(before, segmentation);

  explicit Drawn(SolidJudge* judge) {
    context.invariants.least_edge_m = kLeast_m;
    context.judge = judge;
  }
  [[nodiscard]] Generalised cleared() const { return clear_edges(context, {drawn, {}}); }
};

/// All four edges are left as they were, with one reason, which is returned.
std::string reason_of(const Drawn& drawn) {
  const Generalised cleared = drawn.cleared();
  CHECK(cleared.solid.facets.size() == 8);
  REQUIRE(cleared.uncleared.size() == 4);
  for (const UnclearedEdge& edge : cleared.uncleared) {
    CHECK(length(edge.to - edge.from) < kLeast_m);
    CHECK(edge.reason == cleared.uncleared[0].reason);
  }
  return cleared.uncleared[0].reason;
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("edges that are too short are cleared by dropping the narrow facets at them") {
    const Generalised cleared = Drawn(&any_closed()).cleared();
    CHECK(cleared.uncleared.empty());
    CHECK(is_closed(cleared.solid));
    CHECK(cleared.solid.facets.size() == 6);
    CHECK(volume_m3(cleared.solid) == doctest::Approx(480).epsilon(1e-9));
    CHECK(short_edges(cleared.solid, Segmentation{}, {}, kLeast_m).empty());
  }

  TEST_CASE("what is cleared has nothing to clear") {
    Drawn drawn(&any_closed());
    drawn.drawn = drawn.cleared().solid;
    const Generalised twice = drawn.cleared();
    CHECK(twice.solid.facets.size() == drawn.drawn.facets.size());
    CHECK(twice.uncleared.empty());
  }

  TEST_CASE("edges that the building came with are not cleared") {
    Drawn drawn(&any_closed());
    drawn.before = drawn.drawn;
    const Generalised cleared = drawn.cleared();
    CHECK(cleared.solid.facets.size() == 8);
    CHECK(cleared.uncleared.empty());
  }

  TEST_CASE("a facet does not go if the building were less fit without it") {
    JudgeBy eight_facets([](const Solid& solid) {
      return solid.facets.size() == 8 ? Fitness::valid : Fitness::as_it_came;
    });
    CHECK(reason_of(Drawn(&eight_facets)) ==
          "cannot remove the narrow facet: the building would not be valid");
  }

  TEST_CASE("of two facets the one goes that leaves a fit building") {
    JudgeBy one_each([](const Solid& solid) {
      return solid.facets.size() >= 7 ? Fitness::valid : Fitness::unfit;
    });
    const Generalised cleared = Drawn(&one_each).cleared();
    CHECK(cleared.solid.facets.size() == 7);
    CHECK(cleared.uncleared.size() == 2);
  }

  TEST_CASE("a facet does not go if what must not change did") {
    Drawn drawn(&any_closed());
    drawn.context.before = measures_of(drawn.before);
    drawn.context.invariants.limits.footprint_pct = 0.25;  // as it is drawn it changed by 0.235 %
    CHECK(reason_of(drawn) ==
          "cannot remove the narrow facet: the footprint would change by 0.274 %, more than 0.25 "
          "%");
  }

  TEST_CASE("a facet of a feature that stays is not dropped") {
    Drawn drawn(&any_closed());
    Feature corners;
    corners.source_polygons = {3, 7};
    drawn.segmentation.features = {corners};
    CHECK(reason_of(drawn) == "cannot remove the narrow facet: it is of a feature that stays");
  }

  TEST_CASE("no facet is dropped without a judge or work") {
    CHECK(reason_of(Drawn(nullptr)) == "whether the building would still be valid was not checked");
    Drawn drawn(&any_closed());
    Work work(1);
    drawn.context.work = &work;
    CHECK(reason_of(drawn) == std::string("cannot remove the narrow facet: ") + kNoWorkLeft);
  }
}
