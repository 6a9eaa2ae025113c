#pragma once

#include "kernel/model/segmentation.h"
#include "kernel/model/solid.h"

namespace oriel {

/// What can be said of a building that stayed open (open_shell): its planes and vertices, a tree of
/// one leaf, and one cell, flagged `open`, that holds all facets and has no volume. Nothing is cut
/// and there are no features yet: add_ring_features and add_imprints find them.
Segmentation segment_open(const Solid& open_shell);

}  // namespace oriel
