#pragma once

#include "kernel/segment/segment.h"
#include "model/repair.h"
#include "model/segmentation.h"
#include "model/tolerances.h"
#include "oriel/stage.h"

#include <cstdint>
#include <string>

namespace oriel {

/// How a building becomes a solid and features. The defaults are those of the command.
struct PipelineOptions {
  /// See model/tolerances.h for each number and its reason.
  Tolerances tolerances;
  /// tolerances.plane_offset_m grows where the corners of a building lie further off their planes
  /// (fitted_to_noise), up to a centimetre; a note E126 says so. False: it holds as it is.
  bool fits_noise = true;
  /// What may be done to polygons that are no closed shell. repair() always cuts crossings.
  RepairOptions repair;
  /// Natural: along existing edges first; paper: as Thiemann and Sester 2004, section 4, has it.
  Order order = Order::natural;
  /// Steps that each stage may take on one building, at least 1; then E502 (kernel/base/work.h).
  std::int64_t budget = kWorkBudget;
  /// What the input calls its polygons is not looked at.
  bool ignores_semantics = false;
  /// The level of detail that was asked for when the input was read (ReadOptions::lod); empty: the
  /// highest, and buildings without a level above 0 are rejected (E205). Otherwise it changes only
  /// the hash in `oriel_config_sha256`, and is the `lod` of the operations of a series.
  std::string lod{};
  StageObserver observer{};
};

/// The segmentation's part of the options, with the tolerances that a building was fitted with.
SegmentOptions segment_options(const PipelineOptions& options, const Tolerances& fitted);

/// All that a result depends on besides input and rules, as one text: `oriel_config_sha256` is the
/// SHA-256 of it.
std::string configuration(const PipelineOptions& options);

}  // namespace oriel
