#pragma once

#include "generalise/needs.h"
#include "generalise/operators/operators.h"

namespace oriel::detail {

/// What would let an operator act that was refused on these features: with a smaller `gap`, of
/// symbolise a smaller `to`, of typify a smaller `ratio`. The greatest of eighths of what was asked
/// for is told with which it does act; found by halving, so four trials at most for each. Also the
/// features that are nearer than the gap.
Hindrance hindrance_of(const Operator& its, const Redrawing& task);

}  // namespace oriel::detail
