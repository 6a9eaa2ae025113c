#pragma once

#include "kernel/solidify/solidify.h"

#include <string>

#include <doctest/doctest.h>

namespace oriel::test {

/// The solid of a building that is one, or the test ends with what is wrong with it.
inline Solid solid_of(const Building& building, const Tolerances& tolerances = {}) {
  auto solid = solidify(building, tolerances);
  for (const Issue& issue : solid.issues)
    if (issue.severity == Severity::error) FAIL(to_string(issue));
  REQUIRE(solid.value.has_value());
  REQUIRE(is_closed(*solid.value));
  return std::move(*solid.value);
}

/// The codes that solidify gives a building, separated by blanks; with "solid" in front if it makes
/// one.
inline std::string outcome_of(const Building& building, const Tolerances& tolerances = {},
                              const RepairOptions& repair = {}) {
  const auto solid = solidify(building, tolerances, repair);
  CHECK(solid.value.has_value() != has_errors(solid.issues));
  std::string out = solid.value ? "solid" : "";
  for (const Issue& issue : solid.issues) out += (out.empty() ? "" : " ") + to_string(issue.code);
  return out;
}

/// The first facet that looks in that direction, or the test ends.
inline FacetId facet_looking(const Solid& solid, Vec3 direction) {
  for (int f = 0; f < static_cast<int>(solid.facets.size()); ++f) {
    const FacetId id{f};
    if (dot(solid.planes[solid.facets[id.index()].plane.index()].normal, direction) > 0.999)
      return id;
  }
  FAIL("no such facet");
  return {};
}

/// The building with one polygon for each facet of its solid, inner rings and all: as surveyed
/// models come, where bodies made in code are in pieces.
inline Building in_whole_facets(const Building& building) {
  const Solid solid = test::solid_of(building);
  Building out = building;
  out.vertices.clear();
  for (const Vertex& vertex : solid.vertices) out.vertices.push_back(vertex.point);
  out.polygons.clear();
  for (const Facet& facet : solid.facets) {
    Polygon polygon;
    polygon.rings = facet.loops;
    polygon.source = static_cast<int>(out.polygons.size());
    out.polygons.push_back(std::move(polygon));
  }
  return out;
}

}  // namespace oriel::test
