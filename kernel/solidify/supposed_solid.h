#pragma once

#include "kernel/base/issue.h"
#include "kernel/base/work.h"
#include "model/building.h"
#include "model/repair.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <optional>
#include <vector>

namespace oriel {

/// A solid that an open building would be if faces of oriel's own stood where some are missing.
struct SupposedSolid {
  /// Facets of supposed faces alone list no polygons.
  Solid solid;
  std::vector<Cap> faces;
  /// Warnings and notes of solidify's.
  std::vector<Issue> issues;
};

/// The solid of a building that solidify found open, if the faces that are missing follow from the
/// edges around the holes (missing/fill.h): in one plane each, of any size. All input polygons
/// bound it, but for doubles; no supposed face runs through one or lies on one, and all together
/// are no larger than what is there. Nothing if that cannot be had, or not in `budget` steps:
/// `open_shell` can.
///
/// It serves for finding features. It is nobody's surface, and never to be written: that the
/// building has a solid is supposed only.
std::optional<SupposedSolid> supposed_solid(const Building& building,
                                            const Tolerances& tolerances = {},
                                            std::int64_t budget = kWorkBudget);

}  // namespace oriel
