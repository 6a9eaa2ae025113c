#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/pack/pack.h"

#include <array>
#include <cstddef>
#include <vector>

namespace oriel::rules {

/// What turns where both sides are equal, and the relations that lead to the features it speaks of.
struct Turn {
  ExprId left = kNoExpr;
  ExprId right = kNoExpr;
  std::array<int, kMostLevels> relations{};
};

/// All that the rules of a pack ask and that depends on one of its params.
struct ParamTurns {
  std::vector<Turn> turns;
  /// Scores change with it between turning points, too.
  bool is_gradual = false;
};

/// Expressions that turns need are appended to the pack.
ParamTurns find_turns(Pack& pack, std::size_t param);

/// The values of one param, within its range, at which something turns that a rule or a relation
/// asks: a condition, or the beginning or end of a ramp.
struct TurningPoints {
  /// Of the feature itself, and of the others, which may change its label by theirs. Ascending,
  /// each once.
  std::vector<double> own, others;
};

/// `pack` has the turns; the param must have a range. Numbers that are taken from other features'
/// labels (an aggregate of those that are a window) are taken as memberships are in `context`,
/// whose values are as before afterwards. With row -1 all features are others.
TurningPoints turning_points(const Pack& pack, EvaluationContext& context, std::size_t param,
                             const ParamTurns& turns, int row);

}  // namespace oriel::rules
