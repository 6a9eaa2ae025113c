#pragma once

#include "kernel/segment/detail/carve.h"

#include <cstdint>
#include <vector>

namespace oriel::detail {

/// A feature that several planes cut along existing edges: a connected patch of facets with the
/// caps that close it. The caps meet in free edges, in the open (a door's threshold) or inside the
/// body (under a ridge chimney).
struct Patch {
  bool is_hole = false;
  std::vector<int> facets;
  std::vector<Cap> caps;
  double new_area = 0;
  double old_area = 0;
  double volume = 0;
  /// The split planes: those of its caps but the ground.
  [[nodiscard]] std::vector<Side> sides() const;
};

struct PatchOptions {
  /// Planes that are no split planes of the body: those of the cut that made it.
  std::vector<int> own_planes;
  int max_order = 4;
  /// The ground (-1: none): of protrusions with two planes, the rim may leave out a part of it, see
  /// Cap::is_taken.
  Side free_side = -1;
};

/// The patches of holes, or of protrusions, that two to four planes can cap (paper, section 4,
/// figure 3; the dual for protrusions). A hole's patch hangs together over reflex edges and ends at
/// convex ones, a protrusion's the other way round; the planes of the facets beyond its rim are the
/// only ones that can cap it. Equal normals never combine. A patch that does not lie in the corner
/// its planes make, or whose caps do not close, is none.
/// Half-edges that were looked at are added to `work`.
std::vector<Patch> find_patches(const Boundary& body, bool is_hole, const PatchOptions& options,
                                std::int64_t& work);

}  // namespace oriel::detail
