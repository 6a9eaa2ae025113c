#pragma once

#include "interpret/detail/facts.h"
#include "interpret/detail/pack.h"
#include "kernel/model/interpretation.h"

#include <vector>

namespace oriel::rules {

/// The groups of a building whose memberships are final: for every kind the connected components of
/// the features of its class under its relation, whichever way a pair leads, that have enough
/// members. Pairs of which it is unknown whether they are related do not connect.
std::vector<Group> find_groups(const Pack& pack, const Facts& facts, const FeatureTable& table);

}  // namespace oriel::rules
