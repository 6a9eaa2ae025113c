#pragma once

#include "interpret/language/findings.h"
#include "interpret/yaml/yaml_tree.h"
#include "kernel/model/limits.h"

namespace oriel::rules {

/// What `invariants:` of a pack or a profile says: a map of numbers above 0. Of what is wrong with
/// it findings as of a Section, and R211.
Limits read_limits(const YamlNode& node, Findings& findings);

}  // namespace oriel::rules
