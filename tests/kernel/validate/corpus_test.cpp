#include "examples/generator/addition.h"
#include "tests/kernel/validate/judged.h"
#include "tests/support/generated.h"
#include "tests/support/shared.h"

#include <cstdlib>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
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

generator::Options adding(std::initializer_list<std::string_view> texts) {
  generator::Options options;
  for (const std::string_view text : texts)
    options.additions.push_back(generator::read_addition(text));
  return options;
}

void set_features(generator::Options& options, std::initializer_list<generator::Feature> features) {
  options.features.emplace();
  for (const generator::Feature feature : features) options.features->add(feature);
}

TEST_SUITE("kernel/validate") {
  TEST_CASE("slow: a hundred houses of the generator are valid") { check_generated(100); }

  TEST_CASE("slow: houses of the generator with added things of a kind are valid") {
    for (const std::string_view kind :
         {"solar_panel panel on roof size 1.7x1x0.06", "skylight block on roof size 0.8x0.8x0.3",
          "window hole on roof size 0.6x0.8x0.1", "niche hole on wall size 1x1.2x1.2",
          "sign block on wall size 1.2x0.4x0.2", "plate panel on gable size 0.4x0.4"}) {
      CAPTURE(kind);
      check_generated(20, adding({kind}));
    }
  }

  TEST_CASE("houses of the generator with added things of all kinds together are valid") {
    generator::Options options = adding(
        {"solar_panel panel on roof size 1.7x1x0.06", "solar_panel panel on roof size 1.7x1x0.06",
         "skylight block on roof size 0.8x0.8x0.3", "window hole on roof size 0.6x0.8x0.1",
         "window hole on wall size 1x1", "niche hole on wall size 1x1.2x1.2",
         "sign block on wall size 1.2x0.4x0.2", "box block on wall size 0.8x0.8x1.5",
         "plate panel on gable size 0.4x0.4", "shut hole on wall size 1x1x0"});
    options.jitter = 200'000;
    check_generated(60, options);
  }

  TEST_CASE("added things as high as the wall do not touch the roof") {
    using generator::RoofKind;
    for (const RoofKind roof : {RoofKind::flat, RoofKind::gable, RoofKind::hip, RoofKind::shed})
      for (const char* shape : {"block", "hole"}) {
        CAPTURE(shape);
        const std::string thing = std::string("thing ") + shape + " on wall size 1x";
        generator::Options options = adding({thing + "2.85", thing + "2.9", thing + "3"});
        options.roof = roof;
        options.storeys = {1, 1};
        check_generated(20, options);
      }
  }

  TEST_CASE("added holes of a roof and of a gable do not meet inside the house") {
    generator::Options options =
        adding({"deep hole on roof1 at 0.5,8 size 1x1x1.5", "deep hole on gable1 size 5.8x1x1.5",
                "deep hole on gable1 size 5.8x0.1x1.5"});
    options.roof = generator::RoofKind::gable;
    options.storeys = {1, 1};
    options.width = {21'000'000, 21'000'000};
    options.depth = {20'000'000, 20'000'000};
    set_features(options, {});
    check_generated(60, options);
  }

  TEST_CASE("stairs keep clear of things that were added under the ground floor") {
    generator::Options options =
        adding({"slot hole on front size 2x0.1x0.1", "slot hole on front size 2x0.1x0.1",
                "slot hole on front size 3x0.1x0.1"});
    set_features(options, {generator::Feature::door, generator::Feature::stairs});
    check_generated(60, options);
  }

  TEST_CASE("rooms over two columns keep clear of things that were added between these") {
    const std::string_view slot = "slot hole on wall size 0.1x1x0.1";
    generator::Options options = adding({slot, slot, slot});
    options.storeys = {2, 2};
    set_features(options, {generator::Feature::strip, generator::Feature::loggia,
                           generator::Feature::pilaster});
    check_generated(20, options);
  }

  TEST_CASE("slow: many houses of the generator are valid" *
            doctest::skip(std::getenv("ORIEL_SLOW") == nullptr)) {
    // ORIEL_SLOW=2: a thousand; CI takes fewer.
    check_generated(std::atoi(std::getenv("ORIEL_SLOW")) > 1 ? 1000 : 300);
  }

  TEST_CASE("the buildings of 3DBAG with a code of val3dity are those that are not valid") {
    ORIEL_NEEDS_SHARED(shared);
    // val3dity judged the models before their coordinates were rounded to millimetres: the codes
    // are of other defects than those that rounding left (docs/validate.md), the verdicts agree but
    // for two, in which val3dity 2.6 finds a 204 and a 102, too.
    const std::map<std::string, std::string> invalid{{"NL.IMBAG.Pand.0503100000019275-0", "[104]"},
                                                     {"NL.IMBAG.Pand.0503100000019356-0", "[]"},
                                                     {"NL.IMBAG.Pand.0503100000020272-0", "[302]"},
                                                     {"NL.IMBAG.Pand.0503100000021001-0", "[]"},
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
