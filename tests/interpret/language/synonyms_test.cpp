#include "interpret/language/synonyms.h"

#include "interpret/language/quantity.h"
#include "interpret/language/suggest.h"
#include "interpret/pack/names.h"
#include "interpret/plan/operators.h"
#include "kernel/model/description/attributes.h"

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
      const bool leads_to_host = synonym.kind == NameKind::attribute && synonym.ours == "host";
      if (!synonym.ours.empty() && !leads_to_host) CHECK(contains(names, synonym.ours));
      CHECK_FALSE(contains(names, synonym.theirs));
      CHECK((!synonym.ours.empty() || !synonym.note.empty()));
      CHECK(normal_name(synonym.theirs) == synonym.theirs);
    }
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
