#include "interpret/language/synonyms.h"

#include "interpret/language/quantity.h"
#include "interpret/pack/names.h"
#include "interpret/plan/operators.h"
#include "kernel/base/text/suggest.h"
#include "model/description/attributes.h"

#include <set>
#include <utility>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::rules;

namespace {

/// The names that oriel has of a kind; of functions not all.
std::vector<std::string> names_of_kind(NameKind kind) {
  switch (kind) {
    case NameKind::attribute:
      return rules::names_of(feature_schema());
    case NameKind::surface_attribute:
      return rules::names_of(surface_schema());
    case NameKind::relation:
      return rules::names_of(relation_schema());
    case NameKind::operation:
      return rules::names_of(operator_table());
    case NameKind::unit:
      return unit_names();
    case NameKind::function:
      return {"abs",    "min",  "max",   "mean", "sqrt",
              "exists", "none", "count", "all",  "distance_along"};
  }
  return {};
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("every synonym leads to a name that there is and hides none") {
    for (const NameSynonym& synonym : name_synonyms()) {
      CAPTURE(synonym.theirs);
      const auto names = names_of_kind(synonym.kind);
      if (!synonym.ours.empty()) CHECK(contains(names, synonym.ours));
      CHECK_FALSE(contains(names, synonym.theirs));
      CHECK((!synonym.ours.empty() || !synonym.note.empty()));
      CHECK(normal_name(synonym.theirs) == synonym.theirs);
    }
  }

  TEST_CASE("a unit of another size says how large it is") {
    for (const char* unit : {"km", "dm", "ft", "inch", "rad", "grad"}) {
      CAPTURE(unit);
      const std::string said = unknown_name(NameKind::unit, "unit", unit, unit_names(), "");
      CHECK(said.find(" (") != std::string::npos);
    }
    CHECK(unknown_name(NameKind::unit, "unit", "km", unit_names(), "") ==
          "there is no unit 'km'; oriel calls it 'm' (a kilometre is 1000 m)");
  }

  TEST_CASE("a measure that oriel has not is not called by the name of another") {
    const auto names = rules::names_of(feature_schema());
    CHECK(unknown_name(NameKind::attribute, "attribute", "ridge_height", names, "") ==
          "there is no attribute 'ridge_height'; 'below_ridge' is how far its top stays below the "
          "highest point of the roofs");
    CHECK(
        unknown_name(NameKind::attribute, "attribute", "eaves_height", names, "") ==
        "there is no attribute 'eaves_height'; 'above_eaves' is how far its bottom lies above the "
        "eaves of its roof or wall");
  }

  TEST_CASE("no synonym has two meanings") {
    std::set<std::pair<NameKind, std::string_view>> seen;
    for (const NameSynonym& synonym : name_synonyms()) {
      CAPTURE(synonym.theirs);
      CHECK(seen.emplace(synonym.kind, synonym.theirs).second);
    }
  }

  TEST_CASE("names are compared as oriel writes them") {
    CHECK(normal_name("baseHeight") == "base_height");
    CHECK(normal_name("Base-Height") == "base_height");
    CHECK(normal_name("base_height_m") == "base_height");
    CHECK(normal_name("new_area_m2") == "new_area");
    CHECK(normal_name("LOD") == "lod");
    CHECK(normal_name("a") == "a");
    CHECK(normal_name("").empty());
  }

  TEST_CASE("a name of another system leads to ours and others to what is near") {
    const auto said = [](const std::string& name) {
      return unknown_name(NameKind::attribute, "attribute", name,
                          {"height", "depth", "inclination"}, "; there are three");
    };
    CHECK(said("slope") ==
          "there is no attribute 'slope'; oriel calls it 'inclination' (0 deg is level, 90 deg a "
          "wall)");
    CHECK(said("Slope_deg")
              .starts_with("there is no attribute 'Slope_deg'; oriel calls it 'inclination'"));
    CHECK(said("Height") == "unknown attribute 'Height'; did you mean 'height'?");
    CHECK(said("heigth") == "unknown attribute 'heigth'; did you mean 'height'?");
    CHECK(said("colour") == "unknown attribute 'colour'; there are three");
    CHECK(said("label") ==
          "there is no attribute 'label'; the label is asked for by 'self is CLASS'");
  }
}
