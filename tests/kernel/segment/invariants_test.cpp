#include "tests/kernel/segment/invariants.h"

#include "tests/support/houses.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("kernel/segment") {
  TEST_CASE("every body is the sum of its cells and the value of its tree in both orders") {
    for (const auto& [name, make] : test::bodies())
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(std::string(name));
        CAPTURE(to_string(order));
        test::check_segmentation(test::segmented(make(), order));
      }
  }
}

}  // namespace
}  // namespace oriel
