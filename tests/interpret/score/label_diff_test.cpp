#include "interpret/score/label_diff.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

const Naming kWindow{"window", "window.in_wall"};
const Naming kOtherWindow{"window", "window.in_roof"};
const Naming kDoor{"door", "door.on_ground"};
const Naming kUnknown;

TEST_SUITE("interpret") {
  TEST_CASE("features are compared by building and id whatever their order") {
    const LabelDiff diff = diff_labels({{"h", "f", kWindow}, {"h", "g", kDoor}, {"k", "f", kDoor}},
                                       {{"k", "f", kDoor}, {"h", "g", kDoor}, {"h", "f", kWindow}});
    CHECK(diff.compared() == 3);
    CHECK(diff.differences() == 0);
    CHECK(diff.changes().empty());
    CHECK(to_text(diff) == "0 of 3 features have another label\n");
  }

  TEST_CASE("changes are counted by labels and rules with examples") {
    const LabelDiff diff = diff_labels(
        {{"h", "a", kDoor}, {"h", "b", kDoor}, {"h", "c", kUnknown}, {"h", "d", kWindow}},
        {{"h", "a", kWindow}, {"h", "b", kWindow}, {"h", "c", kDoor}, {"h", "d", kOtherWindow}}, 1);
    CHECK(diff.changed() == 3);
    CHECK(diff.renamed_rules() == 1);
    CHECK(diff.differences() == 3);
    CHECK(diff.counts().at("door").before == 2);
    CHECK(diff.counts().at("door").after == 1);
    CHECK(diff.changes().at({kDoor, kWindow}).count == 2);
    CHECK(diff.changes().at({kDoor, kWindow}).examples.size() == 1);
    CHECK(to_text(diff) ==
          "3 of 4 features have another label, 1 the same by another rule\n"
          "  unknown            1 ->       0  -1\n"
          "  door               2 ->       1  -1\n"
          "  window             1 ->       3  +2\n"
          "      2  door -> window         door.on_ground -> window.in_wall         h a, …\n"
          "      1  unknown -> door        - -> door.on_ground                      h c\n"
          "      1  window -> window       window.in_wall -> window.in_roof         h d\n");
  }

  TEST_CASE("features that only one run has are differences") {
    const LabelDiff diff = diff_labels({{"h", "a", kDoor}, {"h", "b", kUnknown}},
                                       {{"h", "b", kUnknown}, {"h", "c", kWindow}});
    CHECK(diff.compared() == 1);
    CHECK(diff.changed() == 0);
    CHECK(diff.differences() == 2);
    CHECK(to_text(diff).find("1 feature is only in the first run: h a\n") != std::string::npos);
    CHECK(to_text(diff).find("1 feature is only in the second run: h c\n") != std::string::npos);
  }

  TEST_CASE("features of the same name are compared one to one") {
    const LabelDiff diff = diff_labels({{"h", "a", kDoor}, {"h", "a", kWindow}},
                                       {{"h", "a", kDoor}, {"h", "a", kDoor}, {"h", "a", kDoor}});
    CHECK(diff.compared() == 2);
    CHECK(diff.changed() == 1);
    CHECK(diff.only_after().count == 1);
  }

  TEST_CASE("as JSON a difference is one object") {
    const LabelDiff diff = diff_labels({{"h", "a", kDoor}}, {{"h", "a", kUnknown}});
    CHECK(to_json(diff) ==
          R"({"compared":1,"changed":1,"other_rule":0,"classes":{"":{"before":0,"after":1},)"
          R"("door":{"before":1,"after":0}},"changes":[{"before":{"label":"door",)"
          R"("rule":"door.on_ground"},"after":{"label":"","rule":""},"count":1,"examples":)"
          R"([{"building":"h","id":"a"}]}],"only_before":{"count":0,"examples":[]},)"
          R"("only_after":{"count":0,"examples":[]}})");
  }
}

}  // namespace
}  // namespace oriel
