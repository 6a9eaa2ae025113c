#pragma once

#include "model/plan.h"
#include "model/segmentation.h"

#include <string>
#include <vector>

namespace oriel::detail {

/// Steps that are carried out together: one, or those of a group.
struct PlanTask {
  std::string operation;
  std::vector<Step> steps;
};

/// True of steps whose operator redraws several features together.
bool is_for_groups(const Step& step);

/// True of steps of which some may be carried out and others not, though they are one task
/// (OperatorScope::wall).
bool takes_some(const Step& step);

/// The steps of a plan as tasks, in the order in which they are carried out: of their first
/// features, then what moves facets (flatten), outlines last; those that only take off (omit) are
/// left out. Steps for groups (aggregate, typify) of one rule and wall plane are together
/// if they are of one group of the pack (Step::group), else if their heights overlap by half of the
/// lower one's; they are ordered along the wall. Of displace all of one rule and wall plane are
/// together.
std::vector<PlanTask> tasks_of(const Plan& plan, const Segmentation& segmentation);

}  // namespace oriel::detail
