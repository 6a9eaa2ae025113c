#pragma once

#include "interpret/yaml/grammar.h"

namespace oriel::rules {

/// The grammar of tests of rule packs. Every file of tests that loads conforms to its schema.
const Grammar& test_grammar();

}  // namespace oriel::rules
