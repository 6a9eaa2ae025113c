#include "oriel/oriel.h"
#include "tests/support/changed.h"
#include "tests/support/flush.h"
#include "tests/support/houses.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
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

/// What building and its levels come to, drawn at 1:2500 within a budget.
GeneralisedBuilding drawn_within(const Document& document, std::int64_t budget) {
  GeneraliseOptions options;
  const Building& building = document.buildings.at(0);
  const PipelineResult result = label(building, residential_rules(), options);
  options.budget = budget;
  return generalise(document, building, result, residential_rules(), at_scale(2500), options);
}

bool has_code(const std::vector<Issue>& issues, Code code) {
  return std::ranges::find(issues, code, &Issue::code) != issues.end();
}

Document document_of(Building building) {
  Document document;
  document.buildings.push_back(std::move(building));
  return document;
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
    // Without a feature there is nothing to describe: some are found within less than it takes.
    const auto uses_up_describing = [](std::int64_t budget) {
      return std::ranges::any_of(bodies_of_all_kinds(), [&](const Building& building) {
        return says(labelled_within(building, budget), "describing");
      });
    };
    CHECK((uses_up_describing(100) || uses_up_describing(1000) || uses_up_describing(10'000)));
    CHECK(says(labelled_within(rough(), 1), "solidifying"));
    CHECK(says(labelled_within(opened(test::full_house()), 1), "finding rings"));
    CHECK(says(labelled_within(test::block_with_door(), 1), "finding imprints"));
  }

  TEST_CASE("enough of a budget is used up by no stage") {
    for (const Building& building : bodies_of_all_kinds())
      CHECK(stages_used_up(labelled_within(building, kWorkBudget)).empty());
  }

  TEST_CASE("a building is drawn as far as the budget goes and stays closed") {
    const Document document = document_of(test::full_house());
    for (const std::int64_t budget : {1, 10'000, 300'000, 3'000'000}) {
      CAPTURE(budget);
      const GeneralisedBuilding drawn = drawn_within(document, budget);
      REQUIRE(drawn.levels.size() == 1);
      if (drawn.levels[0].labelled.geometry) CHECK(is_closed(*drawn.levels[0].labelled.geometry));
      if (budget == 1) {
        CHECK(has_code(drawn.issues, Code::E502));
        CHECK(drawn.levels[0].removed.empty());
      }
    }
    const GeneralisedBuilding whole = drawn_within(document, kWorkBudget);
    CHECK(!has_code(whole.issues, Code::E502));
    CHECK(!whole.levels.at(0).removed.empty());
  }

  TEST_CASE("the slow inputs of the shared data use up their budget and end") {
    ORIEL_NEEDS_SHARED(shared);
    const std::filesystem::path faults = shared / "data" / "faults";
    // What each stage counts bounds it, so a tenth of the budget is a tenth of the time.
    constexpr std::int64_t kTenth = kWorkBudget / 10;
    for (const std::string file : {"slow-repair.obj", "slow-generalise.city.jsonl"}) {
      CAPTURE(file);
      const std::vector<Document> records = read((faults / file).string()).value.value();
      for (const Document& document : records) {
        if (document.buildings.empty()) continue;
        LabelOptions options;
        options.budget = kTenth;
        const Building& building = document.buildings.at(0);
        PipelineOptions repairing = repair_defaults();
        repairing.budget = kTenth;
        const Repaired repaired = repair(document, building, repairing);
        CHECK((repaired.solid || has_code(repaired.issues, Code::E502)));
        const PipelineResult result = label(building, residential_rules(), options);
        REQUIRE(result.is_done());
        GeneraliseOptions drawing;
        drawing.budget = kTenth;
        const auto drawn =
            generalise(document, building, result, residential_rules(), at_scale(2500), drawing);
        CHECK((drawn.levels.size() == 1 || has_code(drawn.issues, Code::G413)));
        CHECK((has_code(result.issues, Code::E502) || has_code(drawn.issues, Code::E502)));
        SeriesOptions in_series;
        in_series.budget = kTenth;
        const Series made =
            series(document, {result}, residential_rules(), {500, 2500, 10000}, in_series);
        CHECK(!has_code(made.issues, Code::E901));
      }
    }
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
