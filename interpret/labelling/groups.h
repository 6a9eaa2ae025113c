#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/labelling/interpret.h"
#include "interpret/pack/pack.h"
#include "kernel/model/interpretation.h"

#include <span>
#include <vector>

namespace oriel::rules {

/// The groups of the buildings of `context`, whose memberships are final, by building: for every
/// kind the connected components of the features of its class under its relation, whichever way a
/// pair leads, that have enough members. Pairs of which it is unknown whether they are related do
/// not connect.
std::vector<std::vector<Group>> find_groups(const Pack& pack, const EvaluationContext& context,
                                            std::span<const FeaturesOfBuilding> buildings);

}  // namespace oriel::rules
