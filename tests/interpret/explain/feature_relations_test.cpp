#include "interpret/explain/feature_relations.h"

#include "interpret/explain/explain.h"
#include "tests/interpret/support.h"

#include <algorithm>

using namespace oriel;
using namespace oriel::test;

namespace {

const RelatedFeatures* find(const std::vector<RelatedFeatures>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &RelatedFeatures::relation);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

TEST_SUITE("interpret/explain") {
  TEST_CASE("relations of the pack are listed as the built-in ones are") {
    // No rule asks them, which is a warning.
    const auto loaded = load_pack(
        "schema: oriel/1\n"
        "pack: {name: t, version: 1.0.0}\n"
        "params: {near: {value: 1 m}}\n"
        "classes: {window: {}}\n"
        "relations:\n"
        "  close: {within: same facade, where: abs(base_height - other.base_height) <= $near}\n"
        "  closest: {within: close, where: a ~ other.a by 10 %}\n"
        "  beside: {within: same facade, where: top = other.top}\n"
        "rules: [{id: w, label: window, require: a > 1 m}]\n",
        "t.yaml");
    REQUIRE(loaded.value);
    const RuleBase& base = *loaded.value;
    Scene scene;
    scene.add({{"a", 1.0}, {"base_height", 1.0}, {"top", 2.0}});
    scene.add({{"a", 1.05}, {"base_height", 1.5}, {"top", 2.0}});
    scene.add({{"a", 3.0}, {"base_height", 1.5}});
    scene.add({{"a", 1.0}, {"base_height", 9.0}, {"top", 9.5}});
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) scene.relate_both("same_facade", FeatureId{i}, FeatureId{j});
    scene.relate_both("beside", FeatureId{0}, FeatureId{3});
    const FeatureTable table = scene.table();
    const FeatureGraph graph = scene.graph();
    const auto all = FeatureRelations(base, table, graph).of(FeatureId{0});
    REQUIRE(find(all, "same_facade"));
    CHECK(find(all, "same_facade")->others.size() == 3);
    CHECK(find(all, "same_facade")->place.line == 0);
    REQUIRE(find(all, "close"));
    CHECK(find(all, "close")->others == std::vector{FeatureId{1}, FeatureId{2}});
    CHECK(find(all, "close")->meaning ==
          "same facade where abs(base_height - other.base_height) <= $near");
    CHECK(find(all, "close")->place.line == 6);
    CHECK(find(all, "close")->ids[0] == table.id(FeatureId{1}));
    REQUIRE(find(all, "closest"));
    CHECK(find(all, "closest")->others == std::vector{FeatureId{1}});
    // The pack's own hides the built-in one; of the third it is not known.
    REQUIRE(find(all, "beside"));
    CHECK(find(all, "beside")->others == std::vector{FeatureId{1}});
    CHECK(std::ranges::count(all, "beside", &RelatedFeatures::relation) == 1);
    const Interpretation said = interpret(base, table, graph);
    const Explanation explained =
        Explainer(base, table, graph, said).explain_without_flip(FeatureId{0});
    CHECK(to_json(explained).find(R"({"name":"close","meaning":"same facade where)") !=
          std::string::npos);
  }

  TEST_CASE("a pack without relations lists the built-in ones") {
    const RuleBase base = load(
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}}\n"
        "rules: [{id: w, label: window, require: a > 1 m}]\n");
    Scene scene;
    scene.add({{"a", 1.0}});
    scene.add({{"a", 1.0}});
    scene.relate_both("beside", FeatureId{0}, FeatureId{1});
    const FeatureTable table = scene.table();
    const FeatureGraph graph = scene.graph();
    const auto all = FeatureRelations(base, table, graph).of(FeatureId{1});
    REQUIRE(all.size() == 1);
    CHECK(all[0].relation == "beside");
    CHECK(all[0].others == std::vector{FeatureId{0}});
  }
}
