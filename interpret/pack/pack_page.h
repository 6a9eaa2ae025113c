#pragma once

#include "interpret/language/findings.h"
#include "interpret/pack/pack.h"
#include "interpret/yaml/yaml_tree.h"

#include <string>

namespace oriel::rules {

/// A page in Markdown that says what a pack says: its classes, params, macros, relations, rules in
/// plain words, and what becomes of features at which scale. `tree` is the tree of the pack in the
/// text of `findings.source()`, with those that it extends; `pack` was read from it without errors.
std::string pack_page(const YamlNode& tree, const Pack& pack, Findings& findings);

}  // namespace oriel::rules
