#include "generalise/city/group_levels.h"

#include "generalise/series/change.h"
#include "generalise/series/scale_series.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace {

/// What is written as the level of detail of a building that came without one.
constexpr const char* kLodOfMeshes = "3";

std::optional<CityGroups::Membership> place_at(const GroupsAtScale& at,
                                               const Neighbourhood& around) {
  return at.groups == nullptr ? std::nullopt : at.groups->place_of(around);
}

LevelState block_state(const Building& building, const CityGroups& groups, std::size_t group,
                       const Placer& place) {
  LabelledBuilding labelled;
  labelled.building = building.id;
  return level_state(drawn_group(labelled, groups.solid(group), groups.members(group)).labelled,
                     place);
}

LevelState member_state(const Building& building, const std::string& leader) {
  LevelState state;
  state.building = building.id;
  state.attributes["oriel_member_of"] = leader;
  state.attributes["oriel_member_lod"] = building.lod.empty() ? kLodOfMeshes : building.lod;
  return state;
}

}  // namespace

std::size_t first_in_block(std::span<const GroupsAtScale> scales, const Neighbourhood& around) {
  const auto first = std::ranges::find_if(
      scales, [&](const GroupsAtScale& at) { return place_at(at, around).has_value(); });
  return static_cast<std::size_t>(first - scales.begin());
}

void add_group_operations(std::span<const GroupsAtScale> scales, const Building& building,
                          const Neighbourhood& around, const std::string& rule, const Placer& place,
                          ScaleSeries& series) {
  LevelState state = state_at(series, std::numeric_limits<double>::infinity());
  for (const GroupsAtScale& at : scales) {
    const auto in_block = place_at(at, around);
    if (!in_block) continue;
    std::vector<std::string> members = at.groups->members(in_block->group);
    LevelState next = in_block->leads ? block_state(building, *at.groups, in_block->group, place)
                                      : member_state(building, at.groups->id(in_block->leader));
    if (next == state) continue;
    SeriesOperation operation;
    operation.building = building.id;
    operation.oriel_id = at.groups->id(in_block->leader);
    operation.operation = at.groups->is_row(in_block->group) ? "typify" : "aggregate";
    operation.rule = rule;
    operation.scale = at.scale;
    std::erase(members, building.id);
    operation.with = std::move(members);
    operation.forward = difference(state, next);
    operation.inverse = difference(next, state);
    operation.aabb_m = box_of(operation.forward);
    series.operations.push_back(std::move(operation));
    state = std::move(next);
  }
}

std::vector<Issue> issues_of_groups(std::span<const GroupsAtScale> scales,
                                    const Neighbourhood& around) {
  std::vector<Issue> issues;
  for (const GroupsAtScale& at : scales) {
    if (at.groups == nullptr) continue;
    for (Issue& issue : at.groups->issues_of(around))
      if (std::ranges::find(issues, issue.sentence, &Issue::sentence) == issues.end())
        issues.push_back(std::move(issue));
  }
  return issues;
}

}  // namespace oriel
