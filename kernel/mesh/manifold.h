#pragma once

#include "model/vec3.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// Faces as a half-edge mesh can hold them, and what stood in the way.
struct ManifoldFaces {
  /// The vertices at the corners of each face. Those from the number of points on are doubles.
  std::vector<std::vector<int>> corners;
  /// Of each face the piece that it hangs together with by edges, numbered by their first faces.
  std::vector<int> shell_of_face;
  /// Of each double the vertex that it doubles.
  std::vector<int> doubled;
  int non_manifold_edges = 0;
  int open_edges = 0;
  int shells = 0;
};

/// Gives each fan of faces a vertex of its own: the point of its first corner, or a double of that
/// if an earlier fan has it. Points at the same place count as one. Faces that run along an edge in
/// opposite directions are neighbours; where there are several of them, each with the next one
/// round the edge: between these two lies material, as `normals` (one a face) point out of it. What
/// finds no partner is open. Only faces that are oriented against each other may still not fit.
ManifoldFaces make_manifold(std::span<const Vec3> points, std::span<const std::vector<int>> faces,
                            std::span<const Vec3> normals);

}  // namespace oriel::detail
