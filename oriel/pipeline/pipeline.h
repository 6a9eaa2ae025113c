#pragma once

#include "interpret/pack/rule_base.h"
#include "kernel/base/log.h"
#include "kernel/base/work.h"
#include "model/building.h"
#include "oriel/label.h"
#include "oriel/result.h"
#include "oriel/stage.h"

#include <chrono>

namespace oriel {

/// Does work on a building and logs it at level debug: `segmented: building=b1 features=42 ms=118`.
/// `counts` says of the result what stands in the middle.
template <class Work, class Counts>
auto logged(const char* done, const Building& building, Work work, Counts counts) {
  const auto start = std::chrono::steady_clock::now();
  auto value = work();
  if (const Log logger = log("oriel"); logger.is_on(LogLevel::debug)) {
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    logger.debug("{}: building={} {} ms={:.0f}", done, building.id, counts(value), took.count());
  }
  return value;
}

/// The same for a stage, whose time is reported to the observer, too.
template <class Work, class Counts>
auto measured(const StageObserver& observer, Stage stage, const char* done,
              const Building& building, Work work, Counts counts) {
  return logged(
      done, building, [&] { return measure(observer, stage, work); }, counts);
}

/// True if the level of detail that was read is 0, 0.1 …: a footprint or the outline of a roof.
bool has_only_outline(const Building& building);

/// An error E205 of a building that has no higher level of detail than such an outline, unless the
/// outline was asked for (PipelineOptions::lod).
std::optional<Issue> no_body(const Building& building, const PipelineOptions& options);

/// solid_of() with the tolerances given, and what is left of some work.
PipelineResult run_to_solid(const Building& building, const Tolerances& tolerances,
                            const RepairOptions& repair, oriel::Work& work,
                            const StageObserver& observer);

/// The rest of the pipeline, for a building that has come to its solid, or to none: its features,
/// and with `rules` their labels and its surfaces. `tolerances` are those of the solid.
PipelineResult run_from_solid(PipelineResult solid, const Building& building, const RuleBase* rules,
                              const Tolerances& tolerances, const LabelOptions& options);

/// All of it, with tolerances fitted to noise. `rules` may be null.
PipelineResult run_pipeline(const Building& building, const RuleBase* rules,
                            const LabelOptions& options);

/// What run_pipeline() with rules makes of a building of which it made `segmented` without.
PipelineResult name_segmented(const Building& building, PipelineResult segmented,
                              const RuleBase& rules, const LabelOptions& options);

/// All surfaces of a building, whether it came to its features or not.
FoundSurfaces describe_all_surfaces(const Building& building, const LabelOptions& options,
                                    const PipelineResult& result);

/// As much of them as they cannot be named without, and their names.
FoundSurfaces name_surfaces(const Building& building, const RuleBase& rules,
                            const LabelOptions& options, const PipelineResult& result);

/// Reports an exception as own_fault does. An OutputError, which is no fault of the building, is
/// thrown on.
Issue own_fault(const Building& building, const std::exception& fault);

}  // namespace oriel
