#pragma once

#include "kernel/mesh/mesh.h"
#include "kernel/solidify/solidify.h"

namespace oriel {

/// The solid that a mesh bounds, by `solidify`: triangles of one plane become one facet again,
/// doubled vertices are one, and facets list the faces of the mesh that they are of
/// (Facet::polygons), and closed shells that enclose a negative volume are cavities, unless all do.
/// For a mesh that `to_mesh` made of a solid the facets are those of that solid,
/// and vertices lie where they lay to the last digits. Coordinates are metres near the origin, as
/// in the frame of a building: subtract the origin of `frame_of` from those of a file. Open meshes
/// are repaired as `repair` allows; no value if there is no solid, and issues that say why.
Solidified to_solid(const Mesh& mesh, const Tolerances& tolerances = {},
                    const RepairOptions& repair = {});

}  // namespace oriel
