#pragma once

#include "kernel/model/segmentation.h"

namespace oriel::detail {

/// The feature is `outer`, or was found in its subtree.
bool is_within(const Segmentation& segmentation, FeatureId id, FeatureId outer);

/// What the feature is a piece of stands on it: the cut between the two looks down, and the piece
/// stands on something else itself, so no surface of its own looks down. Such is the wedge under a
/// chimney across a ridge, cut along one slope, over the other slope; a console is not, its lower
/// side is free.
bool carries_its_parent(const Segmentation& segmentation, FeatureId id);

}  // namespace oriel::detail
