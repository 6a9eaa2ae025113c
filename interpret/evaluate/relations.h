#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/pack/pack.h"

namespace oriel::rules {

RelationSides sides_of(const Pack& pack, const RelationDefinition& relation);

/// A relation that the pack declares; `links` is to refer to `lists`.
struct NarrowedRelation {
  FeatureLinks lists;
  Links links;
};

/// The pairs of the relation it narrows, which must be linked in `context`, for which its condition
/// holds or is unknown. Where that one relates all of a class, and the condition asks both of them
/// for the same and for equal values, classes are divided in O(n log n) and no pair is looked at.
NarrowedRelation narrowed(const Pack& pack, const EvaluationContext& context,
                          const RelationDefinition& relation);

}  // namespace oriel::rules
