#pragma once

#include "kernel/base/work.h"
#include "kernel/segment/complex/vertex_pool.h"
#include "model/segmentation.h"
#include "model/solid.h"

#include <optional>
#include <span>

namespace oriel::detail {

/// The solid without these leaves of the segmentation (body_without), in planes of the building:
/// what leaves do not touch stays as it is. Facets name no polygons. `solid` is the one that was
/// segmented, or another one in its planes that has the leaves.
///
/// Nothing if `work` is used up, if that is no closed solid, if it touches itself along more edges
/// than before, or if more facets are narrower than weld_m: where vertices lie off their planes
/// slivers come up, and the pieces have to be solidified anew.
std::optional<Solid> take_out(const Solid& solid, const Segmentation& segmentation,
                              const VertexPool& vertices, std::span<const CellId> leaves,
                              double weld_m, Work& work);

}  // namespace oriel::detail
