#pragma once

#include "kernel/model/issue.h"
#include "kernel/solidify/detail/soup.h"

#include <vector>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

namespace oriel::detail {

struct ShellTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::None);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
};

/// The half-edge mesh of a soup with one OpenMesh face per ring (OpenMesh's faces have no holes):
/// an inner ring runs clockwise, so it meets its neighbours just as an outer one does. A point at
/// which several sheets meet is one mesh vertex per sheet, because OpenMesh refuses what is not
/// manifold.
struct ShellMesh {
  using Mesh = OpenMesh::PolyMesh_ArrayKernelT<ShellTraits>;
  Mesh mesh;
  /// The polygon of each face, the point of each vertex: indices into Soup.
  std::vector<int> polygon_of;
  std::vector<int> point_of;
};

/// Turns polygons round until neighbours agree (E308 with their number), pairs the edges, and
/// builds the mesh. Where more than two polygons meet at an edge they are paired around it so that
/// every pair encloses material. The soup's rings are turned round along. Edges that stay single
/// become boundary edges of the mesh.
///
/// Errors: E303 an edge whose polygons do not pair up, E307 polygons that cannot be oriented alike.
/// The mesh is then not to be used.
ShellMesh build_shell_mesh(Soup& soup, const std::string& building, std::vector<Issue>& issues);

/// A place in words, in metres of the frame: "(1.2, 3.4, 5.6)".
std::string place_text(const Soup& soup, int point);

}  // namespace oriel::detail
