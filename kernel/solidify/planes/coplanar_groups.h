#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/shells/shell_mesh.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"
#include "model/tolerances.h"

#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// Polygons that together lie in one plane: the triangles of a wall, say.
struct CoplanarGroups {
  /// Of each polygon of the soup its group; groups count from 0 in the order of first members.
  std::vector<int> group_of;
  int count = 0;
  /// Of each group the unit normal of the least-squares plane of its corners, where the area
  /// vector's plane does not have all of them within the tolerance.
  std::vector<std::optional<Vec3>> fitted_normal;
};

/// Unites neighbours, the largest first, as long as a plane of what they make together has all its
/// vertices within plane_offset_m and tilts neither by more than coplanar_deg and what its own
/// normal is uncertain by. The plane is that of the sum of their area vectors through their centre
/// of area, or else that of least squares. What is at more than 45° to its neighbour is left alone,
/// but for slivers: polygons thinner than twice plane_offset_m that share more than half of their
/// outline with a group and lie in its plane.
///
/// `shapes` are those of the soup's polygons. Nothing if every polygon stays alone. Once `work` is
/// used up no more are united.
///
/// With noise the normal of a triangle says little about the wall that it is a piece of; the area
/// vectors of all pieces add up to the wall's own, however it was cut.
std::optional<CoplanarGroups> group_coplanar(const Soup& soup, std::span<const PolygonShape> shapes,
                                             const ShellMesh& mesh, const Tolerances& tolerances,
                                             Work& work);

/// The soup in which each group is one polygon with the rings of all its members. Neither sources
/// nor order are kept.
Soup soup_of_groups(const Soup& soup, const CoplanarGroups& groups);

}  // namespace oriel::detail
