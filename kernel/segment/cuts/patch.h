#pragma once

#include "kernel/segment/cuts/capping.h"

#include <limits>
#include <vector>

namespace oriel::detail {

struct PatchOptions {
  /// Planes that are no split planes of the body: those of the cut that made it.
  std::vector<int> own_planes{};
  int max_order = 4;
  /// The ground (-1: none): of protrusions with two planes, the rim may leave out a part of it, see
  /// CutCap::is_taken.
  PlaneSide free_side = -1;
  /// Protrusions may also lie on planes of one normal that a third one joins, on a wall and the
  /// plinth before it, and be flush with a facet.
  bool is_natural_order = false;
  /// Patches with more new area than so many times the old one are not asked for; most of them are
  /// left out.
  double most_value = std::numeric_limits<double>::infinity();
  /// Patches that lack a cap on one of these sides are not asked for; most of them are left out.
  std::vector<PlaneSide> sides{};
};

/// The natural patches of holes, or of protrusions, that two to four planes can cap (paper, section
/// 4, figure 3; the dual for protrusions). A hole's patch hangs together over reflex edges and ends
/// at convex ones, a protrusion's the other way round; the planes of the facets beyond its rim are
/// the only ones that can cap it. Equal normals never combine, but in steps. A patch that does not
/// lie in the corner its planes make, or whose caps do not close, is none. Half-edges that were
/// looked at are added to `work`.
std::vector<Patch> find_patches(const Boundary& body, bool is_hole, const PatchOptions& options);

/// The groups of facets that hang together over reflex edges, and what is around them.
std::vector<Component> hole_components(const Boundary& body);

}  // namespace oriel::detail
