#pragma once

#include "kernel/base/issue.h"
#include "kernel/solidify/soup/soup.h"

#include <string>
#include <vector>

namespace oriel::detail {

/// The half-edges of a soup: half-edge `h` runs along its ring from corner `h` of the soup to the
/// next one. Rings are faces: an inner ring runs clockwise, so it meets its neighbours just as an
/// outer one does. A point at which several sheets (fans of polygons) meet is one vertex per sheet.
struct ShellMesh {
  /// The half-edge after each on its ring.
  Numbers next;
  /// The opposite half-edge, -1 where an edge is open.
  Numbers twin;
  /// The polygon of the soup that each half-edge bounds.
  Numbers polygon_of;
  /// The vertex at which each half-edge starts.
  Numbers vertex_of;
  /// The point of the soup of each vertex.
  Numbers point_of;

  [[nodiscard]] std::size_t half_edge_count() const { return next.size(); }
  [[nodiscard]] std::size_t vertex_count() const { return point_of.size(); }
};

/// The rings of a soup as half-edges that are not paired yet: `next` and `polygon_of` only.
ShellMesh linked_rings(const Soup& soup);

/// Turns polygons round until neighbours agree (E308 with their number), pairs the half-edges, and
/// tells vertices apart. Where more than two polygons meet at an edge they are paired around it so
/// that every pair encloses material. The soup's rings are turned round along.
///
/// Errors: E303 an edge whose polygons do not pair up, E307 polygons that cannot be oriented alike.
/// The mesh is then not to be used.
ShellMesh build_shell_mesh(Soup& soup, const std::string& building, std::vector<Issue>& issues);

/// A place in words, in metres of the frame: "(1.2, 3.4, 5.6)".
std::string place_text(const Soup& soup, int point);

}  // namespace oriel::detail
