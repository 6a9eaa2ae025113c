#pragma once

#include "kernel/solidify/shells/shell_mesh.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// An edge of a face that is missing, as that face would run along it.
struct HoleEdge {
  int from = -1, to = -1;
  /// The polygon on the other side of the edge; -1: another missing face.
  int polygon = -1;
  /// A polygon somewhere at the same hole.
  int beside = -1;
};

/// The edges around a hole, each beginning where the one before ends.
using HoleRim = std::vector<HoleEdge>;

/// The rims of a mesh with open edges, sorted. Where sheets of the surface meet in a point the
/// holes lie between them: seen from outside, the edge that follows one is the next clockwise.
/// Nothing if one would follow two.
std::optional<std::vector<HoleRim>> find_rims(const Soup& soup, const ShellMesh& mesh,
                                              std::span<const PolygonShape> shapes);

}  // namespace oriel::detail
