#pragma once

#include "interpret/learn/learn_params.h"
#include "interpret/pack/rule_base.h"

#include <string>

namespace oriel {

/// A pack that extends the one called `extended` and changes the params that were learnt, each with
/// the reason; ranges stay. Without changes it says in a comment why there are none. `name` is that
/// of the pack. Loaded, it labels as with_params() of what was learnt.
std::string learnt_pack(const Learnt& learnt, const RuleBase& rules, const std::string& name,
                        const std::string& extended);

/// For a terminal: what was learnt, a line a param, the objective on held-out folds, class by
/// class, and knife edges.
std::string to_text(const Learnt& learnt, const RuleBase& rules);

/// The same as one JSON object on one line.
std::string to_json(const Learnt& learnt, const RuleBase& rules);

}  // namespace oriel
