#pragma once

#include "kernel/base/work.h"
#include "kernel/segment/complex/vertex_pool.h"
#include "model/cell_complex.h"
#include "model/segmentation.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <optional>
#include <span>

namespace oriel {

/// The complex of one cell, CellId{0}: what is left of `solid` when these leaves of its
/// segmentation are taken out of the sum of signs (Cell) that makes it up.
///
/// In each plane the facets of the solid are added, and those of the leaves subtracted, with their
/// signs; pieces that are left are the faces. So what the leaves do not touch is as it was, and
/// nothing is asked of other cells. Bodies being closed, faces close too, also where vertices lie
/// off their planes: there slivers stay between sheets that do not agree, as wide as that. (A few
/// edges may stay open where a chord passes a vertex by a hair, as in cell_complex().) Leaves
/// must be all that stand or hang in each other there: a part that stays in a hole that goes leaves
/// its faces in the body.
///
/// `solid` may be another one of the same planes, such as what remove_features left of it. Time is
/// that of the solid's facets and of the sheets that the leaves have facets in. `vertices` are
/// vertices_of() the segmentation. Nothing once `work` is used up.
std::optional<CellComplex> body_without(const Solid& solid, const Segmentation& segmentation,
                                        const VertexPool& vertices, std::span<const CellId> leaves,
                                        Work& work);

/// Returns the vertices of a segmentation, as for cell_complex(), from which body_without() begins
/// each time.
VertexPool vertices_of(const Segmentation& segmentation, const Tolerances& tolerances);

}  // namespace oriel
