#pragma once

#include "interpret/yaml/grammar.h"

#include <string>

namespace oriel::rules {

/// The grammar of rule packs. Every key has a description, and `defaultSnippets` are what editors
/// offer. Every pack that loads conforms to its schema.
const Grammar& pack_grammar();

/// Puts the schema of the map after `invariants:`, which packs and profiles have alike, in the
/// place of %INVARIANTS%.
std::string with_invariants(std::string schema);

}  // namespace oriel::rules
