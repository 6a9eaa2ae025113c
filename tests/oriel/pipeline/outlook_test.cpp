#include "kernel/neighbours/neighbours.h"
#include "oriel/label.h"
#include "oriel/rules.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using oriel::test::BoxBody;

namespace {

/// A house with a window in its right wall and one in its left, and a neighbour to the right.
std::vector<oriel::Building> pair_of_houses() {
  oriel::Building house = BoxBody()
                              .add({0, 0, 0}, {10, 8, 6})
                              .remove({9.8, 3, 2}, {10, 4.2, 3.4})
                              .remove({0, 3, 2}, {0.2, 4.2, 3.4})
                              .build();
  house.id = "house";
  oriel::Building neighbour = BoxBody().add({0, 0, 0}, {10, 8, 6}).build();
  neighbour.id = "neighbour";
  neighbour.frame.origin_m = {10, 0, 0};
  return {house, neighbour};
}

std::shared_ptr<const oriel::NeighbourSearch> search_of(const std::vector<oriel::Building>& all) {
  auto search = std::make_shared<oriel::NeighbourSearch>();
  for (const oriel::Building& building : all) search->add(building);
  search->finish();
  return search;
}

oriel::PipelineResult labelled(bool knows_neighbours) {
  const auto all = pair_of_houses();
  oriel::LabelOptions options;
  if (knows_neighbours) options.neighbours = search_of(all);
  return oriel::label(all[0], *oriel::load_pack_file("residential").value, options);
}

std::ptrdiff_t windows(const oriel::PipelineResult& result) {
  return std::ranges::count(result.interpretation.verdicts, "window", &oriel::Verdict::label);
}

/// The value at the feature whose box begins at this x.
std::optional<double> number_at(const oriel::PipelineResult& result, double x,
                                oriel::Attribute attribute) {
  const auto& features = result.segmentation->features;
  for (std::size_t i = 0; i < features.size(); ++i)
    if (std::abs(features[i].box.min.x - x) < 0.01)
      return result.description.table.number(oriel::FeatureId{static_cast<int>(i)}, attribute);
  return std::nullopt;
}

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("nobody looks out of a party wall") {
    CHECK(windows(labelled(false)) == 2);
    CHECK(windows(labelled(true)) == 1);
  }

  TEST_CASE("features say whether they are in a party wall and look at the street") {
    using enum oriel::Attribute;
    const auto result = labelled(true);
    CHECK(number_at(result, 9.8, party_wall) == 1);
    CHECK(number_at(result, 9.8, exposed) == doctest::Approx(0));
    CHECK(number_at(result, 9.8, faces_street).value_or(0) == 0);
    CHECK(number_at(result, 0, party_wall) == 0);
    CHECK(number_at(result, 0, exposed) == 1);
    CHECK(number_at(result, 0, faces_street) == 1);
    CHECK(number_at(result, 0, faces_yard) == 0);
  }

  TEST_CASE("without neighbours nothing is known of them") {
    using enum oriel::Attribute;
    const auto result = labelled(false);
    for (const oriel::Attribute attribute : {party_wall, exposed, faces_street, faces_yard})
      CHECK_FALSE(number_at(result, 0, attribute));
    CHECK_FALSE(result.surroundings);
  }

  TEST_CASE("what is written depends on the neighbours that were looked at") {
    const auto all = pair_of_houses();
    oriel::LabelOptions with, alone;
    with.neighbours = search_of(all);
    alone.neighbours = search_of({all[0]});
    CHECK(oriel::configuration(with) != oriel::configuration(alone));
  }
}
