#pragma once

#include "kernel/model/tolerances.h"
#include "kernel/solidify/detail/shell_mesh.h"
#include "kernel/solidify/detail/soup.h"

#include <vector>

namespace oriel::detail {

/// Polygons that together lie in one plane: the triangles of a wall, say.
struct CoplanarGroups {
  /// Of each polygon of the soup its group; groups count from 0 in the order of first members.
  std::vector<int> group_of;
  int count = 0;
};

/// Unites neighbours, the largest first, as long as the plane of what they make together (the sum
/// of their area vectors, through their centre of area) has all its vertices within plane_offset_m,
/// and tilts neither by more than coplanar_deg, or by as much as its own normal is uncertain.
///
/// With noise the normal of a triangle says little about the wall that it is a piece of; the area
/// vectors of all pieces add up to the wall's own, however it was cut.
CoplanarGroups group_coplanar(const Soup& soup, const ShellMesh& mesh,
                              const Tolerances& tolerances);

/// The soup in which each group is one polygon with the rings of all its members. Neither sources
/// nor order are kept.
Soup soup_of_groups(const Soup& soup, const CoplanarGroups& groups);

}  // namespace oriel::detail
