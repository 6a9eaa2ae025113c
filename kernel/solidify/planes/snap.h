#pragma once

#include "kernel/solidify/shells/facets.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <vector>

namespace oriel::detail {

/// The point with the least sum of squared distances to `planes`, next to `start` where they leave
/// it free, and no further than `reach` from it: planes of a wall and of a panel in it that are a
/// hair's breadth from parallel meet anywhere. `start` itself if there is none.
Vec3 nearest_point(const std::vector<Plane>& planes, Vec3 start, double reach);

/// A solid whose shells are still to be arranged.
struct SnappedSolid {
  Solid solid;
  /// The connected component of every facet, as in the draft.
  std::vector<int> component;
  /// Facets of the draft that vanished.
  int swallowed = 0;
  /// True if vertices were united: only then the loops are others than those of the closed draft.
  bool has_united = false;
};

/// Puts the vertices of the drafted facets where their planes meet and makes the solid of them:
/// facets, planes and vertices, without shells yet.
///
/// A vertex of three planes goes to their meeting. A vertex of more, or one whose meeting lies
/// further than four times plane_offset_m from where it was (planes that are almost parallel meet
/// anywhere), goes to the grid point next to the least-squares point of its planes, and lies on
/// them rounded. Vertices that come to lie within weld_m of a neighbour on a loop become one with
/// it; facets that vanish so are counted. Facet::polygons holds source numbers.
SnappedSolid snap_vertices(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& mesh,
                           FacetDraft draft, const Tolerances& tolerances);

}  // namespace oriel::detail
