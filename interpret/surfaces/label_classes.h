#pragma once

#include "interpret/pack/rule_base.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// What a pack's labels are, for those who count features by what they are.
enum class LabelledAs { window, door, other };

/// A window or a door if the class of the label, or one above it, is written as one (`emit:`).
LabelledAs labelled_as(const RuleBase& base, std::string_view label);

/// The label is that class of the pack, or one below it.
bool is_of_class(const RuleBase& base, std::string_view label, std::string_view name);

/// What is_of_class() knows, abstract classes among them, in the order of the pack.
std::vector<std::string> class_names(const RuleBase& base);

}  // namespace oriel
