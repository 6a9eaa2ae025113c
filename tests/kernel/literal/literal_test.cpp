#include "kernel/literal/literal.h"

#include "kernel/base/random.h"
#include "tests/support/grid_reference.h"
#include "tests/support/houses.h"
#include "tests/support/solidified.h"

#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using doctest::Approx;
using Four = std::array<std::int64_t, 4>;

constexpr std::int64_t kEnough = 4'000'000'000;

/// Bodies of whole metres are exact and have exact values; of others values that differ by
/// rounding are equal.
LiteralCount counted(const Building& building, const Heuristics& heuristics = {}) {
  Tolerances tolerances;
  tolerances.value_rel = 1e-9;
  const LiteralCount count =
      count_literally(test::solid_of(building), heuristics, tolerances, kEnough);
  CHECK_FALSE(count.is_used_up);
  return count;
}

const Solid& figure_5() {
  static const Solid solid = test::solid_of(test::full_house());
  return solid;
}

LiteralCount counted_figure_5(const Heuristics& heuristics = {}) {
  const LiteralCount count = count_literally(figure_5(), heuristics, {}, kEnough);
  CHECK_FALSE(count.is_used_up);
  return count;
}

Heuristics untested_if_convex() {
  Heuristics heuristics;
  heuristics.convex_bodies_untested = true;
  return heuristics;
}

constexpr Heuristics kNone{false, false, false, false, false};

std::int64_t total(const Four& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), std::int64_t{0});
}

/// n over k.
std::int64_t binomial(std::int64_t n, std::int64_t k) {
  std::int64_t product = 1;
  for (std::int64_t i = 0; i < k; ++i) product = product * (n - i) / (i + 1);
  return product;
}

/// What holds of every count.
void check_sums(const LiteralCount& count) {
  CHECK(count.steps.size() == count.leaves + count.inner);
  for (const LiteralStep& step : count.steps) {
    CHECK(step.protrusion_tests == step.tested[0]);
    CHECK(step.hole_tests == total(step.tested));
    for (std::size_t k = 0; k < 4; ++k) CHECK(step.tested[k] <= step.combinations[k]);
    CHECK((step.cut >= 0) == (step.parts > 0));
  }
}

/// A block with boxes added or taken away.
std::vector<test::GridBox> random_boxes(std::uint64_t seed) {
  Random random(seed);
  std::vector<test::GridBox> boxes{{{0, 0, 0}, {6, 5, 4}, true}};
  for (int i = random.between(1, 4); i > 0; --i) {
    test::GridBox box{{}, {}, random.chance(0.5)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = random.between(-1, 5);
      box.max[axis] = box.min[axis] + random.between(1, 3);
    }
    boxes.push_back(box);
  }
  return boxes;
}

Building building_of(const std::vector<test::GridBox>& boxes) {
  test::BoxBody body;
  for (const test::GridBox& box : boxes) {
    const Vec3 min{double(box.min[0]), double(box.min[1]), double(box.min[2])};
    const Vec3 max{double(box.max[0]), double(box.max[1]), double(box.max[2])};
    box.is_added ? body.add(min, max) : body.remove(min, max);
  }
  return body.build();
}

TEST_SUITE("kernel/literal") {
  TEST_CASE("the first recursion of figure 5 has the paper's combinations") {
    const LiteralCount with = counted_figure_5();
    CHECK(with.steps[0].planes == 34);
    CHECK(with.steps[0].combinations == Four{34, 561, 5984, 46376});
    CHECK(with.steps[0].tested == Four{34, 0, 0, 0});
    CHECK(with.steps[0].value == Approx(3.0 / 997).epsilon(1e-5));
    // The budget ends after the first recursion.
    const LiteralCount without = count_literally(figure_5(), kNone, {}, 30'000'000);
    REQUIRE(without.steps.size() > 1);
    CHECK(without.steps[0].tested == Four{34, 561, 5984, 46376});
    for (const LiteralStep& step : with.steps)
      for (std::size_t k = 0; k < 4; ++k)
        CHECK(step.combinations[k] == binomial(step.planes, static_cast<std::int64_t>(k) + 1));
  }

  TEST_CASE("figure 5 has 19 leaves under 8 nodes and a chimney that takes 56 intersections") {
    const LiteralCount count = counted_figure_5();
    check_sums(count);
    CHECK(count.leaves == 19);
    CHECK(count.inner == 8);
    // The rest comes before the features of a cut, so the chimney is the last of all bodies.
    CHECK(count.steps.back().planes == 6);
    CHECK(count.steps.back().tested == Four{6, 15, 20, 15});
    CHECK(total(count.steps.back().tested) == 56);
    CHECK(count.steps.back().cut == -1);
  }

  TEST_CASE("convex bodies are leaves whether they are tested or not") {
    const LiteralCount tested = counted_figure_5();
    const LiteralCount untested = counted_figure_5(untested_if_convex());
    check_sums(untested);
    CHECK(untested.leaves == tested.leaves);
    CHECK(untested.inner == tested.inner);
    // What an exact reference of the design ran on this body.
    CHECK(untested.sum().protrusion_tests == 173);
    CHECK(untested.sum().hole_tests == 285);
  }

  TEST_CASE("bodies with exact answers are split as in the paper's order") {
    const std::vector<std::pair<Building, std::pair<std::size_t, std::size_t>>> bodies{
        {test::two_boxes_on_a_slab(), {3, 1}}, {test::pocket(), {2, 1}},
        {test::three_notches(), {4, 3}},       {test::long_notch(), {2, 1}},
        {test::corner_notch(), {2, 1}},        {test::six_pockets(), {7, 1}},
        {test::l_of_boxes(), {2, 1}},          {test::gabled_house(), {1, 0}},
        {test::cross_gable(), {5, 4}},         {test::l_house(), {2, 1}}};
    for (const auto& [building, expected] : bodies) {
      const LiteralCount count = counted(building);
      check_sums(count);
      CHECK(count.leaves == expected.first);
      CHECK(count.inner == expected.second);
    }
  }

  TEST_CASE("the notches of figure 3 take one plane and two and three") {
    const LiteralCount count = counted(test::three_notches());
    CHECK(count.steps[0].cut == 1);
    CHECK(count.steps[0].value == Approx(1.0 / 28).epsilon(1e-9));
    CHECK(count.steps[1].cut == 2);
    CHECK(count.steps[1].value == Approx(4.0 / 59).epsilon(1e-9));
    CHECK(count.steps[2].cut == 3);
    CHECK(count.steps[2].value == Approx(3.0 / 77).epsilon(1e-9));
  }

  TEST_CASE("random bodies are split as a slow and simple reference splits them") {
    std::size_t inner = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      CAPTURE(seed);
      const auto boxes = random_boxes(seed);
      const test::Reference expected = test::reference_of(boxes);
      if (expected.is_degenerate) continue;
      const LiteralCount count = counted(building_of(boxes), untested_if_convex());
      check_sums(count);
      CHECK(static_cast<int>(count.leaves) == expected.leaves);
      CHECK(static_cast<int>(count.inner) == expected.inner);
      inner += count.inner;
    }
    CHECK(inner > 60);
  }

  TEST_CASE("parallel planes tested together change nothing but the number of tests") {
    Heuristics heuristics;
    heuristics.different_normals = false;
    const LiteralCount with = counted_figure_5();
    const LiteralCount without = counted_figure_5(heuristics);
    CHECK(without.leaves == with.leaves);
    CHECK(without.inner == with.inner);
    CHECK(without.sum().hole_tests > with.sum().hole_tests);
    for (std::size_t i = 0; i < with.steps.size(); ++i)
      CHECK(without.steps[i].value == with.steps[i].value);
  }

  TEST_CASE("equal features one at a time take a recursion each") {
    Heuristics heuristics;
    heuristics.equal_features_together = false;
    const LiteralCount together = counted(test::six_pockets());
    const LiteralCount apart = counted(test::six_pockets(), heuristics);
    CHECK(together.steps[0].parts == 6);
    CHECK(apart.steps[0].parts == 1);
    CHECK(apart.leaves == together.leaves);
    CHECK(apart.inner == 6);
  }

  TEST_CASE("all combinations are tested where the fewest planes do not come first") {
    Heuristics heuristics;
    heuristics.fewest_planes_first = false;
    const LiteralCount count = counted(test::pocket(), heuristics);
    for (const LiteralStep& step : count.steps) {
      CHECK(step.tested[0] == step.combinations[0]);
      CHECK(step.tested[3] > 0);
    }
  }

  TEST_CASE("a value of one is taken where any value is valid") {
    // Both its protrusions are worth exactly 1.
    Heuristics heuristics;
    heuristics.values_below_one = false;
    const LiteralCount count = counted(test::l_of_boxes(), heuristics);
    CHECK(count.steps[0].cut == 1);
    CHECK(count.steps[0].value == Approx(1).epsilon(1e-9));
    CHECK(counted(test::l_of_boxes()).steps[0].cut == 4);
  }

  TEST_CASE("several lumps and cavities are separated first") {
    const LiteralCount two =
        counted(test::BoxBody().add({0, 0, 0}, {1, 1, 1}).add({3, 0, 0}, {4, 1, 1}).build());
    CHECK(two.leaves == 2);
    CHECK(two.inner == 1);
    CHECK(two.steps[0].cut == 0);
    CHECK(total(two.steps[0].combinations) == 0);
    const LiteralCount hollow =
        counted(test::BoxBody().add({0, 0, 0}, {3, 3, 3}).remove({1, 1, 1}, {2, 2, 2}).build());
    CHECK(hollow.leaves == 2);
    CHECK(hollow.inner == 1);
    CHECK(hollow.steps[0].cut == 0);
    CHECK(hollow.steps[0].is_hole);
  }

  TEST_CASE("counting ends where its budget does") {
    std::int64_t before = -1;
    for (const std::int64_t budget : {1, 1'000, 300'000, 600'000, 2'000'000}) {
      const LiteralCount once = count_literally(figure_5(), kNone, {}, budget);
      const LiteralCount again = count_literally(figure_5(), kNone, {}, budget);
      CHECK(once.is_used_up);
      CHECK(once.sum().hole_tests == again.sum().hole_tests);
      CHECK(once.sum().hole_tests >= before);
      before = once.sum().hole_tests;
    }
    CHECK(before > 0);
  }
}

}  // namespace
}  // namespace oriel
