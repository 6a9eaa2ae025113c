#include "tests/support/corpus.h"
#include "tests/support/described.h"
#include "tests/support/houses.h"

#include <set>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::described;
using test::Described;
using Pairs = std::vector<FeatureGraph::Pair>;

Pairs pairs(const Described& d, const std::string& name) {
  const auto span = d.graph().pairs(name);
  return {span.begin(), span.end()};
}

/// Windows 1.2 × 1.5 m on a grid of 2 × 2.4 m in the front; a wide one far off; one round the
/// corner.
Described facade() {
  BoxBody body;
  body.add({0, 0, 0}, {20, 8, 8});
  for (const double x : {1.0, 3.0})
    for (const double z : {1.0, 3.4}) body.remove({x, 0, z}, {x + 1.2, 0.2, z + 1.5});
  body.remove({12, 0, 1}, {15, 0.2, 2.5});
  body.remove({0, 3, 1}, {0.2, 4.2, 2.5});
  return described(body.build());
}

/// What holds of the relations of every building.
void check_graph(const Described& d) {
  std::set<std::string> names;
  for (const RelationKind& kind : relation_schema()) names.insert(kind.name);
  const auto& features = d.segmented.segmentation.features;
  for (const std::string& name : d.graph().names()) {
    const auto all = d.graph().pairs(name);
    CAPTURE(name);
    CHECK(names.contains(name));
    CHECK(std::ranges::is_sorted(all));
    CHECK(std::ranges::adjacent_find(all) == all.end());
    for (const auto& [self, other] : all) {
      CHECK(self != other);
      CHECK(self.index() < features.size());
      CHECK(other.index() < features.size());
    }
  }
  CHECK(d.graph().names().size() == names.size());
  for (const char* name : {"same_facade", "same_storey", "alike", "beside"})
    for (const auto& [self, other] : d.graph().pairs(name)) CHECK(holds(d, name, other, self));
  for (const auto& [lower, upper] : d.graph().pairs("above"))
    CHECK_FALSE(holds(d, "above", upper, lower));
  for (const char* name : {"alike", "beside", "above"})
    for (const auto& [self, other] : d.graph().pairs(name))
      CHECK(holds(d, "same_facade", self, other));
  // contains is host turned round, with all that follows.
  for (const auto& [self, host] : d.graph().pairs("host")) {
    CHECK(features[self.index()].host == host);
    CHECK(holds(d, "contains", host, self));
  }
  for (const auto& [outer, inner] : d.graph().pairs("contains"))
    for (const FeatureId deeper : d.graph().others("contains", inner))
      CHECK(holds(d, "contains", outer, deeper));
  for (const FeatureId id : test::all_features(d.segmented.segmentation)) {
    std::size_t companions = 1;
    for (const FeatureId other : d.graph().others("same_facade", id))
      companions += features[other.index()].sense == features[id.index()].sense ? 1 : 0;
    if (d.has(id, "per_facade"))
      CHECK(d.number(id, "per_facade") == static_cast<double>(companions));
    CHECK(d.has(id, "per_facade") == features[id.index()].host_facet.has_value());
    if (d.has(id, "storey"))
      CHECK(d.number(id, "per_storey") ==
            static_cast<double>(d.graph().others("same_storey", id).size() + 1));
  }
}

TEST_SUITE("kernel/describe") {
  TEST_CASE("windows of one size near each other on one wall are alike") {
    const Described d = facade();
    const FeatureId low = d.at({1, 0, 1}, {2.2, 0.2, 2.5}),
                    right = d.at({3, 0, 1}, {4.2, 0.2, 2.5});
    const FeatureId high = d.at({1, 0, 3.4}, {2.2, 0.2, 4.9});
    const FeatureId wide = d.at({12, 0, 1}, {15, 0.2, 2.5});
    const FeatureId side = d.at({0, 3, 1}, {0.2, 4.2, 2.5});
    CHECK(pairs(d, "alike").size() == 4 * 3);
    CHECK(holds(d, "alike", low, right));
    CHECK(holds(d, "alike", low, high));
    CHECK_FALSE(holds(d, "alike", low, wide));
    CHECK_FALSE(holds(d, "alike", low, side));
  }

  TEST_CASE("beside is next to at the same height and above is over it on the same wall") {
    const Described d = facade();
    const FeatureId low = d.at({1, 0, 1}, {2.2, 0.2, 2.5}),
                    right = d.at({3, 0, 1}, {4.2, 0.2, 2.5});
    const FeatureId high = d.at({1, 0, 3.4}, {2.2, 0.2, 4.9});
    CHECK(pairs(d, "beside").size() == 4);
    CHECK(holds(d, "beside", low, right));
    CHECK_FALSE(holds(d, "beside", low, high));
    CHECK(pairs(d, "above").size() == 2);
    CHECK(holds(d, "above", low, high));
    CHECK_FALSE(holds(d, "above", high, low));
  }

  TEST_CASE("facades are walls and storeys go round the house") {
    const Described d = facade();
    const FeatureId low = d.at({1, 0, 1}, {2.2, 0.2, 2.5});
    const FeatureId high = d.at({1, 0, 3.4}, {2.2, 0.2, 4.9});
    const FeatureId side = d.at({0, 3, 1}, {0.2, 4.2, 2.5});
    CHECK(pairs(d, "same_facade").size() == 5 * 4);
    CHECK_FALSE(holds(d, "same_facade", low, side));
    CHECK(holds(d, "same_storey", low, side));
    CHECK_FALSE(holds(d, "same_storey", low, high));
    CHECK(pairs(d, "same_storey").size() == 4 * 3 + 2 * 1);
    CHECK(pairs(d, "host").empty());
    CHECK(pairs(d, "contains").empty());
  }

  TEST_CASE("a dormer hosts its window and contains it") {
    const Described d = described(test::dormer_with_window());
    CHECK(pairs(d, "host") == Pairs{{FeatureId{1}, FeatureId{0}}});
    CHECK(pairs(d, "contains") == Pairs{{FeatureId{0}, FeatureId{1}}});
  }

  TEST_CASE("containment reaches through every level") {
    const Described d = described(BoxBody()
                                      .add({0, 0, 0}, {20, 20, 10})
                                      .remove({2, 2, 5}, {18, 18, 10})
                                      .add({4, 4, 5}, {16, 16, 9})
                                      .remove({5, 5, 7}, {15, 15, 9})
                                      .build());
    const FeatureId pit = d.at({2, 2, 5}, {18, 18, 10}), block = d.at({4, 4, 5}, {16, 16, 9}),
                    inner = d.at({5, 5, 7}, {15, 15, 9});
    CHECK(holds(d, "contains", pit, block));
    CHECK(holds(d, "contains", block, inner));
    CHECK(holds(d, "contains", pit, inner));
    CHECK(pairs(d, "contains").size() == 3);
    check_graph(d);
  }

  TEST_CASE("relations are well formed on every body and sample") {
    for (const auto& [name, make] : test::bodies()) {
      CAPTURE(std::string(name));
      check_graph(described(make()));
    }
    for (const Building& building : test::samples().buildings) {
      CAPTURE(building.id);
      check_graph(described(building));
    }
  }
}

}  // namespace
}  // namespace oriel
