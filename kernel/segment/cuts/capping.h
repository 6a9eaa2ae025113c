#pragma once

#include "kernel/segment/boundary/boundary.h"
#include "kernel/segment/cuts/carve.h"
#include "model/vec3.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// A feature that several planes cut off: a connected patch of facets with the caps that close it.
/// The caps meet in free edges, in the open (a door's threshold) or inside the body (under a ridge
/// chimney).
struct Patch {
  bool is_hole = false;
  std::vector<BodyFacetId> facets;
  std::vector<CutCap> caps;
  double new_area = 0;
  double old_area = 0;
  double volume = 0;
  /// The cut follows existing edges and splits no facet.
  bool is_natural = true;
  /// The body with the planes imprinted, in which the facets and rims are numbered; null: the body
  /// itself.
  std::shared_ptr<const Boundary> imprinted = nullptr;
  /// The split planes: those of its caps but the ground.
  [[nodiscard]] std::vector<PlaneSide> sides() const;
};

/// Facets that may become a patch.
struct Component {
  std::vector<BodyFacetId> facets;  ///< ascending
  std::vector<EdgeId> rim;          ///< half-edges of its facets, their twins beyond; ascending
  std::vector<PlaneSide> sides;     ///< on which the rim lies, ascending
  PlaneSide ground = -1;            ///< one of the sides, if the patch stands on the ground
};

/// The side among `sides` that a rim half-edge lies on: that of the facet beyond it, else one whose
/// plane holds both ends; -1: none.
PlaneSide rim_side(const Boundary& body, std::span<const PlaneSide> sides, EdgeId e);

/// The component with caps on all its sides. Nothing if it does not lie in the corner that they
/// make, if the caps do not close, have no area or are pierced, or if it has no volume.
std::optional<Patch> cap_component(FlatBody& body, bool is_hole, const Component& component);

/// The least area that caps in these planes (unit normals, no more than four) have together if they
/// close a surface. `open` is the sum of area × unit normal over the surface's facets, which closed
/// surfaces have none of: the caps' own is the same, each cap's area positive. Infinite if no caps
/// close it. Areas are told apart by more than `slack_m2`: facets may be that much off their
/// planes.
double least_cap_area(std::span<const Vec3> normals, Vec3 open, double slack_m2);

}  // namespace oriel::detail
