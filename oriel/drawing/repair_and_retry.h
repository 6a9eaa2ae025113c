#pragma once

#include "io/document.h"
#include "kernel/base/work.h"
#include "oriel/label.h"
#include "oriel/result.h"

#include <optional>

namespace oriel {

/// The solid of a building whose own solid would not be valid as it is written: its surface runs
/// through itself, say. It becomes the boundary of its inside (Crossings::cut_closed), what the
/// file makes one point is welded (weld_written), and facets that are folded there are parted
/// (part_folded), with the tolerances given, or finer or up to five times coarser ones if they do
/// not help. Nothing if none makes it valid, or once `work` is used up; else the result as far as
/// the solid, with the tolerances that it was made with.
std::optional<PipelineResult> repaired_solid(const Document& document, const Building& building,
                                             const Tolerances& tolerances,
                                             const PipelineOptions& options, Work& work);

/// The building once more in the whole pipeline, from its repaired_solid(), and a warning G417 that
/// says so, the last of its issues. `result` is what came of it the first time; `work` bounds the
/// search for the solid, the stages after it have their own budgets.
std::optional<PipelineResult> repair_and_retry(const Document& document, const Building& building,
                                               const PipelineResult& result, const RuleBase& rules,
                                               const LabelOptions& options, Work& work);

/// Whether what repair_and_retry() gives has so many facets that it is drawn without its steps
/// being judged: with all that lies within millimetres of each other in it, that takes minutes and
/// helps little.
bool is_intricate(const PipelineResult& repaired);

/// An open building once more in the whole pipeline, from the solid that repair() makes of it with
/// the same options, and a warning G420 that says so, the last of its issues. `result`, is_open, is
/// what came of it the first time. Nothing if there is no solid that is valid as it is written.
std::optional<PipelineResult> repair_open(const Document& document, const Building& building,
                                          const PipelineResult& result, const RuleBase& rules,
                                          const LabelOptions& options, Work& work);

/// The error G404: an open building that repair_open() cannot help either; of an outline (lod 0)
/// E205.
Issue stays_open(const Building& building);

}  // namespace oriel
