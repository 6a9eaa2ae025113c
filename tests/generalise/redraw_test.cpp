#include "kernel/geometry/planar.h"
#include "tests/generalise/line.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

const std::vector<double> kRedrawnScales{1, 1000, 2500, 5000, 20000};

bool is_opening(const SemanticSurface& surface) {
  return surface.type == "Window" || surface.type == "Door";
}

/// The ids of openings, each with those of its type.
std::map<std::string, std::string> openings_of(const LabelledBuilding& labelled) {
  std::map<std::string, std::string> openings;
  for (const SemanticSurface& surface : labelled.surfaces)
    if (is_opening(surface)) openings[surface.label->id] = surface.type;
  return openings;
}

std::set<std::string> installations_of(const LabelledBuilding& labelled) {
  std::set<std::string> ids;
  for (const Installation& installation : labelled.installations) ids.insert(installation.id);
  return ids;
}

/// Numbers are in range, every facet has a surface, every surface a facet, every opening a parent
/// that is no opening.
void check_consistent(const Coarser& coarser) {
  const LabelledBuilding& labelled = coarser.redrawn.labelled;
  if (!labelled.geometry) {
    CHECK(coarser.generalised.removed.empty());
    return;
  }
  const auto facets = labelled.geometry->facets.size();
  REQUIRE(labelled.surface_of_polygon.size() == facets);
  std::set<int> used;
  for (const int surface : labelled.surface_of_polygon) {
    REQUIRE(surface >= 0);
    REQUIRE(surface < std::ssize(labelled.surfaces));
    used.insert(surface);
  }
  CHECK(used.size() == labelled.surfaces.size());
  for (const SemanticSurface& surface : labelled.surfaces) {
    if (!is_opening(surface)) continue;
    REQUIRE(surface.parent >= 0);
    REQUIRE(surface.parent < std::ssize(labelled.surfaces));
    CHECK(!is_opening(labelled.surfaces[static_cast<std::size_t>(surface.parent)]));
  }
  for (const Installation& installation : labelled.installations) {
    CHECK(!installation.polygons.empty());
    REQUIRE(installation.polygons.size() == installation.surfaces.size());
    for (std::size_t i = 0; i < installation.polygons.size(); ++i) {
      REQUIRE(installation.polygons[i] < static_cast<int>(facets));
      CHECK(installation.surfaces[i] ==
            labelled.surface_of_polygon[static_cast<std::size_t>(installation.polygons[i])]);
    }
  }
}

}  // namespace

/// Too narrow to stand on: sills and lintels are pieces of their wall.
bool is_sill(const Solid& solid, const Facet& facet) {
  const Vec3 normal = solid.planes[facet.plane.index()].normal;
  double area_m2 = 0, longest_m = 0;
  for (const Loop& loop : facet.loops) {
    Outline outline;
    for (const int v : loop) outline.push_back(solid.vertices[static_cast<std::size_t>(v)].point);
    area_m2 += signed_area(outline, normal);
    for (std::size_t i = 0; i < outline.size(); ++i)
      longest_m = std::max(longest_m, length(outline[(i + 1) % outline.size()] - outline[i]));
  }
  return std::abs(normal.z) > 0.3 && area_m2 < 0.3 * longest_m;
}

TEST_SUITE("generalise") {
  TEST_CASE("labels of a generalised building are consistent") {
    for (const std::string& name : samples()) {
      const Line line = line_of_sample(name);
      for (const double scale : kRedrawnScales) {
        CAPTURE(name);
        CAPTURE(scale);
        check_consistent(generalised(line, scale));
      }
    }
  }

  TEST_CASE("at 1:1 all openings and installations keep their labels") {
    for (const std::string& name : samples()) {
      CAPTURE(name);
      const Line line = line_of_sample(name);
      const LabelledBuilding redrawn = generalised(line, 1).redrawn.labelled;
      CHECK(openings_of(redrawn) == openings_of(line.labelled));
      CHECK(installations_of(redrawn) == installations_of(line.labelled));
    }
  }

  TEST_CASE("what stays keeps its label and what goes has none left") {
    for (const std::string& name : samples()) {
      const Line line = line_of_sample(name);
      for (const double scale : kRedrawnScales) {
        CAPTURE(name);
        CAPTURE(scale);
        const Coarser coarser = generalised(line, scale);
        std::set<std::string> gone;
        for (const FeatureId id : coarser.generalised.removed) gone.insert(line.table().id(id));
        auto openings = openings_of(line.labelled);
        std::erase_if(openings, [&](const auto& entry) { return gone.contains(entry.first); });
        CHECK(openings_of(coarser.redrawn.labelled) == openings);
        auto installations = installations_of(line.labelled);
        std::set<std::string> removed;
        for (const std::string& id : installations)
          if (gone.contains(id)) removed.insert(id);
        std::erase_if(installations, [&](const std::string& id) { return gone.contains(id); });
        CHECK(installations_of(coarser.redrawn.labelled) == installations);
        CHECK(std::set<std::string>(coarser.redrawn.removed_ids.begin(),
                                    coarser.redrawn.removed_ids.end()) == removed);
      }
    }
  }

  TEST_CASE("a wall that loses its windows stays a wall") {
    for (const std::string& name : samples()) {
      CAPTURE(name);
      const Coarser coarser = generalised(line_of_sample(name), 20000);
      const LabelledBuilding& labelled = coarser.redrawn.labelled;
      for (std::size_t f = 0; f < labelled.surface_of_polygon.size(); ++f) {
        const Solid& solid = *labelled.geometry;
        const double z = solid.planes[solid.facets[f].plane.index()].normal.z;
        const std::string& type =
            labelled.surfaces[static_cast<std::size_t>(labelled.surface_of_polygon[f])].type;
        CAPTURE(z);
        if (std::abs(z) < 0.1) CHECK(type == "WallSurface");
        if (type == "WallSurface" && is_sill(solid, solid.facets[f])) continue;
        if (z > 0.3) CHECK((type == "RoofSurface" || type == "OuterFloorSurface"));
        if (z < -0.3) CHECK((type == "GroundSurface" || type == "OuterCeilingSurface"));
      }
    }
  }

  TEST_CASE("what was removed is counted by label") {
    const Line line = line_of_sample("house");
    const Coarser coarser = generalised(line, 20000);
    std::map<std::string, std::int64_t> counts;
    double volume = -1;
    for (const auto& [name, value] : coarser.redrawn.labelled.attributes) {
      if (name == "oriel_removed_volume_m3")
        volume = std::get<double>(value);
      else if (name.starts_with("oriel_removed_"))
        counts[name.substr(14)] = std::get<std::int64_t>(value);
    }
    CHECK(counts["window"] == 16);
    CHECK(counts["door"] == 2);
    CHECK(counts["dormer"] == 2);
    CHECK(counts["chimney"] == 1);
    CHECK(counts["balcony"] == 1);
    CHECK(volume > 0);
    std::int64_t sum = 0;
    for (const auto& [label, count] : counts) sum += count;
    CHECK(sum == std::ssize(coarser.generalised.removed));
  }
}
