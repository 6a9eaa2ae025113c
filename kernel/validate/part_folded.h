#pragma once

#include "kernel/validate/validate.h"
#include "model/building.h"
#include "model/solid.h"

#include <optional>
#include <span>
#include <vector>

namespace oriel {

/// A solid of which facets were parted.
struct PartedSolid {
  Solid solid;
  /// By facet the one of the solid as it was that it is, or is a part of.
  std::vector<int> whole_of;
};

/// The solid with every facet parted that is folded as it is written (E345): the triangles that are
/// tilted against the largest one become facets of their own, with planes of their own; the rest
/// stays one facet, if it hangs together in no more than edges. Nothing moves, so volume and
/// outline are the same; two facets that meet in such an edge may be almost in one plane.
///
/// `written` is what as_written() makes of the solid, `findings` what validate() finds in that for
/// any judge. Nothing if there is a finding of another kind, or if no facet could be parted.
std::optional<PartedSolid> part_folded(const Solid& solid, const Building& written,
                                       std::span<const Finding> findings);

}  // namespace oriel
