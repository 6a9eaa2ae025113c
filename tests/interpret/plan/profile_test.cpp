#include "interpret/plan/profile.h"

#include <array>
#include <map>
#include <string>

#include <doctest/doctest.h>

using namespace oriel;

namespace {

std::string profile_with(const std::string& level) {
  return "schema: oriel-profile/1\nprofile: {name: p, version: 1.0.0}\nlevels:\n  any: " + level +
         "\n";
}

/// The codes of what is wrong with a level, one after the other.
std::string codes_of(const std::string& level, const std::string& asked = "") {
  std::string codes;
  const auto loaded = load_profile(profile_with(level), "p.yaml", asked);
  CHECK(loaded.value.has_value() == !has_errors(loaded.issues));
  for (const Issue& issue : loaded.issues) codes += to_string(issue.code) + " ";
  return codes;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("the verdicts of significance are those of the design") {
    const Thresholds t{2, 1, 0.5, 3};
    REQUIRE(t.is_chain());
    CHECK(significance(.3, .3, .3, t) == Significance::point);
    CHECK(significance(6, .1, .1, t) == Significance::line);
    CHECK(significance(4, 1.5, .2, t) == Significance::sheet);
    CHECK(significance(2.4, .9, .05, t) == Significance::line);
    CHECK(significance(1.5, .6, .5, t) == Significance::point);
    CHECK(significance(3, 2.5, 1.2, t) == Significance::keep);
    CHECK(significance(2.2, 1.2, .2, t) == Significance::small);
  }

  TEST_CASE("sheets are told apart by where they are thin and how they grow") {
    const auto place = [](std::map<std::string, double> numbers) {
      FeatureTable table("b", 1);
      for (const auto& [name, number] : numbers)
        table.set(FeatureId{0}, find_attribute(name).value(), number);
      return to_string(sheet_place(table, FeatureId{0}, 0.25));
    };
    CHECK(place({{"depth", 0.2}, {"inclination", 90}, {"growth_out", 0.2}}) == "lamina");
    CHECK(place({{"depth", 0.2}, {"inclination", 90}, {"growth_up", 0.5}}) == "cap");
    CHECK(place({{"depth", 0.2}, {"inclination", 0}, {"growth_up", 0.2}}) == "lamina");
    CHECK(place({{"depth", 0.2}, {"inclination", 0}, {"growth_side", 0.3}}) == "cap");
    CHECK(place({{"depth", 1.5}, {"inclination", 90}, {"growth_out", 1.5}}) == "fin");
    CHECK(place({{"depth", 1.5}, {"inclination", 90}, {"growth_out", 0}}) == "enclosed");
    CHECK(place({}) == "enclosed");  // a cavity
    for (const char* name : {"lamina", "cap", "fin", "enclosed"})
      CHECK(to_string(*sheet_place_of(name)) == name);
    CHECK(is_verdict_of_size("fin"));
    CHECK(is_verdict_of_size("point"));
    CHECK_FALSE(is_verdict_of_size("omit"));
  }

  TEST_CASE("verdicts of sheets are one for all or one for each place") {
    const std::string head = "{form: as-is, map-mm: 0.5, verdicts: ";
    const auto sheets = [&](const std::string& verdicts) {
      std::string out;
      const auto loaded = load_profile(profile_with(head + verdicts + "}"), "p.yaml", "");
      REQUIRE(loaded.value);
      for (const auto& [place, verdict] : loaded.value->sheets)
        out += to_string(place) + "=" + verdict + " ";
      return out;
    };
    CHECK(sheets("{sheet: keep}") == "");
    CHECK(sheets("{sheet: omit}") == "lamina=omit cap=omit fin=omit enclosed=omit ");
    CHECK(sheets("{sheet: omit, fin: enlarge, cap: keep}") ==
          "lamina=omit fin=enlarge enclosed=omit ");
    CHECK(codes_of(head + "{fin: flatten}}") == "R211 ");
    CHECK(codes_of(head + "{sheet: flatten}}") == "R211 ");
    CHECK(codes_of(head + "{lamina: enlarge}}") == "R211 ");
    CHECK(codes_of(head + "{slot: omit}}") == "R209 ");
  }

  TEST_CASE("the thresholds of a map are a chain at every scale") {
    for (const double scale : {1.0, 500.0, 2500.0, 1e6}) {
      const Thresholds t = map_thresholds(0.5, scale);
      CHECK(t.is_chain());
      CHECK(t.a_m == doctest::Approx(0.0005 * scale));
    }
  }

  TEST_CASE("every level of every built-in profile loads without findings") {
    const std::array names{"cfd",         "citygml:1",   "citygml:2",   "citygml:3",
                           "lod:1.0",     "lod:1.2",     "lod:1.3",     "lod:2.0",
                           "map",         "plateau:2.0", "plateau:2.1", "plateau:2.2",
                           "plateau:3.0", "plateau:3.1", "plateau:3.2"};
    const RuleBase residential = *load_pack_file("residential").value;
    for (const char* name : names) {
      const auto loaded = load_profile_file(name);
      REQUIRE_MESSAGE(loaded.value, name);
      CHECK(loaded.issues.empty());
      CHECK(loaded.value->thresholds(1000)->is_chain());
      CHECK(check_profile(*loaded.value, residential, ProfileUse::level).empty());
    }
    const auto all = load_profile_file("plateau:3.3");
    REQUIRE(all.value);
    CHECK_FALSE(all.value->thresholds(1000));
    CHECK(embedded_profiles() ==
          std::vector<std::string>{"cfd", "citygml", "lod", "map", "plateau"});
  }

  TEST_CASE("sizes that are no chain are refused") {
    const std::string tail = ", verdicts: {point: omit}}";
    CHECK(codes_of("{form: as-is, sizes-m: {a: 2, b: 1, c: 0.5}, area-m2: 3" + tail) == "");
    CHECK(codes_of("{form: as-is, sizes-m: {a: 2, b: 2, c: 0.5}, area-m2: 3" + tail) == "R274 ");
    CHECK(codes_of("{form: as-is, sizes-m: {a: 2, b: 1, c: 1.5}, area-m2: 3" + tail) == "R274 ");
    CHECK(codes_of("{form: as-is, sizes-m: {a: 2, b: 1, c: 0.5}, area-m2: 2" + tail) == "R274 ");
    CHECK(codes_of("{form: as-is, sizes-m: {a: 2, b: 1, c: 0.5}, area-m2: 4" + tail) == "R274 ");
  }

  TEST_CASE("a profile that cannot be meant is refused with a code") {
    CHECK(codes_of("{form: as-is, verdicts: {point: omit}}") == "R272 ");
    CHECK(codes_of("{form: as-is, map-mm: 0.5, sizes-m: {a: 2, b: 1, c: 0.5}, area-m2: 3}") ==
          "R272 ");
    CHECK(codes_of("{form: as-is, map-mm: -1}") == "R211 ");
    CHECK(codes_of("{form: round}") == "R211 ");
    CHECK(codes_of("{form: block, footprint-edge-m: 3}") == "");
    CHECK(codes_of("{form: block, footprint-edge-m: 0}") == "R211 ");
    CHECK(codes_of("{form: blocks, footprint-edge-m: 3}") == "R211 ");
    CHECK(codes_of("{form: as-is, footprint-edge-m: 3}") == "R211 ");
    CHECK(codes_of("{form: as-is, buildings: {aggregate: touching, gap-mm: 0.2}}") == "");
    CHECK(codes_of("{form: as-is, buildings: {aggregate: all}}") == "R211 ");
    CHECK(codes_of("{form: as-is, buildings: {gap-mm: 0.2}}") == "R210 ");
    CHECK(codes_of("{form: as-is, buildings: {aggregate: touching, like-height-m: 0}}") == "R211 ");
    CHECK(codes_of("{form: as-is, buildings: {aggregate: touching, typify: {ratio: 0.5}}}") == "");
    CHECK(codes_of("{form: as-is, buildings: {aggregate: touching, typify: {ratio: 1}}}") ==
          "R211 ");
    CHECK(codes_of("{form: as-is, buildings: {aggregate: touching, typify: {from-scale: 9000}}}") ==
          "R210 ");
    CHECK(codes_of("{form: as-is, omits: [door]}") == "R209 ");
    CHECK(codes_of("{form: as-is, parts: {height-m: 3, area-m2: 4}}") == "");
    CHECK(codes_of("{form: as-is, parts: {height-m: 3}}") == "R210 ");
    CHECK(codes_of("{form: as-is, parts: {height-m: 0, area-m2: 4}}") == "R211 ");
    CHECK(codes_of("{form: as-is, invariants: {overhang-pct: 0.1}}") == "");
    CHECK(codes_of("{form: as-is, invariants: {overhang: 0.1}}") == "R209 ");
    CHECK(codes_of("{form: as-is, invariants: {eaves-m: 0}}") == "R211 ");
    CHECK(codes_of("{form: as-is}", "7") == "R275 ");
    CHECK(codes_of("{}") == "R210 ");
    CHECK_FALSE(load_profile_file("no-such-profile").value);
    CHECK_FALSE(load_profile_file("lod").value);
  }

  TEST_CASE("another least edge takes the sizes along") {
    const Profile cfd = *load_profile_file("cfd").value;
    CHECK(cfd.edge_min_m == 0.2);
    CHECK(cfd.names_classes);
    const Profile coarse = with_edge_min(cfd, 0.5);
    CHECK(coarse.edge_min_m == 0.5);
    CHECK(coarse.sizes->c_m == doctest::Approx(0.5).epsilon(1e-9));
    CHECK(coarse.sizes->is_chain());
    CHECK(*coarse.edge_owner_b_m == doctest::Approx(2.5 * *cfd.edge_owner_b_m).epsilon(1e-9));
    const Profile lod = with_edge_min(*load_profile_file("lod:2.0").value, 0.1);
    CHECK(lod.edge_min_m == 0.1);
    CHECK(lod.sizes->c_m == 2);
    CHECK(codes_of("{form: as-is, edge-min-m: 0}") == "R211 ");
    CHECK(codes_of("{form: as-is, stl-solids: name}") == "R211 ");
  }

  TEST_CASE("classes that the pack does not have are told") {
    const auto loaded = load_profile(profile_with("{form: as-is, omit: [dormr]}"), "p.yaml", "");
    REQUIRE(loaded.value);
    const auto issues =
        check_profile(*loaded.value, *load_pack_file("residential").value, ProfileUse::scale);
    REQUIRE(issues.size() == 1);
    CHECK(issues[0].code == Code::R273);
  }

  TEST_CASE("blocks that are asked for at a scale are told") {
    const RuleBase residential = *load_pack_file("residential").value;
    for (const char* name : {"lod:1.2", "lod:1.3"}) {
      const Profile profile = *load_profile_file(name).value;
      CHECK(check_profile(profile, residential, ProfileUse::level).empty());
      const auto issues = check_profile(profile, residential, ProfileUse::scale);
      REQUIRE(issues.size() == 1);
      CHECK(issues[0].code == Code::R276);
      CHECK(issues[0].severity == Severity::warning);
    }
    CHECK(check_profile(*load_profile_file("map").value, residential, ProfileUse::scale).empty());
  }
}
