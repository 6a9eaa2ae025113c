#include "oriel/oriel.h"
#include "tests/cli/command.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using oriel::test::bytes_of;
using oriel::test::Folder;
using oriel::test::sample;

namespace {

std::vector<Document> records_of(const std::string& name) {
  return read(sample(name)).value.value();
}

const RuleBase& residential() {
  static const RuleBase rules = load_pack_file("residential").value.value();
  return rules;
}

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("reading a file that is not there throws E101") {
    try {
      read("/no/such/file.city.json");
      FAIL("nothing was thrown");
    } catch (const InputError& error) {
      CHECK(error.issue().code == Code::E101);
    }
  }

  TEST_CASE("a building that cannot be a solid is rejected with an error and without output") {
    Document document;
    Building& building = document.buildings.emplace_back();
    building.id = "nothing";
    const PipelineResult result = label(building, residential());
    CHECK(!result.is_done());
    CHECK(has_errors(result.issues));
    CHECK(result.output.building.empty());
    CHECK(generalise(document, building, result, residential(), at_scale(1000)).levels.empty());
    CHECK(!repair(document, building).solid);
  }

  TEST_CASE("the observer hears of every stage and changes nothing") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    std::set<Stage> stages;
    LabelOptions options;
    options.observer = [&](Stage stage, double ms) {
      CHECK(ms >= 0);
      stages.insert(stage);
    };
    OutputRecord quiet, observed;
    add(label(building, residential()).output, quiet);
    add(label(building, residential(), options).output, observed);
    CHECK(stages == std::set{Stage::solidify, Stage::segment, Stage::describe, Stage::interpret});
    CHECK(write(records[0], quiet) == write(records[0], observed));
  }

  TEST_CASE("output that is made later is that of label") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    LabelOptions later;
    later.has_output = false;
    const PipelineResult result = label(building, residential(), later);
    CHECK(result.output.building.empty());
    OutputRecord at_once, made_later;
    add(label(building, residential()).output, at_once);
    add(annotate(building, result, residential(), later), made_later);
    CHECK(write(records[0], at_once) == write(records[0], made_later));
  }

  TEST_CASE("a feature is found by the beginning of its id and explained") {
    const auto records = records_of("house");
    const Building& building = records[0].buildings.at(0);
    LabelOptions options;
    options.measures_surfaces = true;
    const PipelineResult result = label(building, residential(), options);
    CHECK(find_features(result, "").size() == result.description.table.rows());
    const auto found = find_features(result, result.description.table.id(FeatureId{0}));
    REQUIRE(found.size() == 1);
    const Explanation why = explain(result, residential(), found[0]);
    CHECK(why.feature == result.description.table.id(FeatureId{0}));
    CHECK(explain_surface(building, result, residential(), 0).starts_with(building.id));
  }

  TEST_CASE("a name that says no format is refused with E106") {
    const auto records = records_of("house");
    const Folder folder;
    for (const char* name : {"house.txt", "house.gml", "house.city.jsonl"}) {
      CAPTURE(name);
      CHECK_THROWS_AS(write(folder / name, records, std::vector<OutputRecord>(1)), InputError);
    }
    CHECK(folder.names().empty());
  }

  TEST_CASE("what nothing is added to is written as it was read") {
    const auto records = records_of("house");
    const Folder folder;
    write(folder / "same.city.json", records, std::vector<OutputRecord>(1));
    CHECK(bytes_of(folder / "same.city.json") == bytes_of(sample("house")));
  }
}
