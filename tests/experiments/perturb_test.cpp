#include "experiments/perturb.h"

#include "oriel/oriel.h"
#include "tests/cli/command.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <map>
#include <string>

#include <doctest/doctest.h>

using namespace oriel;
using oriel::test::sample;

namespace {

Building sample_building(const std::string& name) {
  return read(sample(name)).value.value().at(0).buildings.at(0);
}

/// True if no corner is farther off than a tenth of a millimetre along any axis.
bool is_near(const Box& a, const Box& b) {
  const auto is_near_point = [](Vec3 p, Vec3 q) { return length(p - q) < 1e-4; };
  return is_near_point(a.min, b.min) && is_near_point(a.max, b.max);
}

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("features of a turned building stand where they stood before") {
    // No two of its cuts have the same value, so their order does not change as it is turned.
    const Building house = test::BoxBody()
                               .add({0, 0, 0}, {10, 8, 6})
                               .add({1, 2, 6}, {1.5, 2.6, 7})
                               .remove({4, 0, 1}, {5, 0.2, 2.5})
                               .remove({6, 0, 1}, {8, 0.2, 2.5})
                               .remove({7, 0, 3}, {7.3, 0.2, 4})
                               .build();
    const PipelineResult found = segment(house);
    REQUIRE(found.is_done());
    const std::vector<Box> expected = boxes_before(found, {house, {}, {}});
    Perturbation perturbation;
    perturbation.rotation_deg = 37;
    perturbation.shift_m = {100, -20.5, 3};
    const Perturbed turned = perturbed(house, perturbation);
    const PipelineResult again = segment(turned.building);
    REQUIRE(again.is_done());
    const std::vector<Box> boxes = boxes_before(again, turned);
    CHECK(boxes.size() == 4);
    CHECK(boxes.size() == expected.size());
    for (const Box& box : boxes)
      CHECK(std::ranges::any_of(expected, [&](const Box& other) { return is_near(box, other); }));
  }

  TEST_CASE("boxes of what was not moved are those of the records") {
    const Building house = sample_building("house");
    Perturbation perturbation;
    perturbation.noise_m = 0.001;
    const Perturbed shaken = perturbed(house, perturbation);
    const PipelineResult found = segment(shaken.building);
    REQUIRE(found.is_done());
    const std::vector<Box> boxes = boxes_before(found, shaken);
    std::map<std::string, std::array<double, 6>> by_id;
    for (const FeatureRecord& record : feature_records(shaken.building, found))
      by_id[record.id] = record.aabb_m;
    REQUIRE(boxes.size() == by_id.size());
    for (int i = 0; i < std::ssize(boxes); ++i) {
      const Box& box = boxes[static_cast<std::size_t>(i)];
      const std::array<double, 6> numbers{box.min.x, box.min.y, box.min.z,
                                          box.max.x, box.max.y, box.max.z};
      CHECK(by_id.at(found.description.table.id(FeatureId{i})) == numbers);
    }
  }
}
