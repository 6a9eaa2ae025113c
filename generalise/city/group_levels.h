#pragma once

#include "generalise/city/city_groups.h"
#include "generalise/series/level_state.h"
#include "kernel/base/issue.h"
#include "kernel/neighbours/neighbours.h"
#include "model/building.h"
#include "model/scale_series.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// Rows and blocks at one scale of a series.
struct GroupsAtScale {
  double scale = 0;
  const CityGroups* groups = nullptr;  ///< null: none
};

/// The first of the scales, which ascend, at which a building is in a block; their number if it is
/// in none.
std::size_t first_in_block(std::span<const GroupsAtScale> scales, const Neighbourhood& around);

/// Adds to the series of a building, which has the levels before it first is in a block, how it
/// becomes one: an operation `aggregate` for each scale at which its block is another one than
/// before, at that scale. The building that leads loses all facets and gains those of the block,
/// with `oriel_members`; the others lose all facets and installations, and have `oriel_member_of`
/// (the id of the block) and `oriel_member_lod`. A scale at which its group makes no valid block
/// leaves it as it was. A building of a row that another one stands for becomes nothing in the same
/// way, by an operation `typify`. `oriel_id` is the id of the block, or of what stands for it,
/// `with` are those of the other members.
void add_group_operations(std::span<const GroupsAtScale> scales, const Building& building,
                          const Neighbourhood& around, const std::string& rule, const Placer& place,
                          ScaleSeries& series);

/// What CityGroups::issues_of() says at all scales, each once.
std::vector<Issue> issues_of_groups(std::span<const GroupsAtScale> scales,
                                    const Neighbourhood& around);

}  // namespace oriel
