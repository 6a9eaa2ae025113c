#pragma once

#include "generalise/generalise.h"
#include "kernel/base/issue.h"
#include "model/plan.h"

#include <optional>
#include <vector>

namespace oriel {

/// Whom a series is drawn for: what is asked for at each scale, and what becomes of a level before
/// it is written.
class SeriesOrder {
 public:
  virtual ~SeriesOrder() = default;

  /// What is asked for at 1 : scale.
  [[nodiscard]] virtual Plan plan_at(double scale) const = 0;
  /// What must not change at 1 : scale.
  [[nodiscard]] virtual Invariants invariants_at(double /*scale*/) const { return {}; }
  /// What is still to be done to each level, and to each state between, once it is drawn.
  virtual void finish(LabelledBuilding& /*level*/) const {}
  /// Why a solid must not be written, if it must not.
  [[nodiscard]] virtual std::optional<Issue> fault_of(const Solid& /*solid*/) const { return {}; }
};

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
/// Once RedrawContext::work is used up levels stay as the one before.
Checked<std::vector<SeriesLevel>> series_levels(const RedrawContext& context,
                                                const SeriesOrder& order,
                                                const std::vector<double>& scales);

/// What generalise and redraw make of a plan, drawn anew and finished; nothing if nothing closed is
/// left.
std::optional<SeriesLevel> level_of(const RedrawContext& context, const SeriesOrder& order,
                                    const Plan& plan, std::vector<Issue>& issues);

}  // namespace oriel
