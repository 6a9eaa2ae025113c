#pragma once

#include "interpret/pack/rule_base.h"
#include "kernel/base/issue.h"
#include "model/interpretation.h"

#include <map>
#include <string>
#include <vector>

namespace oriel {

/// How many features have each label; "" counts those without one.
std::map<std::string, int> count_labels(const Interpretation& interpretation);

/// What annotate() writes without a type of features with these labels, counted as count_labels()
/// does: for each class without `emit:`, of its own or of a class above it, a warning R258 with the
/// number of features and the place of the class in the pack; in the order of the pack.
std::vector<Issue> report_untyped(const std::map<std::string, int>& features_by_label,
                                  const RuleBase& base);

}  // namespace oriel
