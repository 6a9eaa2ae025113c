#pragma once

#include "model/segmentation.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <vector>

namespace oriel {

/// The solid with a facet of its own for each of these imprints, so that their outlines are drawn:
/// the facet in which an imprint lies is split along its outline. The new facet names the imprint's
/// input polygons, the old one no longer does.
///
/// `solid` is the one that was segmented, or what remove_features left of it. It stays closed and
/// keeps its volume; its facets are maximal no more, and no loop that it draws comes to a vertex
/// twice. Corners of an outline that are nearer than plane_offset_m + weld_m to a vertex or an edge
/// are put there. An imprint is not drawn if its outline does not fit into one facet any more,
/// crosses itself or an edge of that facet, or runs clockwise.
Solid draw_imprints(Solid solid, const Segmentation& segmentation,
                    const std::vector<FeatureId>& imprints, const Tolerances& tolerances = {});

}  // namespace oriel
