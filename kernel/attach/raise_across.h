#pragma once

#include "kernel/attach/attach.h"
#include "model/solid.h"

#include <optional>
#include <vector>

namespace oriel {

/// A block that stands on more than one facet of a roof.
struct BlockAcross {
  /// Planes that look out of it, in turn around it, counter-clockwise seen from above. They are
  /// upright, but without a lid the last one is the top, which runs back into the roof.
  std::vector<Plane> sides;
  std::optional<Plane> lid;
  /// Its foot draws no shorter edges, nor leaves such on the edges that it cuts.
  double least_edge_m = 0;
};

/// Puts a block onto a roof across ridges, hips and valleys: the facets under it lose its foot, and
/// its sides end in the line, from facet to facet, in which they cut the roof. What is inside that
/// line goes, so the block may stand on an apex.
///
/// The result is closed by construction: its vertices are meetings of three planes, those of the
/// block and of the facets under it, or lie on edges that the roof has. The facets of the block are
/// the last ones of the solid. It is refused with a reason
///  - if its foot is on one facet only (see attach), on one that does not look up, or through
///    facets that are not linked by edges;
///  - if its foot comes nearer than the clearance to an edge that it does not cut, or draws an edge
///    that is too short;
///  - if the top lies below the roof somewhere;
///  - if the block comes nearer than the clearance to any other facet, or stands on one.
Attached raise_across(const Solid& solid, const BlockAcross& block, const Clearance& clearance);

}  // namespace oriel
