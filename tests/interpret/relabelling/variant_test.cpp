#include "interpret/relabelling/variant.h"

#include "tests/interpret/random_scene.h"

#include <set>

using namespace oriel;
using namespace oriel::test;

namespace {

const std::string kFewRules = pack_with(
    "macros: {flat: depth <= 0.2 m and c <= 0.2 m}\n"
    "rules:\n"
    "  - {id: opening.any, label: opening, require: flat}\n"
    "  - id: window.w\n"
    "    label: window\n"
    "    require:\n"
    "      - self is opening and width >= 0.4 m\n"
    "      - not flat\n"
    "    unless: [base_height > 3 m]\n"
    "    score: [width: {rise: 0 m .. 1 m}, height: {rise: 0 m .. 1 m}]\n"
    "decide: {ambiguous_below: 0.2, evidence: 0.1, company: [alike, beside]}\n");

/// Place and name of each, a line each.
std::string names(const std::vector<Variant>& variants) {
  std::string list;
  for (const Variant& variant : variants)
    list += fmt::format("{}:{} {}\n", variant.place.line, variant.place.column, variant.name);
  return list;
}

}  // namespace

TEST_SUITE("interpret/relabelling") {
  TEST_CASE("ablations name every piece that can be left out at its place") {
    CHECK(names(ablations(load(kFewRules))) ==
          "6:5 without rule opening.any\n"
          "4:16 without 'depth <= 0.2 m' of opening.any\n"
          "4:35 without 'c <= 0.2 m' of opening.any\n"
          "7:5 without rule window.w\n"
          "10:9 without 'self is opening' of window.w\n"
          "10:29 without 'width >= 0.4 m' of window.w\n"
          "11:9 without 'not flat' of window.w\n"
          "12:14 without unless 'base_height > 3 m' of window.w\n"
          "13:13 without score 'width' of window.w\n"
          "13:40 without score 'height' of window.w\n"
          "14:42 without joint evidence\n"
          "14:42 without company alike\n"
          "14:42 without company beside\n");
  }

  TEST_CASE("ablations have different names") {
    const auto all = ablations(load_pack_file("residential").value.value());
    std::set<std::string> different;
    for (const Variant& variant : all) {
      CHECK(different.insert(variant.name).second);
      CHECK(variant.place.line > 0);
    }
    CHECK(all.size() > 200);
  }

  TEST_CASE("a pack without a rule labels as one whose text does not have it") {
    const RuleBase rules = load_pack_file("residential").value.value();
    int compared = 0;
    for (const Variant& variant : ablations(rules)) {
      if (variant.without.front().kind != DroppedPart::Kind::rule) continue;
      const std::string id = variant.name.substr(std::string("without rule ").size());
      const auto text = load_pack(
          "schema: oriel/1\npack: {name: t, version: 1.0.0}\nextends: residential\nrules: [{id: " +
              id + ", remove: true}]\n",
          "t.yaml");
      if (!text.value) continue;
      ++compared;
      const RuleBase without = with_variant(rules, variant).value.value();
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const Scene scene = random_scene(seed, 30);
        CHECK(labels(without, scene) == labels(*text.value, scene));
      }
    }
    CHECK(compared > 30);
  }
}
