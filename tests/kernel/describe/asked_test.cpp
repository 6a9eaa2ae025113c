#include "kernel/describe/describe.h"
#include "tests/support/described.h"
#include "tests/support/houses.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxBody;

/// Two windows in a wall and a chimney.
test::Segmented small_house() {
  BoxBody body;
  body.add({0, 0, 0}, {12, 8, 6}).add({5, 3, 6}, {6, 4, 7.5});
  body.remove({1, 0, 1}, {2.2, 0.2, 2.5}).remove({2.6, 0, 1}, {3.8, 0.2, 2.5});
  return test::segmented(body.build());
}

}  // namespace

TEST_SUITE("kernel/describe") {
  TEST_CASE("an attribute that is asked for alone is what it is among all") {
    const auto house = small_house();
    const Description all = describe(house.building, house.segmentation);
    int compared = 0;
    for (const Attribute asked : kAttributes) {
      CAPTURE(info_of(asked).name);
      DescribeOptions options;
      options.attributes.assign(kAttributes.size(), false);
      options.attributes[column_of(asked)] = true;
      options.relations.assign(relation_schema().size(), false);
      const Description some = describe(house.building, house.segmentation, options);
      REQUIRE(some.table.rows() == all.table.rows());
      for (int row = 0; row < static_cast<int>(all.table.rows()); ++row) {
        const FeatureId id{row};
        CHECK(some.table.id(id) == all.table.id(id));
        if (info_of(asked).unit == Unit::text)
          CHECK(some.table.text(id, asked) == all.table.text(id, asked));
        else
          CHECK(some.table.number(id, asked) == all.table.number(id, asked));
        ++compared;
      }
    }
    CHECK(compared > 60);
  }

  TEST_CASE("a relation that is asked for alone leads where it leads among all") {
    const auto house = small_house();
    const Description all = describe(house.building, house.segmentation);
    std::size_t pairs = 0;
    for (std::size_t asked = 0; asked < relation_schema().size(); ++asked) {
      const std::string& name = relation_schema()[asked].name;
      CAPTURE(name);
      DescribeOptions options;
      options.attributes.assign(feature_schema().size(), false);
      options.relations.assign(relation_schema().size(), false);
      options.relations[asked] = true;
      const Description some = describe(house.building, house.segmentation, options);
      CHECK(some.graph.pairs(name) == all.graph.pairs(name));
      pairs += some.graph.pairs(name).size();
    }
    CHECK(pairs > 4);
  }
}

}  // namespace oriel
