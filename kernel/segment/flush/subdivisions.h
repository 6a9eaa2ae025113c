#pragma once

#include "kernel/base/indexed_vector.h"
#include "kernel/base/work.h"
#include "model/building.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <vector>

namespace oriel::detail {

/// An edge of Subdivisions::edges.
using InputEdgeId = Id<struct InputEdgeTag>;
/// A polygon of Subdivisions::polygons.
using InputPolygonId = Id<struct InputPolygonTag>;
/// One of Subdivisions::subdivisions.
using SubdivisionId = Id<struct SubdivisionTag>;

/// A directed edge of an input polygon, its polygon to the left seen from outside.
struct SubdivisionEdge {
  int from = -1;  ///< Subdivisions::points
  InputPolygonId polygon = {};
  InputEdgeId next = {};  ///< along the same ring
  InputEdgeId twin = {};  ///< the opposite edge of another polygon of the same subdivision
};

struct SubdivisionPolygon {
  int source = -1;
  int hint = 0;  ///< equal hints have equal numbers
  SubdivisionId subdivision = {};
  InputEdgeId first_edge = {}, past_edge = {};
  double area_m2 = 0;

  [[nodiscard]] auto edges() const { return ids_between(first_edge, past_edge); }
};

/// The input polygons that make up one facet of the solid, side by side in one plane.
struct Subdivision {
  FacetId facet;
  InputPolygonId first_polygon = {}, past_polygon = {};
  bool has_hints = false;  ///< its polygons differ in their hints
  bool has_host = false;   ///< another polygon may lie inset in one of them

  [[nodiscard]] auto polygons() const { return ids_between(first_polygon, past_polygon); }
};

/// The subdivisions in which one polygon may lie inset in others: facets of several input
/// polygons, one of which has an inner ring or two inner corners, or whose hints differ, or which
/// are as many as a rectangle among triangles makes. Points are
/// welded and lie in the plane of their facet (a point of several subdivisions is there once for
/// each), so that subdivisions know steps between polygons that the facet has not.
struct Subdivisions {
  std::vector<Vec3> points;
  IndexedVector<InputEdgeId, SubdivisionEdge> edges;
  IndexedVector<InputPolygonId, SubdivisionPolygon> polygons;
  IndexedVector<SubdivisionId, Subdivision> subdivisions;

  [[nodiscard]] int to(InputEdgeId edge) const { return edges[edges[edge].next].from; }
  [[nodiscard]] Vec3 start(InputEdgeId edge) const {
    return points[static_cast<std::size_t>(edges[edge].from)];
  }
  [[nodiscard]] Vec3 vector(InputEdgeId edge) const {
    return start(edges[edge].next) - start(edge);
  }
};

/// The order of subdivisions is that of the facets; that of polygons and edges does not depend on
/// the order of the input.
/// Once `work` is used up, points on edges are no longer looked for.
Subdivisions subdivisions_of(const Building& building, const Solid& solid,
                             const Tolerances& tolerances, Work& work);

}  // namespace oriel::detail
