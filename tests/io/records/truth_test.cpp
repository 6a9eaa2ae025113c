#include "io/records/truth.h"

#include "tests/io/files.h"
#include "tests/support/shared.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

Checked<GroundTruth> read(const std::string& text) {
  const test::TemporaryFolder folder;
  return read_truth(folder.write("a.truth.json", text));
}

TEST_SUITE("io") {
  TEST_CASE("truth is read with its boxes and faces") {
    const auto truth = read(R"({"building":"h","dataset":"d","capped_faces":[7],"more":1,"objects":[
        {"id":"w","class":"window","subclass":"Window","aabb":[0,1,2,3,4,5],
         "feature_aabb":[0,0,0,1,1,1],"faces":[3,4],"detectable":true,"recess_m":0.1},
        {"id":"x","class":"other","aabb":[0,0,0,1,1,1],"parent":null}]})");
    CHECK(truth.issues.empty());
    REQUIRE(truth.value);
    CHECK(truth.value->building == "h");
    CHECK(truth.value->capped_faces == std::vector<int>{7});
    REQUIRE(truth.value->objects.size() == 2);
    const TruthObject& window = truth.value->objects[0];
    CHECK(window.label == "window");
    CHECK(window.aabb == Box{{0, 1, 2}, {3, 4, 5}});
    CHECK(window.feature_aabb);
    CHECK(window.faces == std::vector<int>{3, 4});
    CHECK(window.is_detectable == true);
    CHECK(truth.value->objects[1].faces.empty());
    CHECK_FALSE(truth.value->objects[1].is_detectable);
  }

  TEST_CASE("the truth of many buildings stands in lines and a bad line costs that line") {
    const test::TemporaryFolder folder;
    const auto truths = read_truths(folder.write("a.truth.jsonl",
                                                 R"({"building":"h","objects":[]}

{"building":"i"}
{"building":"j","objects":[]})"));
    REQUIRE(truths.value);
    REQUIRE(truths.value->size() == 2);
    CHECK(truths.value->at(1).building == "j");
    REQUIRE(truths.issues.size() == 1);
    CHECK(truths.issues[0].code == Code::E112);
    CHECK(truths.issues[0].place.line == 3);
    CHECK_FALSE(read_truths(folder.write("b.truth.jsonl", "\n")).value);
  }

  TEST_CASE("truth that does not fit is refused with the object and the member") {
    for (const char* text :
         {"{}", "[]", R"({"building":"h","objects":{}})", R"({"objects":[]})",
          R"({"building":"h","objects":[3]})",
          R"({"building":"h","objects":[{"id":"a","class":"b"}]})",
          R"({"building":"h","objects":[{"id":1,"class":"b","aabb":[0,0,0,1,1,1]}]})",
          R"({"building":"h","capped_faces":[0.5],"objects":[]})"}) {
      const auto truth = read(text);
      CAPTURE(text);
      CHECK_FALSE(truth.value);
      CHECK(test::codes_of(truth.issues) == "E112");
    }
    CHECK(read(R"({"building":"h","objects":[{"id":"a","class":"b","aabb":[1]}]})")
              .issues[0]
              .sentence == "'aabb' of object 0 must be six numbers");
    CHECK(test::codes_of(read("{").issues) == "E105");
    CHECK_THROWS_AS(read_truth("/nowhere"), InputError);
  }

  TEST_CASE("all truth of the shared data is read") {
    ORIEL_NEEDS_SHARED(shared);
    int windows = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared / "data")) {
      if (!entry.path().string().ends_with(".truth.json")) continue;
      const auto truth = read_truth(entry.path().string());
      CAPTURE(entry.path().string());
      CHECK(truth.issues.empty());
      REQUIRE(truth.value);
      if (truth.value->dataset != "random3dcity") continue;
      for (const TruthObject& object : truth.value->objects)
        windows += object.label == "window" ? 1 : 0;
    }
    CHECK(windows == 2425);
  }
}

}  // namespace
}  // namespace oriel
