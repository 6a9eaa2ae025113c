#pragma once

#include "kernel/base/index.h"
#include "kernel/base/work.h"
#include "model/building.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <vector>

namespace oriel::detail {

/// A directed edge of an input polygon, its polygon to the left seen from outside.
struct SubdivisionEdge {
  int from = -1;     ///< Subdivisions::points
  int polygon = -1;  ///< Subdivisions::polygons
  int next = -1;     ///< along the same ring
  int twin = -1;     ///< the opposite edge of another polygon of the same subdivision, or -1
};

struct SubdivisionPolygon {
  int source = -1;
  int hint = 0;  ///< equal hints have equal numbers
  int subdivision = -1;
  int first_edge = -1, past_edge = -1;
  double area_m2 = 0;
};

/// The input polygons that make up one facet of the solid, side by side in one plane.
struct Subdivision {
  FacetId facet;
  int first_polygon = -1, past_polygon = -1;
  bool has_hints = false;  ///< its polygons differ in their hints
  bool has_host = false;   ///< another polygon may lie inset in one of them
};

/// The subdivisions in which one polygon may lie inset in others: facets of several input
/// polygons, one of which has an inner ring or two inner corners, or whose hints differ, or which
/// are as many as a rectangle among triangles makes. Points are
/// welded and lie in the plane of their facet (a point of several subdivisions is there once for
/// each), so that subdivisions know steps between polygons that the facet has not.
struct Subdivisions {
  std::vector<Vec3> points;
  std::vector<SubdivisionEdge> edges;
  std::vector<SubdivisionPolygon> polygons;
  std::vector<Subdivision> subdivisions;

  [[nodiscard]] int to(int edge) const { return edges[at(edges[at(edge)].next)].from; }
  [[nodiscard]] Vec3 vector(int edge) const {
    return points[at(to(edge))] - points[at(edges[at(edge)].from)];
  }
};

/// The order of subdivisions is that of the facets; that of polygons and edges does not depend on
/// the order of the input.
/// Once `work` is used up, points on edges are no longer looked for.
Subdivisions subdivisions_of(const Building& building, const Solid& solid,
                             const Tolerances& tolerances, Work& work);

}  // namespace oriel::detail
