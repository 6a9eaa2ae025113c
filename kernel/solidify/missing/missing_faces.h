#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/shells/shell_mesh.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// A face that is missing from a surface: its outer ring, then those of its holes, as it would run.
struct MissingFace {
  std::vector<std::vector<int>> rings;
  double area = 0;  ///< grid units squared
  int beside = -1;  ///< a polygon at the same hole
};

/// The faces that are missing from a surface with open edges, so that with them no edge is open.
/// Edges of holes that lie in one plane within `reach` (grid units) bound one face or several, with
/// the holes that lie in them: the outline of a missing wall and those of the windows in it. Where
/// faces next to each other are missing their common edge runs straight between its ends
/// (rim_pieces.h); a corner at which nothing is left becomes a new point of the soup. Nothing if
/// what lies in a plane is no set of outlines with holes in them, or once `work` is used up.
std::optional<std::vector<MissingFace>> find_missing_faces(Soup& soup, const ShellMesh& mesh,
                                                           std::span<const PolygonShape> shapes,
                                                           double reach, Work& work);

}  // namespace oriel::detail
