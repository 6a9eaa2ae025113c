#include "oriel/oriel.h"
#include "tests/support/changed.h"
#include "tests/support/flush.h"
#include "tests/support/houses.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace oriel;

namespace {

const RuleBase& residential_rules() {
  static const RuleBase rules = load_pack_file("residential").value.value();
  return rules;
}

PipelineResult labelled_within(const Building& building, std::int64_t budget) {
  LabelOptions options;
  options.budget = budget;
  return label(building, residential_rules(), options);
}

/// Without its first polygon.
Building opened(Building building) {
  building.polygons.erase(building.polygons.begin());
  return building;
}

/// Triangles with noise, which are put together before anything else.
Building rough() { return test::with_noise(test::in_triangles(test::plain_block()), 0.0015, 1); }

/// Bodies that between them pass all stages.
const std::vector<Building>& bodies_of_all_kinds() {
  static const std::vector<Building> bodies{
      test::full_house(),      opened(test::full_house()),        test::block_with_sashes(),
      test::block_with_door(), opened(test::block_with_sashes()), rough(),
      opened(rough()),         test::niche_over_an_edge(),        test::cavity_and_lumps()};
  return bodies;
}

/// The stages that say that they have used up their budget.
std::vector<std::string> stages_used_up(const PipelineResult& result) {
  std::vector<std::string> stages;
  for (const Issue& issue : result.issues)
    if (issue.code == Code::E502)
      stages.push_back(issue.sentence.substr(0, issue.sentence.find(" used up")));
  return stages;
}

bool says(const PipelineResult& result, const std::string& stage) {
  const auto stages = stages_used_up(result);
  return std::ranges::find(stages, stage) != stages.end();
}

bool has_fault_of_its_own(const PipelineResult& result) {
  return std::ranges::find(result.issues, Code::E901, &Issue::code) != result.issues.end();
}

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("any budget ends with the labels so far and never with a fault of its own") {
    CHECK(rc::check([] {
      const auto& bodies = bodies_of_all_kinds();
      const Building& building =
          bodies[static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(bodies.size())))];
      // As many digits are as likely as any other number of them.
      const int digits = *rc::gen::inRange(0, 7);
      std::int64_t budget = *rc::gen::inRange(1, 10);
      for (int i = 0; i < digits; ++i) budget *= 10;
      const PipelineResult result = labelled_within(building, budget);
      RC_ASSERT(!has_fault_of_its_own(result));
      RC_ASSERT(result.has_surfaces());
      if (result.is_done())
        RC_ASSERT(result.interpretation.verdicts.size() == result.segmentation->features.size());
      // Work is counted, so it ends at the same place.
      const PipelineResult again = labelled_within(building, budget);
      RC_ASSERT(stages_used_up(again) == stages_used_up(result));
      RC_ASSERT(again.interpretation.verdicts.size() == result.interpretation.verdicts.size());
    }));
  }

  TEST_CASE("every stage whose budget is used up says so by its name") {
    CHECK(says(labelled_within(test::full_house(), 1), "segmenting"));
    CHECK(says(labelled_within(test::full_house(), 1), "describing"));
    CHECK(says(labelled_within(rough(), 1), "solidifying"));
    CHECK(says(labelled_within(opened(test::full_house()), 1), "finding rings"));
    CHECK(says(labelled_within(test::block_with_door(), 1), "finding imprints"));
  }

  TEST_CASE("enough of a budget is used up by no stage") {
    for (const Building& building : bodies_of_all_kinds())
      CHECK(stages_used_up(labelled_within(building, kWorkBudget)).empty());
  }

  TEST_CASE("what a stage found before its budget was used up is labelled") {
    for (const std::int64_t budget : {1'000, 2'000, 5'000}) {
      const PipelineResult part = labelled_within(test::full_house(), budget);
      REQUIRE(part.is_done());
      CHECK(part.interpretation.verdicts.size() == part.segmentation->features.size());
    }
    CHECK(!labelled_within(test::full_house(), 5'000).segmentation->features.empty());
  }
}
