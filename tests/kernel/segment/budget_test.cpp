#include "tests/kernel/segment/invariants.h"
#include "tests/support/corpus.h"
#include "tests/support/houses.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::segmented;
using test::Segmented;

TEST_SUITE("kernel/segment") {
  TEST_CASE("a used up budget is told once and what is there still sums up") {
    for (const std::int64_t budget : {0, 100, 1000, 5000})
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(budget);
        SegmentOptions options;
        options.order = order;
        options.budget = budget;
        const Segmented s = segmented(test::full_house(), options);
        test::check_segmentation(s);
        const auto flagged =
            std::ranges::count(s.segmentation.cells, LeafFlag::budget, &Cell::flag);
        CHECK((flagged > 0) == !s.segmentation.issues.empty());
        if (budget > 1000) continue;
        CHECK(flagged > 0);
        REQUIRE(s.segmentation.issues.size() == 1);
        CHECK(s.segmentation.issues[0].code == Code::E502);
        CHECK(s.segmentation.issues[0].severity == Severity::warning);
        CHECK(s.segmentation.issues[0].place.building == "body");
      }
  }

  TEST_CASE("more budget never leaves less split and enough leaves no flag") {
    const Building building = test::samples().buildings.at(0);
    std::size_t leaves = 0;
    for (const std::int64_t budget : {0, 1000, 10'000, 100'000, 10'000'000}) {
      SegmentOptions options;
      options.budget = budget;
      const Segmented s = segmented(building, options);
      CHECK(s.segmentation.stats.leaves >= leaves);
      leaves = s.segmentation.stats.leaves;
      if (budget == 10'000'000) CHECK(s.segmentation.issues.empty());
    }
    CHECK(leaves > 1);
  }

  TEST_CASE("a lower order of cuts leaves what needs more planes unsplit") {
    SegmentOptions options;
    options.order = Order::paper;
    for (const auto& [order, leaves] : {std::pair(1, 2), {2, 3}, {3, 4}, {4, 4}}) {
      options.max_order = order;
      const Segmented s = segmented(test::three_notches(), options);
      CHECK(s.segmentation.stats.leaves == static_cast<std::size_t>(leaves));
      test::check_segmentation(s);
    }
    for (const auto& [order, leaves] : {std::pair(3, 1), {4, 2}}) {
      options.max_order = order;
      const Segmented s = segmented(test::long_notch(), options);
      CHECK(s.segmentation.stats.leaves == static_cast<std::size_t>(leaves));
      CHECK(s.segmentation.cells[0].flag ==
            (leaves == 1 ? LeafFlag::no_candidate : LeafFlag::convex));
    }
  }
}

}  // namespace
}  // namespace oriel
