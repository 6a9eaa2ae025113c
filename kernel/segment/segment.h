#pragma once

#include "kernel/base/work.h"
#include "model/building.h"
#include "model/segmentation.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <cstdint>

namespace oriel {

/// How a solid is segmented.
struct SegmentOptions {
  Order order = Order::natural;
  Tolerances tolerances;
  /// The largest number of planes that one cut may have, 1…4 (paper, section 4: "a second, third or
  /// fourth plane").
  int max_order = 4;
  /// Half-edges that may be looked at before the rest is left as it is (leaves flagged `budget`,
  /// warning E502). Counted, never timed: the same on every machine.
  std::int64_t budget = kWorkBudget;
};

/// Splits a solid into features: protrusions, holes and cavities, each again split, down to convex
/// leaves.
///
/// Returns the CSG tree, the cells at its leaves with their boundaries, and the features at every
/// level. The result depends on the solid and the options only. What holds of every solid that is
/// valid (validate() finds nothing in it): the tree evaluates to the solid, signed cell volumes add
/// up to its volume, parts of one node do not overlap, each node's rest and parts rebuild it. What
/// runs through itself is cut, too, but its cells may run through themselves and each other, and
/// then need not add up to it.
///
/// `building` is the one the solid was made of; it says which input polygons lie in which feature.
/// Source: Thiemann & Sester 2004, section 4; the orders and what they add are in
/// docs/segmentation.md.
Segmentation segment(const Building& building, const Solid& solid,
                     const SegmentOptions& options = {});

}  // namespace oriel
