#include "interpret/score/surface_score.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel;

namespace {

/// One polygon of a made building: what they call it, what we do ("" = nothing), its area.
struct Named {
  std::string theirs, ours;
  double area_m2 = 0;
  int parent = -1;
};

/// A building of squares of one metre that stand in a row, named twice.
struct NamedTwice {
  Building building;
  LabelledBuilding labelled;
  SurfaceTable table;

  explicit NamedTwice(const std::vector<Named>& polygons) : table(polygons.size()) {
    building.id = "house";
    for (const Named& named : polygons) {
      const int source = static_cast<int>(building.polygons.size());
      const int first = static_cast<int>(building.vertices.size());
      const double x = 2.0 * source;
      for (const Vec3 corner : {Vec3{x, 0, 0}, Vec3{x + 1, 0, 0}, Vec3{x + 1, 0, 1}, Vec3{x, 0, 1}})
        building.vertices.push_back(corner);
      building.polygons.push_back(
          {{{first, first + 1, first + 2, first + 3}}, source, 0, 0, named.theirs});
      table.set(static_cast<std::size_t>(source), SurfaceAttribute::area, named.area_m2);
      const int surface = static_cast<int>(labelled.surfaces.size());
      labelled.surface_of_polygon.push_back(named.ours.empty() ? -1 : surface);
      if (!named.ours.empty()) labelled.surfaces.push_back({named.ours, named.parent, {}});
    }
  }

  [[nodiscard]] SurfaceScore score(OpeningPolicy policy = OpeningPolicy::compare) const {
    SurfaceScore score;
    compare_surfaces(building, labelled, table, policy, score);
    return score;
  }
};

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("the area of every polygon counts for the pair of its two names") {
    const SurfaceScore score = NamedTwice({{"WallSurface", "WallSurface", 6},
                                           {"WallSurface", "RoofSurface", 2},
                                           {"RoofSurface", "RoofSurface", 4},
                                           {"", "GroundSurface", 9}})
                                   .score();
    CHECK(score.polygons == 4);
    CHECK(score.unnamed_m2 == 9);
    CHECK(score.area_m2.at({"WallSurface", "WallSurface"}) == 6);
    CHECK(score.area_m2.at({"WallSurface", "RoofSurface"}) == 2);
    CHECK(score.recall("WallSurface") == doctest::Approx(6.0 / 8).epsilon(1e-12));
    CHECK(score.precision("WallSurface") == 1);
    CHECK(score.recall("RoofSurface") == 1);
    CHECK(score.precision("RoofSurface") == doctest::Approx(4.0 / 6).epsilon(1e-12));
    CHECK(score.agreement() == doctest::Approx(10.0 / 12).epsilon(1e-12));
  }

  TEST_CASE("a type that nobody names has neither precision nor recall") {
    const SurfaceScore score = NamedTwice({{"WallSurface", "RoofSurface", 1}}).score();
    CHECK(std::isnan(score.recall("RoofSurface")));
    CHECK(std::isnan(score.precision("WallSurface")));
    CHECK(score.recall("WallSurface") == 0);
    CHECK(std::isnan(SurfaceScore().agreement()));
  }

  TEST_CASE("a polygon that we name otherwise or not at all is a difference with its place") {
    NamedTwice house({{"WallSurface", "WallSurface", 6},
                      {"WallSurface", "", 2},
                      {"RoofSurface", "WallSurface", 4}});
    house.building.frame.origin_m = {100, 200, 300};
    const SurfaceScore score = house.score();
    REQUIRE(score.differences.size() == 2);
    CHECK(score.differences[0].polygon == 1);
    CHECK(score.differences[0].ours == "");
    CHECK(score.differences[1].polygon == 2);
    CHECK(score.differences[1].place == Vec3{104.5, 200, 300.5});
    const std::string text = differences_text(score);
    CHECK(text.find("polygon 2 is RoofSurface") < text.find("polygon 1 is WallSurface"));
    CHECK(says(text, "by the rules nothing"));
  }

  TEST_CASE("an opening of ours agrees with the surface that it lies in") {
    const NamedTwice house({{"WallSurface", "WallSurface", 6},
                            {"WallSurface", "Window", 1, 0},
                            {"RoofSurface", "Window", 2, 0},
                            {"Window", "Window", 3, 0}});
    const SurfaceScore compared = house.score(OpeningPolicy::compare);
    CHECK(compared.area_m2.at({"WallSurface", "WallSurface"}) == 7);
    CHECK(compared.area_m2.at({"RoofSurface", "Window"}) == 2);
    CHECK(compared.area_m2.at({"Window", "Window"}) == 3);
    CHECK(compared.openings_m2 == 0);
    const SurfaceScore hosted = house.score(OpeningPolicy::as_host);
    CHECK(hosted.area_m2.at({"RoofSurface", "WallSurface"}) == 2);
    CHECK(hosted.openings_m2 == 3);
    CHECK(hosted.area_m2.size() == 2);
  }

  TEST_CASE("the table speaks of what was left out only where something was") {
    const NamedTwice plain({{"WallSurface", "WallSurface", 6}});
    CHECK_FALSE(says(to_text(plain.score(OpeningPolicy::as_host)), "left out"));
    CHECK_FALSE(says(to_text(plain.score()), "no name"));
    CHECK_FALSE(says(to_text(plain.score()), "->"));
    const NamedTwice full({{"WallSurface", "", 6}, {"Door", "Door", 2}, {"", "WallSurface", 3}});
    const std::string text = to_text(full.score(OpeningPolicy::as_host));
    CHECK(says(text, "2.00 m2 of windows and doors left out"));
    CHECK(says(text, "3.00 m2 have no name"));
    CHECK(says(text, "theirs -> ours"));
  }

  TEST_CASE("the JSON of a score of surfaces lists differences only when asked to") {
    const NamedTwice house({{"WallSurface", "RoofSurface", 6}, {"RoofSurface", "RoofSurface", 2}});
    const auto brief = nlohmann::json::parse(to_json(house.score()));
    CHECK_FALSE(brief.contains("differences"));
    CHECK(brief.at("confusion").size() == 2);
    CHECK(brief.at("surfaces").size() == 2);
    CHECK(brief.at("surfaces").at("RoofSurface").at("recall") == 1);
    const auto full = nlohmann::json::parse(to_json(house.score(), true));
    REQUIRE(full.at("differences").size() == 1);
    CHECK(full.at("differences")[0].at("ours") == "RoofSurface");
  }
}
