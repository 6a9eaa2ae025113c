#include "tests/cli/command.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

TEST_SUITE("cli") {
  TEST_CASE("rules attributes lists names with unit example and meaning") {
    const Outcome outcome = run({"rules", "attributes"});
    CHECK(outcome.exit == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.starts_with("of features:\n\nattribute "));
    CHECK(outcome.out.find(
              "\ndepth             m       depth in 0.5 m .. 2 m                  extent along the "
              "normal of the host's facet\n") != std::string::npos);
    CHECK(outcome.out.find("\nof surfaces:\n\nattribute ") != std::string::npos);
  }

  TEST_CASE("one name is shown with all that is known of it") {
    CHECK(
        run({"rules", "attributes", "slope"})
            .out.starts_with("inclination (attribute of features)\n"
                             "  meaning      slope of the largest cap: 0 horizontal, 90 vertical, "
                             "above 90 facing down\n"
                             "  unit         deg\n"
                             "  example      inclination in 75 deg .. 105 deg\n"
                             "  also called  slope, pitch, tilt, gradient, steepness, angle\n"));
    CHECK(run({"rules", "operators", "typify"}).out ==
          "typify (operator of generalisation)\n"
          "  meaning      replaces the recesses of a row with fewer ones\n"
          "  example      {typify: {ratio: 50 %, gap: 0.5 mm@map}}\n"
          "  in a pack    generalise: [{id: mine, for: window, scale: \"1:1000 ..\", "
          "do: {typify: {ratio: 50 %, gap: 0.5 mm@map}}}]\n"
          "  argument     ratio: the share that stays (a ratio)\n"
          "  argument     gap: the least distance to neighbours (a length)\n"
          "  also called  select, thin, reduce, typification\n");
    const Outcome unknown = run({"rules", "relations", "besides"});
    CHECK(unknown.exit == 2);
    CHECK(unknown.err == "there is no relation 'besides'; did you mean 'beside'?\n");
  }

  TEST_CASE("the lists are printed as JSON") {
    const auto attributes = nlohmann::json::parse(run({"rules", "attributes", "--json"}).out);
    CHECK(attributes["features"].size() > 30);
    CHECK(attributes["surfaces"].size() > 10);
    for (const auto& list : attributes)
      for (const auto& word : list)
        for (const char* key : {"name", "unit", "meaning", "example", "synonyms"})
          CHECK(word.contains(key));
    CHECK(nlohmann::json::parse(run({"rules", "relations", "--json"}).out)["relations"].size() ==
          8);
    const auto operators = nlohmann::json::parse(run({"rules", "operators", "--json"}).out);
    CHECK(operators["operators"][4]["name"] == "enlarge");
    CHECK(operators["operators"][4]["arguments"].size() == 3);
  }

  TEST_CASE("rules explain prints the page of a code") {
    const Outcome outcome = run({"rules", "explain", "r204"});
    CHECK(outcome.exit == 0);
    REQUIRE(outcome.out.starts_with("R204 Unknown attribute\n\n"));
    const std::string docs = bytes_of(std::string(ORIEL_SOURCE_DIR) + "/docs/rules.md");
    CHECK(docs.find("\n### " + outcome.out + "\n### ") != std::string::npos);
    const auto json =
        nlohmann::json::parse(run({"rules", "explain", "E101", "G404", "--json"}).out);
    REQUIRE(json.size() == 2);
    CHECK(json[1]["code"] == "G404");
    CHECK(json[1]["document"] == "errors.md");
    const Outcome unknown = run({"rules", "explain", "R2044"});
    CHECK(unknown.exit == 2);
    CHECK(unknown.err == "there is no code 'R2044'; did you mean 'R204'?\n");
  }

  TEST_CASE("rules doc prints a page or what is wrong with the pack") {
    const Outcome outcome = run({"rules", "doc", "residential"});
    CHECK(outcome.exit == 0);
    CHECK(outcome.out.starts_with("# residential "));
    CHECK(outcome.out.find(
              "\nA feature is a **chimney** if all of this holds:\n\n- it is a `stack`\n") !=
          std::string::npos);
    const Outcome missing = run({"rules", "doc", "residental"});
    CHECK(missing.exit == 4);
    CHECK(missing.says("did you mean 'residential'?"));
    CHECK(missing.out.empty());
  }
}
