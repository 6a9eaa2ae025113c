#pragma once

#include "kernel/base/work.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/flush/subdivisions.h"
#include "model/tolerances.h"

#include <vector>

namespace oriel::detail {

/// Polygons of a subdivision that lie inset in another of its polygons, the host.
struct ContainedPolygons {
  SubdivisionId subdivision = {};
  /// A polygon of the host.
  InputPolygonId host = {};
  /// Subdivisions::polygons, ascending.
  std::vector<InputPolygonId> polygons;
  /// Around the polygons, counter-clockwise seen from outside; recesses that they enclose are not
  /// left out. Empty if the polygons alone are nothing.
  Outline outline;
  /// Of the outline, or of `whole` if there is none.
  double area_m2 = 0;
  /// What the host leaves free, where that is more than the outline: with the recesses between the
  /// polygons (the sashes beside a mullion, the leaf in a frame on the ground), if it is they that
  /// fill the rest. Else empty.
  Outline whole;
};

/// Everything contained, subdivision by subdivision, the largest first.
///
/// A host is one polygon or, where hints differ, the connected polygons of one hint. Polygons lie
/// inset in it if they fill an inner ring of it, or if it runs along three sides of them, as a wall
/// does around a door: a chain of its edges that turns inward only, by kTurn_deg or more. Convex
/// pieces, as of a triangulation, share one side with each other and so are never contained; among
/// them inset rectangles are (inset_rectangles.h). What is thinner than weld_m is no contained.
/// Once `work` is used up no more hosts are looked into.
std::vector<ContainedPolygons> find_contained(const Solid& solid, const Subdivisions& subdivisions,
                                              const Tolerances& tolerances, Work& work);

}  // namespace oriel::detail
