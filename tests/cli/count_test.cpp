#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <array>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using oriel::test::Folder;
using oriel::test::Outcome;
using oriel::test::run;
using Four = std::array<int, 4>;

namespace {

std::string figure_5() {
  return std::string(ORIEL_SOURCE_DIR) + "/examples/samples/figure5.city.json";
}

nlohmann::json json_of(const Outcome& outcome) {
  CHECK(outcome.exit == 0);
  return nlohmann::json::parse(outcome.out);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("the sample of figure 5 has the planes and combinations and parts of the paper") {
    const nlohmann::json counted =
        json_of(run({"segment", figure_5(), "--count-as-paper", "--json", "--budget", "1000000"}));
    const nlohmann::json& paper = counted["heuristics"][0];
    CHECK(paper["name"] == "paper");
    CHECK(paper["is_used_up"] == false);
    CHECK(paper["leaves"] == 19);
    CHECK(paper["inner"] == 8);
    REQUIRE(paper["recursions"].size() == 27);
    const nlohmann::json& first = paper["recursions"][0];
    CHECK(first["planes"] == 34);
    CHECK(first["combinations"] == Four{34, 561, 5984, 46376});
    CHECK(first["tested"] == Four{34, 0, 0, 0});
    CHECK(first["found"] == "protrusion");
    CHECK(first["value"].get<double>() == doctest::Approx(0.003).epsilon(0.01));
    for (const nlohmann::json& order : counted["oriel"]) {
      CHECK(order["leaves"] == 19);
      CHECK(order["inner"] == 8);
      CHECK(order["hole_tests"] < paper["hole_tests"]);
    }
  }

  TEST_CASE("counts that use up their budget are marked and warned of") {
    const Outcome text = run({"segment", figure_5(), "--count-as-paper", "--budget", "1000000"});
    CHECK(text.exit == 0);
    CHECK(text.out.starts_with("figure5: 34 planes\n"));
    CHECK(text.out.find("brute force (budget)") != std::string::npos);
    CHECK(text.out.find("paper (budget)") == std::string::npos);
    CHECK(text.says("E502 counting as the paper does used up the work budget of 2000000 steps"));
  }

  TEST_CASE("of an open building nothing is counted and of others it is") {
    const Folder folder;
    auto city = oriel::test::cubes({"a", "b"});
    city["CityObjects"]["a"]["geometry"][0]["boundaries"][0].erase(1);  // its roof
    const std::string in = folder.write("open.city.json", city.dump());
    const Outcome outcome = run({"segment", in, "--count-as-paper"});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("error: a: E302 has no planes to count"));
    CHECK(outcome.out.starts_with("b: 6 planes"));
  }

  TEST_CASE("the same counts come at any number of jobs") {
    const std::string other = oriel::test::sample("house");
    const auto counted = [&](const std::string& jobs) {
      return run({"segment", figure_5(), other, "--count-as-paper", "--json", "--budget", "300000",
                  "-j", jobs})
          .out;
    };
    CHECK(counted("1") == counted("2"));
  }
}
