#include "examples/generator/addition.h"
#include "tests/kernel/validate/judged.h"
#include "tests/support/generated.h"
#include "tests/support/shared.h"

#include <cstdlib>
#include <map>
#include <string>
#include <utility>

#include <doctest/doctest.h>

namespace oriel {
namespace {

void check_generated(int count, generator::Options options = {}) {
  options.seed = 31;
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    CHECK(test::codes_of(test::generated(options, i).building) == "");
  }
}

TEST_SUITE("kernel/validate") {
  TEST_CASE("a hundred houses of the generator are valid") { check_generated(100); }

  // Several kinds on one house may cross each other (docs/generator.md).
  TEST_CASE("houses of the generator with added things of a kind are valid") {
    for (const std::string kind :
         {"solar_panel panel on roof size 1.7x1x0.06", "skylight block on roof size 0.8x0.8x0.3",
          "window hole on roof size 0.6x0.8x0.1", "niche hole on wall size 1x1.2x1.2",
          "sign block on wall size 1.2x0.4x0.2", "plate panel on gable size 0.4x0.4"}) {
      CAPTURE(kind);
      generator::Options options;
      options.additions.push_back(generator::read_addition(kind));
      check_generated(20, options);
    }
  }

  TEST_CASE("slow: a thousand houses of the generator are valid" *
            doctest::skip(std::getenv("ORIEL_SLOW") == nullptr)) {
    check_generated(1000);
  }

  TEST_CASE("the buildings of 3DBAG with a code of val3dity are those that are not valid") {
    ORIEL_NEEDS_SHARED(shared);
    // val3dity judged the models before their coordinates were rounded to millimetres: the codes
    // are of other defects than those that rounding left (docs/validate.md), the verdicts agree but
    // for one, in which val3dity 2.6 finds a 204, too.
    const std::map<std::string, std::string> invalid{{"NL.IMBAG.Pand.0503100000019275-0", "[104]"},
                                                     {"NL.IMBAG.Pand.0503100000019356-0", "[]"},
                                                     {"NL.IMBAG.Pand.0503100000020272-0", "[302]"},
                                                     {"NL.IMBAG.Pand.0503100000029912-0", "[303]"},
                                                     {"NL.IMBAG.Pand.0503100000033695-0", "[303]"}};
    ReadOptions options;
    options.lod = "2.2";
    Reader reader((shared / "data" / "3dbag" / "tile_5910.city.jsonl").string(), options);
    int buildings = 0;
    while (const auto record = reader.next()) {
      if (!record->value) continue;
      for (const Building& building : record->value->buildings) {
        CAPTURE(building.id);
        CHECK(validate(building).empty() == !invalid.contains(building.id));
        ++buildings;
      }
    }
    CHECK(buildings > 200);
  }
}

}  // namespace
}  // namespace oriel
