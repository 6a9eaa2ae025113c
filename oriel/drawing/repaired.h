#pragma once

#include "kernel/base/work.h"
#include "oriel/drawing/output_check.h"
#include "oriel/label.h"
#include "oriel/result.h"

#include <optional>

namespace oriel {

/// A solid that was made for a building: the result as far as the solid, with the tolerances that
/// it was made with.
struct RepairedSolid {
  PipelineResult made;
  /// The solid mended (OutputCheck::made_valid), if only that is valid as it is written.
  std::optional<Solid> mended{};
};

/// Makes the solid of a building whose own solid would not be valid as it is written: its surface
/// runs through itself, say. It becomes the boundary of its inside (Crossings::cut_closed), with
/// the tolerances given, or finer or up to five times coarser ones if they do not help. Nothing if
/// none is valid as it is written, mended or not, or once `work` is used up.
std::optional<RepairedSolid> repaired_solid(OutputCheck& check, const Tolerances& tolerances,
                                            const PipelineOptions& options, Work& work);

/// Makes the solid that repair() makes of an open building: with crossings cut, or if that cannot
/// be made valid its repaired_solid(); otherwise as that.
std::optional<RepairedSolid> cut_solid(OutputCheck& check, const Tolerances& tolerances,
                                       const PipelineOptions& options, Work& work);

/// The warning G417 that a building is drawn from its repaired_solid().
Issue redrawn_from_inside(OutputCheck& check, const RepairReport& report);

/// The warning G420 that an open building is drawn from its cut_solid().
Issue repaired_first(const Building& building, const RepairReport& report);

/// Whether a repaired solid has so many facets that it is drawn without its steps being judged:
/// with all that lies within millimetres of each other in it, that takes minutes and helps little.
bool is_intricate(const Solid& repaired);

/// The error G404: an open building that cut_solid() cannot help either; of an outline (lod 0)
/// E205.
Issue stays_open(const Building& building);

}  // namespace oriel
