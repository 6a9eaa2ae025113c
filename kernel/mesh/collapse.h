#pragma once

#include "kernel/mesh/mesh.h"

namespace oriel {

/// A mesh of triangles with edges collapsed until at most `triangles` are left, or no edge can go
/// without making the mesh non-manifold: by the quadric error of the planes that met at a vertex
/// (Garland and Heckbert 1997, OpenMesh's decimater with its quadric module and no bound on the
/// error). What generalisation is compared with: it knows no walls. Closed meshes stay closed,
/// vertices stay or go and none moves. Faces keep their facet, feature and surface; normals are
/// those of the new triangles. Other faces are triangulated before, as fans.
Mesh collapse_edges(const Mesh& mesh, int triangles);

}  // namespace oriel
