#include "generalise/removal/clear_edges.h"

#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

constexpr double kLeast_m = 0.5;

/// A block of 10 x 8 x 6 m of which two edges are cut off by 0.25 m: four edges of 0.35 m.
Solid chamfered() {
  const std::vector<Vec3> foot{{0.25, 0, 0}, {9.75, 0, 0}, {10, 0.25, 0},
                               {10, 8, 0},   {0, 8, 0},    {0, 0.25, 0}};
  constexpr Vec3 kUp{0, 0, 6};
  std::vector<std::vector<Vec3>> polygons{{foot.rbegin(), foot.rend()}, {}};
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const Vec3 p = foot[i], q = foot[(i + 1) % foot.size()];
    polygons.push_back({p, q, q + kUp, p + kUp});
    polygons[1].push_back(p + kUp);
  }
  return solid_of(building_of(polygons));
}

ClearOrder order() {
  ClearOrder order;
  order.reach_m = kLeast_m;
  order.short_edges_of = [](const Solid& solid) {
    return short_edges(solid, Segmentation{}, {}, kLeast_m);
  };
  order.keeps_facet = [](const Solid&, const Facet&) { return std::nullopt; };
  return order;
}

SolidValidator judging(std::function<Fitness(const Solid&)> fitness_of) {
  SolidValidator validator;
  validator.fitness_of = std::move(fitness_of);
  return validator;
}

/// All four edges are left as they were, with one reason, which is returned.
std::string reason_of(const ClearOrder& order, const SolidValidator& validator) {
  const Cleared cleared = clear_edges(chamfered(), order, validator);
  CHECK(cleared.solid.facets.size() == 8);
  REQUIRE(cleared.left.size() == 4);
  for (const UnclearedEdge& edge : cleared.left) {
    CHECK(length(edge.to - edge.from) < kLeast_m);
    CHECK(edge.reason == cleared.left[0].reason);
  }
  return cleared.left[0].reason;
}

const auto kAlwaysValid = [](const Solid&) { return Fitness::valid; };

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("edges that are too short are cleared by dropping the narrow facets at them") {
    const Cleared cleared = clear_edges(chamfered(), order(), judging(kAlwaysValid));
    CHECK(cleared.left.empty());
    CHECK(is_closed(cleared.solid));
    CHECK(cleared.solid.facets.size() == 6);
    CHECK(volume_m3(cleared.solid) == doctest::Approx(480).epsilon(1e-9));
    CHECK(short_edges(cleared.solid, Segmentation{}, {}, kLeast_m).empty());
  }

  TEST_CASE("what is cleared has nothing to clear") {
    const Cleared once = clear_edges(chamfered(), order(), judging(kAlwaysValid));
    const Cleared twice = clear_edges(once.solid, order(), judging(kAlwaysValid));
    CHECK(twice.solid.facets.size() == once.solid.facets.size());
    CHECK(twice.left.empty());
  }

  TEST_CASE("a facet does not go if the building were less fit without it") {
    const auto eight_facets = [](const Solid& solid) {
      return solid.facets.size() == 8 ? Fitness::valid : Fitness::as_it_came;
    };
    CHECK(reason_of(order(), judging(eight_facets)) ==
          "cannot remove the narrow facet: the building would not be valid");
  }

  TEST_CASE("of two facets the one goes that leaves a fit building") {
    const auto one_each = [](const Solid& solid) {
      return solid.facets.size() >= 7 ? Fitness::valid : Fitness::unfit;
    };
    const Cleared cleared = clear_edges(chamfered(), order(), judging(one_each));
    CHECK(cleared.solid.facets.size() == 7);
    CHECK(cleared.left.size() == 2);
  }

  TEST_CASE("a facet does not go if what must not change did") {
    SolidValidator validator = judging(kAlwaysValid);
    validator.violation_of = [](const Solid&) {
      return Violation{Code::G405, "the footprint would change by 0.08 %"};
    };
    CHECK(reason_of(order(), validator) ==
          "cannot remove the narrow facet: the footprint would change by 0.08 %");
  }

  TEST_CASE("a facet that has to stay stays, and without a validator all do") {
    ClearOrder keeping = order();
    keeping.keeps_facet = [](const Solid&, const Facet&) {
      return "it is of a feature that stays";
    };
    CHECK(reason_of(keeping, judging(kAlwaysValid)) ==
          "cannot remove the narrow facet: it is of a feature that stays");
    CHECK(reason_of(order(), {}) == "whether the building would still be valid was not checked");
  }
}
