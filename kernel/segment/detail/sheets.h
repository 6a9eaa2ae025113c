#pragma once

#include "kernel/model/building.h"
#include "kernel/model/solid.h"
#include "kernel/model/tolerances.h"

#include <vector>

namespace oriel::detail {

/// A directed edge of an input polygon, its polygon to the left seen from outside.
struct SheetEdge {
  int from = -1;     ///< Sheets::points
  int polygon = -1;  ///< Sheets::polygons
  int next = -1;     ///< along the same ring
  int twin = -1;     ///< the opposite edge of another polygon of the same sheet, or -1
};

struct SheetPolygon {
  int source = -1;
  int hint = 0;  ///< equal hints have equal numbers
  int sheet = -1;
  int first_edge = -1, past_edge = -1;
  double area_m2 = 0;
};

/// The input polygons that make up one facet of the solid, side by side in one plane.
struct Sheet {
  FacetId facet;
  int first_polygon = -1, past_polygon = -1;
  bool has_hints = false;  ///< its polygons differ in their hints
};

/// The sheets in which one polygon may lie inset in another: facets of several input polygons, one
/// of which has an inner ring or two inner corners, or whose hints differ. Points are welded and
/// lie in the plane of their facet (a point of several sheets is there once for each), so that
/// sheets know steps between polygons that the facet has not.
struct Sheets {
  std::vector<Vec3> points;
  std::vector<SheetEdge> edges;
  std::vector<SheetPolygon> polygons;
  std::vector<Sheet> sheets;

  [[nodiscard]] int to(int edge) const { return edges[at(edges[at(edge)].next)].from; }
  [[nodiscard]] Vec3 vector(int edge) const {
    return points[at(to(edge))] - points[at(edges[at(edge)].from)];
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
};

/// The order of sheets is that of the facets; that of polygons and edges does not depend on the
/// order of the input.
Sheets sheets_of(const Building& building, const Solid& solid, const Tolerances& tolerances);

}  // namespace oriel::detail
