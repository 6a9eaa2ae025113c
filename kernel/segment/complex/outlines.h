#pragma once

#include "kernel/segment/complex/vertex_pool.h"
#include "model/cell_complex.h"
#include "model/segmentation.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// For each plane the one with the smallest id that is the same geometric plane, of either
/// orientation: their facets are one sheet.
std::vector<PlaneId> sheets_of(std::span<const Plane> planes);

/// The facets of closed bodies, as cells are, with all vertices that lie on their edges.
///
/// Loops leave out vertices on straight edges, and rounded vertices are on an edge
/// whatever their coordinates. So incidence says which ones are: a vertex lies on the edge between
/// two facets if some bodies have it in facets of both planes, and it shortens the edge on both
/// sides. Vertices are those of the pool.
std::vector<std::vector<Facet>> whole_outlines(std::vector<std::vector<Facet>> bodies,
                                               std::span<const PlaneId> sheets,
                                               const VertexPool& pool);

/// Gives loops the vertices of other loops that lie on their edges, within `near_m`, so that faces
/// in different planes meet along whole edges.
void conform(std::vector<Face>& faces, std::span<const Vertex> vertices, double near_m);

}  // namespace oriel::detail
