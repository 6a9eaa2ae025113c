#pragma once

#include "interpret/yaml/grammar.h"

namespace oriel {

/// The grammar of experiments. Every key has a description, and every experiment that loads
/// conforms to its schema.
const rules::Grammar& plan_grammar();

}  // namespace oriel
