#pragma once

#include "kernel/validate/part_folded.h"
#include "model/building.h"
#include "model/solid.h"

#include <optional>
#include <span>
#include <vector>

namespace oriel {

/// The solid without edges of which both ends are written as one point (E312): vertices that the
/// file's grid makes one, or puts no further than ValidateOptions::snap_m apart, are one, and
/// facets of which less than a triangle is left are gone.
///
/// `written` is what as_written() makes of the solid, `findings` what validate() finds in that for
/// any judge.
/// Nothing if there is no such edge. Whether the rest is valid has to be judged.
std::optional<PartedSolid> weld_written(const Solid& solid, const Building& written,
                                        std::span<const Finding> findings);

}  // namespace oriel
