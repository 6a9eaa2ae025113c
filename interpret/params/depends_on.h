#pragma once

#include "interpret/pack/pack.h"

#include <cstddef>

namespace oriel::rules {

/// True if the expression's value depends on the param, not counting what quantifiers in it ask of
/// others; with them if `is_thorough`.
bool depends_on(const Pack& pack, ExprId id, std::size_t param, bool is_thorough);

}  // namespace oriel::rules
