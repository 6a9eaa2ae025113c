#include "oriel/stored_samples.h"

#include "experiments/experiment.h"
#include "oriel/oriel.h"
#include "tests/cli/command.h"

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using oriel::test::Folder;

namespace {

const RuleBase& pack_of_samples() {
  static const RuleBase rules = load_pack_file("residential").value.value();
  return rules;
}

/// Records of a feature each of these buildings, in unit boxes.
std::string stored_parts(const std::vector<std::string>& buildings) {
  std::string text = "building,id,aabb_m\n";
  for (const std::string& id : buildings) text += id + ",f1,0;0;0;1;1;1\n";
  return text;
}

/// A truth of one window.
std::string window_in(const std::string& building) {
  return R"({"building": ")" + building +
         R"(", "objects": [{"id": "w", "class": "window", "aabb": [0,0,0,1,1,1], "faces": [0]}]})";
}

std::vector<std::string> codes_of(const std::vector<Issue>& issues) {
  std::vector<std::string> codes;
  for (const Issue& issue : issues) codes.push_back(to_string(issue.code));
  std::ranges::sort(codes);
  return codes;
}

}  // namespace

TEST_SUITE("experiments") {
  TEST_CASE("samples are joined with their truth by the ids of their buildings") {
    const Folder folder;
    const std::vector<std::string> records{folder.write("parts.csv", stored_parts({"b", "a"}))};
    const std::vector<std::string> truths{folder.write("b.truth.json", window_in("b")),
                                          folder.write("c.truth.json", window_in("c"))};
    const auto samples = read_samples(records, truths, pack_of_samples());
    REQUIRE(samples.value);
    REQUIRE(samples.value->size() == 2);
    const Sample &b = samples.value->front(), &c = samples.value->back();
    CHECK(b.features.table.building() == "b");
    REQUIRE(b.boxes.size() == 1);
    CHECK(b.boxes[0].max.x == 1);
    CHECK(b.truth.size() == 1);
    CHECK(c.features.table.building() == "c");
    CHECK(c.features.table.rows() == 0);
    CHECK(c.truth.size() == 1);
    // There is no truth of a, no feature of c, and few columns.
    CHECK(codes_of(samples.issues) == std::vector<std::string>{"E151", "R284", "R284"});
  }

  TEST_CASE("features at hand are joined with truth as stored ones are") {
    const Folder folder;
    const std::vector<std::string> records{folder.write("parts.csv", stored_parts({"b", "a"}))};
    const auto truth = read_truths(folder.write("b.truth.json", window_in("b"))).value.value();
    std::vector<Issue> issues;
    const auto at_hand = join_samples(read_stored_samples(records[0], nullptr, issues), truth);
    const auto stored = read_samples(records, truth, pack_of_samples());
    REQUIRE(at_hand.value);
    REQUIRE(stored.value);
    REQUIRE(at_hand.value->size() == 1);
    CHECK(at_hand.value->front().features.table.building() == "b");
    CHECK(at_hand.value->front().truth.size() == stored.value->front().truth.size());
    CHECK(codes_of(at_hand.issues) == std::vector<std::string>{"R284"});
    const auto twice = join_samples(read_stored_samples(records[0], nullptr, issues),
                                    std::vector{truth[0], truth[0]});
    CHECK_FALSE(twice.value);
    CHECK(codes_of(twice.issues) == std::vector<std::string>{"R284", "R284"});
  }

  TEST_CASE("records without boxes are reported as nothing is found with them") {
    const Folder folder;
    std::vector<Issue> issues;
    const auto samples = read_stored_samples(folder.write("p.csv", "building,id\na,f1\n"),
                                             &pack_of_samples(), issues);
    CHECK(samples.size() == 1);
    CHECK(std::ranges::any_of(issues, [](const Issue& issue) {
      return issue.code == Code::E151 && issue.sentence.find("aabb_m") != std::string::npos;
    }));
  }

  TEST_CASE("a building at the end of one file and the start of the next is there twice") {
    const Folder folder;
    const std::vector<std::string> records{folder.write("1.csv", stored_parts({"a", "b"})),
                                           folder.write("2.csv", stored_parts({"b", "c"}))};
    const std::vector<std::string> truths{folder.write("b.truth.json", window_in("b"))};
    const auto samples = read_samples(records, truths, pack_of_samples());
    CHECK(!samples.value);
    CHECK(std::ranges::count(codes_of(samples.issues), "R284") == 2);
    folder.write("e.yaml",
                 "schema: oriel-experiment/1\nname: t\nsets: {s: {features: '*.csv', truth: "
                 "b.truth.json}}\nrules: residential\nablate: rules\n");
    const auto plan = load_experiment_file(folder / "e.yaml");
    REQUIRE(plan.value);
    CHECK(std::ranges::count(codes_of(check_experiment(*plan.value)), "R289") == 1);
  }
}
