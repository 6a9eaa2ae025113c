#pragma once

#include "kernel/model/cell_complex.h"
#include "kernel/segment/complex/chord.h"
#include "kernel/segment/complex/owners.h"
#include "kernel/segment/complex/vertex_pool.h"

#include <vector>

namespace oriel::detail {

/// The faces in one plane, without areas: the maximal connected pieces with the same two cells on
/// either side. `chords` are the outlines of all cells just in front of the plane and just behind.
std::vector<Face> faces_of_sheet(PlaneId plane, Vec3 normal, std::vector<Chord> chords,
                                 Owners& owners, VertexPool& pool);

}  // namespace oriel::detail
