#include "experiments/plan/experiment_plan.h"
#include "experiments/plan/plan_grammar.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel;

namespace {

namespace fs = std::filesystem;

const fs::path kProject = ORIEL_SOURCE_DIR;

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// An experiment with one set and these sections besides.
std::string experiment_with(const std::string& sections, const std::string& rules = "residential") {
  return "schema: oriel-experiment/1\nname: t\nsets: {houses: {models: a.city.json, truth: "
         "a.truth.json}}\nrules: " +
         rules + "\n" + sections;
}

/// The keys that the loader names where it finds the key `zzzzzz`.
std::set<std::string> keys_of_loader(const std::string& text) {
  std::set<std::string> keys;
  for (const Issue& issue : load_experiment(text, "t.yaml").issues) {
    const std::size_t at = issue.sentence.find("(keys: ");
    if (issue.code != Code::R209 || at == std::string::npos) continue;
    std::string list = issue.sentence.substr(at + 7);
    list.back() = ',';
    while (!list.empty()) {
      keys.insert(list.substr(0, list.find(',')));
      list.erase(0, list.find(',') + 1);
      list.erase(0, list.find_first_not_of(' '));
    }
  }
  return keys;
}

std::set<std::string> keys_of_schema(const std::string& path) {
  static const auto schema = nlohmann::json::parse(plan_grammar().schema());
  std::set<std::string> keys;
  for (const auto& property : schema.at(nlohmann::json::json_pointer(path)).items())
    keys.insert(property.key());
  return keys;
}

ExperimentPlan plan_of(const std::string& sections) {
  const auto checked = load_experiment(experiment_with(sections), "t.yaml");
  for (const Issue& issue : checked.issues) FAIL_CHECK(to_string(issue));
  REQUIRE(checked.value);
  return *checked.value;
}

const SweptParam& swept(const ExperimentPlan& plan, std::size_t at) {
  REQUIRE(plan.sweep);
  REQUIRE(plan.sweep->params.size() > at);
  return plan.sweep->params[at];
}

}  // namespace

TEST_SUITE("experiments/plan") {
  TEST_CASE("every wrong experiment is refused with the message that stands beside it") {
    std::set<std::string> codes;
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(kProject / "tests/data/experiments")) {
      if (entry.path().extension() != ".yaml") continue;
      ++files;
      CAPTURE(entry.path().string());
      const auto checked =
          load_experiment(text_of_file(entry.path()), entry.path().filename().string());
      CHECK_FALSE(checked.value);
      std::string printed;
      for (const Issue& issue : checked.issues) {
        printed += to_string(issue) + "\n";
        codes.insert(to_string(issue.code));
      }
      auto expected = entry.path();
      expected.replace_extension(".txt");
      if (std::getenv("ORIEL_REWRITE_EXPERIMENTS") != nullptr) std::ofstream(expected) << printed;
      CHECK(printed == text_of_file(expected));
    }
    CHECK(files >= 12);
    for (const char* code : {"R200", "R201", "R206", "R209", "R210", "R211", "R212", "R213", "R231",
                             "R230", "R281", "R287"})
      CHECK_MESSAGE(codes.contains(code), code);
  }

  TEST_CASE("the experiments that are shipped load without findings") {
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(kProject / "examples/experiments")) {
      if (entry.path().extension() != ".yaml") continue;
      ++files;
      const auto checked = load_experiment_file(entry.path().string());
      for (const Issue& issue : checked.issues) FAIL_CHECK(to_string(issue));
    }
    CHECK(files >= 2);
  }

  TEST_CASE("values of a sweep go from end to end of a range") {
    const ExperimentPlan plan = plan_of(
        "sweep: {params: {widest_window: 3 m .. 400 cm, step: [0.3 m, 50 cm]}, values: 3}\n");
    CHECK(swept(plan, 0).values == std::vector<double>{3, 3.5, 4});
    CHECK(swept(plan, 0).unit == "m");
    CHECK(swept(plan, 1).values == std::vector<double>{0.3, 0.5});
  }

  TEST_CASE("all params of a pack are those that have a range") {
    const ExperimentPlan plan = plan_of("sweep: {params: all, values: 2}\n");
    const auto params = params_of(*plan.rules.base);
    std::size_t ranges = 0;
    for (const PackParam& param : params) {
      if (!param.range) continue;
      const SweptParam& found = swept(plan, ranges++);
      CHECK(found.name == param.name);
      CHECK(found.values.front() == doctest::Approx(param.range->first).epsilon(1e-9));
      CHECK(found.values.back() == doctest::Approx(param.range->second).epsilon(1e-9));
    }
    CHECK(ranges == plan.sweep->params.size());
    CHECK(ranges > 20);
  }

  TEST_CASE("what a compared entry does not say is as in the experiment") {
    const ExperimentPlan plan = plan_of(
        "options: {weld: 2 mm}\ncompare: {paper: {order: paper}, wide: {params: {step: 0.5 m}}}\n");
    REQUIRE(plan.compare.size() == 2);
    CHECK(plan.compare[0].rules.pack == "residential");
    CHECK(plan.options.with(plan.compare[0].options).weld_m == 0.002);
    CHECK(plan.options.with(plan.compare[0].options).order == "paper");
    CHECK(plan.compare[1].options.is_empty());
    CHECK(plan.compare[1].rules.params == std::vector<ParamValue>{{"step", 0.5}});
  }

  TEST_CASE("a compared entry replaces a param that the experiment sets") {
    const auto checked = load_experiment(
        experiment_with("compare: {wide: {params: {step: 0.5 m}}}\n",
                        "{pack: residential, params: {step: 0.4 m, narrowest: 0.3 m}}"),
        "t.yaml");
    REQUIRE(checked.value);
    CHECK(checked.value->compare[0].rules.params ==
          std::vector<ParamValue>{{"step", 0.5}, {"narrowest", 0.3}});
    const RulesPlan& rules = checked.value->compare[0].rules;
    CHECK(with_params(*rules.base, rules.params).value);
  }

  TEST_CASE("disturbances are named by their amount and its unit") {
    const ExperimentPlan plan = plan_of(
        "stability: {noise: [5 mm, 2 cm], triangulation: true, missing_faces: 5 %, tolerances: "
        "{coplanar: 1 deg}}\n");
    std::vector<std::string> names;
    for (const DisturbancePlan& disturbance : plan.stability->disturbances)
      names.push_back(disturbance.name);
    CHECK(names == std::vector<std::string>{"noise = 0.005 m", "noise = 0.02 m", "triangulation",
                                            "missing_faces = 5 %", "coplanar = 1 deg"});
  }

  TEST_CASE("the schema has the keys that are read") {
    const std::string set = "schema: oriel-experiment/1\nname: t\nsets: {s: {zzzzzz: 1}}\n";
    CHECK(keys_of_loader("zzzzzz: 1\n") == keys_of_schema("/properties"));
    CHECK(keys_of_loader(set) == keys_of_schema("/definitions/set/properties"));
    CHECK(keys_of_loader(experiment_with("options: {zzzzzz: 1}\n")) ==
          keys_of_schema("/properties/options/properties"));
    CHECK(keys_of_loader(experiment_with("", "{zzzzzz: 1}")) ==
          keys_of_schema("/definitions/rules/properties"));
    CHECK(keys_of_loader(experiment_with("compare: {a: {zzzzzz: 1}}\n")) ==
          keys_of_schema("/definitions/compared/properties"));
    CHECK(keys_of_loader(experiment_with("stability: {tolerances: {zzzzzz: 1}}\n")) ==
          keys_of_schema("/definitions/stability/properties/tolerances/properties"));
    for (const char* part : {"sweep", "stability", "learn", "learning_curve"})
      CHECK(keys_of_loader(experiment_with(fmt::format("{}: {{zzzzzz: 1}}\n", part))) ==
            keys_of_schema(fmt::format("/definitions/{}/properties", part)));
  }

  TEST_CASE("a pack is a file beside the experiment") {
    const auto checked = load_experiment(experiment_with("ablate: rules\n", "first_pack.yaml"),
                                         (kProject / "examples/t.yaml").string());
    REQUIRE(checked.value);
    CHECK(checked.value->rules.base->file() == (kProject / "examples/first_pack.yaml").string());
  }
}
