#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/explain/what_if.h"
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

/// The values of the param within its range at which something turns for any feature of the
/// building of `context`, ascending, each once. `pack` has the turns and the values of all other
/// params; the param must have a range, and is as before afterwards. Numbers that are taken from
/// labels are taken as memberships are in `context`.
std::vector<double> turning_values(Pack& pack, const EvaluationContext& context, std::size_t param,
                                   const ParamTurns& turns);

/// The values of one param, within its range, at which something turns that a rule or a relation
/// asks: a condition, or the beginning or end of a ramp.
struct TurningPoints {
  /// Of the feature itself, and of the others, which may change its label by theirs. Ascending,
  /// each once.
  std::vector<double> own, others;
  /// Scores change with it between these values, too.
  bool is_gradual = false;
};

/// The param must have a range. Numbers that are taken from other features' labels (an aggregate of
/// those that are a window) are taken as the labels are with the value that the pack says.
TurningPoints turning_points(WhatIf& what_if, std::size_t param, int row);

}  // namespace oriel::rules
