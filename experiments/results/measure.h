#pragma once

#include "interpret/learn/count_variants.h"
#include "interpret/learn/sample.h"
#include "interpret/pack/rule_base.h"
#include "interpret/score/paired.h"
#include "kernel/base/parallel.h"

#include <cstddef>
#include <span>

namespace oriel {

/// What the labels of a pack come to on samples, each labelled by interpret() and compared with its
/// truth by score(): the measurement by which all others are checked.
RunOutcomes measure(const RuleBase& rules, std::span<const Sample> samples,
                    const ForEachShare& for_each = for_each_in_turn);

/// What a variant came to, as measure() has it of a pack of its own. `samples` are those that were
/// counted.
RunOutcomes outcomes_of(const VariantCounts& counts, std::size_t variant,
                        std::span<const Sample> samples);

}  // namespace oriel
