#pragma once

#include "generalise/series/level_state.h"
#include "generalise/series/series_levels.h"
#include "model/scale_series.h"

#include <map>
#include <vector>

namespace oriel {

/// Scales at which something begins in a plan that does not stand at the one before, between 1 and
/// the last of `scales`: of all `bounds` (where entries of the pack begin), and between them by
/// halving, to 1 %. The plans at all scales that were looked at, ascending.
class FiringScales {
 public:
  FiringScales(const std::vector<double>& scales, const std::vector<double>& bounds,
               const SeriesOrder& order);

  /// The smallest scale above `from` and up to `to` from which on the plans up to `to` have the
  /// step; `to` if none has.
  [[nodiscard]] double of(const Step& step, double from, double to) const;

 private:
  void halve(double low, double high, const SeriesOrder& order);

  std::map<double, Plan> plans_;
};

/// The elementary operations that lead from level to level (series_levels()); the finest state is
/// the building as it came. `place` says where the file has its points; it must be the same for all
/// levels.
///
/// - An operation takes off one feature, with what sits on it, or redraws one feature or row. It
///   fires at its own scale if it only takes off, else at its level's. What is nested fires before
///   what carries it, or goes with it.
/// - What changes between two levels is taken apart along edges that nothing shares; operations
///   whose changes hang together (two dormers in the outline of one roof) are told apart by
///   carrying them out one after the other, and are one operation where that cannot be done.
/// - After every operation the state is a closed solid, and after the last one of a level it is
///   that level's. Throws GeometryError if it is not.
///
/// Source: paper section 5; Thiemann and Sester call it the sequence of elementary operations.
ScaleSeries scale_series(const RedrawContext& context, const SeriesOrder& order,
                         const std::vector<SeriesLevel>& levels, const FiringScales& firing,
                         const Placer& place);

/// The same levels without the elementary operations between them, which take long to find: one
/// operation without a feature leads from each level to the next. Throws DoubledFacet.
ScaleSeries level_series(const std::vector<SeriesLevel>& levels, const Placer& place);

/// The state of `series` at 1 : scale.
LevelState state_at(const ScaleSeries& series, double scale);

/// Takes a state from one scale to another along the operations of its building, forward or
/// inverse. False if the state is not that of `from`.
[[nodiscard]] bool move_state(LevelState& state, const std::vector<SeriesOperation>& operations,
                              double from, double to);

}  // namespace oriel
