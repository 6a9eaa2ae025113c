#pragma once

#include "interpret/evaluate/evaluator.h"
#include "interpret/evaluate/relations.h"

#include <optional>
#include <span>
#include <vector>

namespace oriel::rules {

/// For every feature whether all of the conditions hold, which read that level only.
std::vector<Truth> answers_of(const EvaluationContext& context, Evaluator& evaluator,
                              const std::vector<ExprId>& conditions, int level);

/// Lowers `all` to what the conditions leave of it.
void narrow(Evaluator& evaluator, const std::vector<ExprId>& conditions, const Frame& frame,
            std::span<Truth> all);

/// The classes of `from` without the features that do not fit `conditions`, parted by the values
/// of `keys`; both read level 0. Nothing if a value is missing: then it is unknown of pairs, not of
/// features, whether they belong together. O(n log n).
std::optional<Narrowed> refined_classes(const Pack& pack, const EvaluationContext& context,
                                        Evaluator& evaluator, const Links& from,
                                        const std::vector<ExprId>& conditions,
                                        const std::vector<ExprId>& keys);

}  // namespace oriel::rules
