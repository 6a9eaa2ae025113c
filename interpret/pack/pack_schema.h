#pragma once

#include <string>

namespace oriel {

/// A JSON Schema (draft 7) of rule packs, from which editors complete keys and words and tell what
/// has the wrong form. Every key has a description, and `defaultSnippets` are what editors offer.
/// Every pack that loads conforms to it. It knows nothing of expressions, units and names:
/// load_pack does.
std::string pack_schema();

}  // namespace oriel
