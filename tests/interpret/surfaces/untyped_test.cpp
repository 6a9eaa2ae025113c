#include "interpret/surfaces/untyped.h"

#include "tests/interpret/support.h"

using namespace oriel;
using namespace oriel::test;

namespace {

const std::string kPack =
    "schema: oriel/1\n"
    "pack: {name: t, version: 1.0.0}\n"
    "classes: {window: {}, vent: {}, chimney: {}, dormer: {}}\n"
    "rules:\n"
    "  - {id: w, label: window, require: a < 1 m}\n"
    "  - {id: v, label: vent, require: a in 1 m .. 2 m}\n"
    "  - {id: c, label: chimney, require: a in 3 m .. 4 m}\n"
    "  - {id: d, label: dormer, require: a > 5 m}\n"
    "emit: {dormer: {type: BuildingInstallation}}\n";

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("features whose class is not emitted are counted by class in the order of the pack") {
    const RuleBase base = load(kPack);
    Scene scene;
    for (const double a : {0.5, 0.5, 3.5, 1.5, 3.5, 6.0, 4.5}) scene.add({{"a", a}});
    const auto counts = count_labels(interpret(base, scene.table(), scene.graph()));
    CHECK(counts == std::map<std::string, int>{
                        {"", 1}, {"window", 2}, {"vent", 1}, {"chimney", 2}, {"dormer", 1}});
    const auto issues = report_untyped(counts, base);
    REQUIRE(issues.size() == 2);
    CHECK(to_string(issues[0]) ==
          "t.yaml:3:23: R258 1 feature with the label 'vent' is written without a type, a "
          "protrusion as a generic BuildingInstallation, anything else by the label of its "
          "surfaces: the class has no 'emit'; add emit: {vent: {type: BuildingInstallation}}\n"
          "classes: {window: {}, vent: {}, chimney: {}, dormer: {}}\n"
          "                      ^~~~");
    CHECK(issues[1].sentence.starts_with(
        "2 features with the label 'chimney' are written without a type, "));
    for (const Issue& issue : issues) CHECK(issue.severity == Severity::warning);
  }

  TEST_CASE("nothing is said where every feature has a type") {
    const RuleBase base = load(kPack);
    CHECK(report_untyped({{"", 4}, {"window", 2}, {"dormer", 3}}, base).empty());
    CHECK(report_untyped({{"chimney", 0}}, base).empty());
  }
}
