#pragma once

#include "kernel/segment/cuts/choice.h"
#include "kernel/segment/tree/growing_tree.h"

#include <optional>
#include <vector>

namespace oriel::detail {

/// What a cut has done.
struct CutResult {
  NodeId node;                      ///< of the cut; its rest is the body's node since
  std::vector<RestChange> changes;  ///< of the rest, part by part
  bool may_have_parted = false;     ///< the rest may be in pieces
};

/// Carries out a choice on a body that is being split: makes the cut's node, lets the parts wait,
/// and leaves the rest in `from`.
///
/// Nothing, and everything is as before, if the rim turns out to separate nothing, as may be
/// between vertices that were rounded onto their planes (noisy input). Throws GeometryError if that
/// is found out about a cut along edges that has changed the body already.
std::optional<CutResult> try_cut(GrowingTree& tree, WaitingBody& from, const CutChoice& choice);

/// The vertices of a body, sorted.
std::vector<int> points_of(const Boundary& body);

/// Adds the area of a body to the surface of its feature, and sets the volume.
void measure(Feature& feature, const Boundary& body);

}  // namespace oriel::detail
