#include "tests/generalise/line.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <filesystem>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel;
using namespace oriel::test;

namespace {

/// The members of the CityJSON text that are geometry.
nlohmann::json geometry_of(const std::string& text) {
  const auto city = nlohmann::json::parse(text);
  nlohmann::json geometry = {city["transform"], city["vertices"]};
  for (const auto& [id, object] : city["CityObjects"].items())
    for (const auto& one : object["geometry"]) geometry.push_back(one["boundaries"]);
  return geometry;
}

/// A feature of the line lost one that was found in it.
bool has_lost(const Line& line, const std::vector<FeatureId>& removed, const std::string& id) {
  const FeatureId feature = line.table().find(id);
  return feature.is_valid() && std::ranges::any_of(removed, [&](FeatureId gone) {
           return line.segmentation.features[gone.index()].parent == feature;
         });
}

}  // namespace

TEST_SUITE("generalise") {
  // Labels are found anew: a dormer whose window went is no dormer to the rules any more.
  TEST_CASE("generalising the result again changes nothing but what lost its evidence") {
    for (const std::string& name : samples())
      for (const double scale : {2000., 5000., 20000.}) {
        CAPTURE(name);
        CAPTURE(scale);
        const Line line = line_of_sample(name);
        const Coarser first = generalised(line, scale);
        const std::string once = written(line, first);
        const Line again = line_of_text(once);
        const Coarser twice = generalised(again, scale);
        for (const FeatureId id : twice.generalised.removed)
          CHECK(has_lost(line, first.generalised.removed, again.table().id(id)));
        if (twice.generalised.removed.empty())
          CHECK(geometry_of(written(again, twice)) == geometry_of(once));
      }
  }

  TEST_CASE("a written result is a solid again with the same volume") {
    for (const std::string& name : samples()) {
      CAPTURE(name);
      const Line line = line_of_sample(name);
      const Coarser coarser = generalised(line, 20000);
      const Line again = line_of_text(written(line, coarser));
      // Vertices are rounded to a millimetre or finer.
      CHECK(volume_m3(again.solid) ==
            doctest::Approx(volume_m3(coarser.generalised.solid)).epsilon(1e-4));
      for (const std::string label : {"window", "door", "chimney", "balcony", "dormer"})
        CHECK(again.features(label).empty());
    }
  }

  TEST_CASE("every house of random3dcity is closed and bare at 1:20000") {
    ORIEL_NEEDS_SHARED(shared);
    int houses = 0;
    for (const auto& entry : std::filesystem::directory_iterator(shared / "data/random3dcity")) {
      if (!entry.path().string().ends_with(".stripped.city.json")) continue;
      CAPTURE(entry.path().string());
      ++houses;
      const Line line = line_of_file(entry.path());
      const Coarser coarser = generalised(line, 20000);
      CHECK(is_closed(coarser.generalised.solid));
      CHECK(coarser.issues.empty());
      for (const SemanticSurface& surface : coarser.redrawn.labelled.surfaces)
        CHECK((surface.type != "Window" && surface.type != "Door"));
      const Line again = line_of_text(written(line, coarser));
      CHECK(again.features("window").empty());
      CHECK(again.features("door").empty());
    }
    CHECK(houses == 76);
  }
}
