#pragma once

#include "interpret/yaml/grammar.h"

namespace oriel::rules {

/// The grammar of profiles. Every profile that loads conforms to its schema.
const Grammar& profile_grammar();

}  // namespace oriel::rules
