#pragma once

#include "interpret/detail/facts.h"
#include "interpret/detail/pack.h"

namespace oriel::rules {

/// The pairs of a relation that the pack declares: those of the relation it narrows, which must be
/// linked in `facts`, for which its condition holds or is unknown.
Links narrowed(const Pack& pack, const Facts& facts, const Relation& relation);

}  // namespace oriel::rules
