#pragma once

#include "interpret/evaluate/pack_values.h"
#include "interpret/language/findings.h"
#include "interpret/pack/pack.h"

#include <vector>

namespace oriel::rules {

/// True of a whole number of things that can be counted: 0 or more, at most a million.
bool is_count(double value);

/// Finds the relations that lead to the others of a storey and a facade, for every `typical:`.
void relate_counts(Pack& pack);

/// The numbers of the relations that evidence leads over: of company and of counts.
std::vector<int> evidence_relations(const Pack& pack);

/// What `typical:` says that cannot be so (R212): of a class more in one storey or on one facade
/// than in the building, or more than of a class above it; of the classes beneath one together more
/// than of this one, or, where it has no features of its own, fewer. And what is never counted
/// (R257): a class that no rule labels anything with, and counts of a pack without `evidence:`.
void check_counts(const Pack& pack, const PackValues& values, Findings& findings);

}  // namespace oriel::rules
