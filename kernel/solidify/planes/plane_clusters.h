#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/shells/shell_mesh.h"
#include "kernel/solidify/soup/soup.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <vector>

namespace oriel::detail {

/// The oriented planes of a soup: parallel ones share one integer normal (or its negative), and the
/// same plane with opposite orientations has exactly negated coefficients. Sorted by normal, then
/// offset, descending.
struct PlaneClusters {
  std::vector<Plane> planes;
  /// For each polygon of the soup the index of its plane.
  std::vector<int> plane_of;
  /// Polygons that stand across their plane: the sides of a recess or a rise that is thinner than
  /// the tolerance.
  int standing = 0;
};

/// Clusters polygons into planes, the largest polygon first. A polygon joins a plane, or a normal
/// with an offset of its own, if it is tilted by no more than coplanar_deg and none of its vertices
/// lies further off than plane_offset_m; a polygon so thin that its own normal is uncertain by more
/// may be tilted by that much. One that stands across its plane is oriented as its neighbours
/// there. Once `work` is used up polygons get planes of their own.
PlaneClusters cluster_planes(const Soup& soup, const ShellMesh& mesh, const Tolerances& tolerances,
                             Work& work);

}  // namespace oriel::detail
