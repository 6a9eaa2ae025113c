#include "interpret/language/quantity.h"

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::rules;

TEST_SUITE("interpret") {
  TEST_CASE("quantities are written with their unit and as many decimals as tell them apart") {
    constexpr Dimension kLength{1, 0};
    CHECK(rules::write(0.61, kLength) == "0.61 m");
    CHECK(rules::write(0.6004, kLength, 0.6) == "0.6004 m");
    CHECK(rules::write(0.6, kLength, 0.6 + 1e-12) == "0.60 m");
    CHECK(rules::write(3, {}) == "3");
    CHECK(rules::write(3, {}, 2.5) == "3.00");
    CHECK(rules::write(90, {0, 1}) == "90.00 deg");
    CHECK(rules::write(2, {3, 0}) == "2.00 m3");
  }

  TEST_CASE("every attribute has a dimension that a unit names") {
    for (const AttributeInfo& attribute : feature_schema()) {
      const Dimension dimension = dimension_of(attribute.unit);
      CHECK(unit_of(dimension) == suffix_of(attribute.unit));
      CHECK((dimension.is_plain() || unit_word(unit_of(dimension)).has_value()));
    }
  }
}
