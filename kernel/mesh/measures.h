#pragma once

#include "kernel/mesh/mesh.h"

#include <vector>

namespace oriel {

/// Counts and sizes of a mesh.
struct MeshMeasures {
  int vertices = 0, edges = 0, faces = 0;
  double area_m2 = 0;
  /// What the mesh encloses; without meaning if it is open.
  double volume_m3 = 0;
  /// Every edge has a face on both sides, with faces that met at non-manifold edges as neighbours.
  bool is_closed = false;
  /// vertices - edges + faces, without vertices that no face uses: 2 for each closed shell without
  /// handles.
  int euler = 0;
};

MeshMeasures measure(const Mesh& mesh);

/// An edge at which the surface bends, or ends.
struct FeatureEdge {
  int from = -1, to = -1;
  /// The angle between the normals of its faces: 0 to 180, below 0 where the edge is reflex (a
  /// valley).
  double dihedral_deg = 0;
  /// It has one face only; the angle is 0.
  bool is_open = false;
};

/// The edges whose faces' normals differ by more than `angle_deg`, and open ones, in the order of
/// the mesh's edges. Edges within a facet that was triangulated are none: their angle is 0.
std::vector<FeatureEdge> feature_edges(const Mesh& mesh, double angle_deg = 0.5);

/// Unit normals for viewers, one for each corner of each face, faces in order: the mean of the
/// normals round the vertex, by their angles there, over the faces that are reached without
/// crossing a feature edge of `crease_deg`. So walls stay flat and round towers look round.
std::vector<std::vector<Vec3>> corner_normals(const Mesh& mesh, double crease_deg = 30);

/// The symmetric Hausdorff distance of two surfaces in m: how far a point of either lies at most
/// from the other surface. No further off than `error_m` (CGAL, bounded error: Tang et al. 2009,
/// refined where a triangle may still hold the maximum). Both are in one frame; none is empty.
/// Faces that are no triangles are triangulated.
double hausdorff_m(const Mesh& a, const Mesh& b, double error_m = 0.001);
double hausdorff_m(const Solid& a, const Solid& b, double error_m = 0.001);

}  // namespace oriel
