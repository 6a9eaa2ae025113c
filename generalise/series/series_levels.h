#pragma once

#include "generalise/generalise.h"
#include "model/plan.h"

#include <functional>
#include <optional>
#include <vector>

namespace oriel {

/// A building on its way through the line; all of one building, made with the same options.
struct SeriesInput {
  const Building& building;
  const LabelledBuilding& labelled;
  const Solid& solid;
  const Segmentation& segmentation;
  const FeatureTable& table;
  const Interpretation& interpretation;
  SegmentOptions options{};
  /// What must not change at 1 : scale; not given: anything may.
  std::function<Invariants(double scale)> invariants_at{};
  /// What is still to be done to each level, and to each state between, once it is drawn.
  std::function<void(LabelledBuilding&)> finish{};
  /// Why a solid must not be written, if it must not; not given: any may.
  std::function<std::optional<Issue>(const Solid&)> fault_of{};
  /// As Invariants::work: once it is used up levels stay as the one before.
  Work* work = nullptr;
  /// Generalised::undrawn of every level.
  std::vector<FeatureId> undrawn{};

  [[nodiscard]] bool has_no_work_left() const { return is_used_up(work); }
};

/// What is asked for at 1 : scale.
using PlanAt = std::function<Plan(double scale)>;

/// A level of a series.
struct SeriesLevel {
  double scale = 0;  ///< 0: the building as it came
  /// The steps that were carried out, of this and of finer levels.
  std::vector<Step> steps{};
  Generalised generalised{};
  Redrawn redrawn{};
  /// Steps that were asked for and refused.
  std::vector<Step> refused{};
};

/// The levels for `scales`, which ascend, after the building as it came: each has all that the one
/// before lost taken off too, whatever its own plan says, so that a series never goes back.
///
/// - What is omitted stays omitted, what has another operator keeps it until the plan of a coarser
///   level says otherwise; arguments that are left out (`to`, `gap`) are those of the scale at
///   which the step came. Rows (aggregate, typify) change only as a whole.
/// - A step that is refused where an older one was carried out leaves that one in force.
/// - A step by which an older one would no longer be carried out is undone (G408, a warning).
/// - A level that must not be written stays as the one before: the fault is a warning; as the
///   building came, it is an error.
/// Issues as of generalise(); no value after an error.
Checked<std::vector<SeriesLevel>> series_levels(const SeriesInput& input,
                                                const std::vector<double>& scales,
                                                const PlanAt& plan_at);

/// What generalise and redraw make of some steps, drawn anew; nothing if nothing closed is left.
std::optional<SeriesLevel> level_of(const SeriesInput& input, double scale, std::vector<Step> steps,
                                    const Invariants& invariants, std::vector<Issue>& issues);

}  // namespace oriel
