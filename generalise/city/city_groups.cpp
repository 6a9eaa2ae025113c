#include "generalise/city/city_groups.h"

#include "kernel/base/counted.h"
#include "kernel/blocks/simplify_outlines.h"
#include "kernel/blocks/upright_block.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/planar.h"
#include "kernel/model/tolerances.h"
#include "kernel/validate/validate.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace {

using detail::Outline;
using detail::PlanArea;

constexpr double kMillimetreOnMap = 1e-3;

/// The outer outline, and courtyards that are not too small.
std::vector<Outline> outlines_to_draw(const PlanArea& area, double least_yard_m2) {
  std::vector<Outline> out{area.front()};
  for (std::size_t i = 1; i < area.size(); ++i)
    if (std::abs(detail::signed_area(area[i], {0, 0, 1})) >= least_yard_m2) out.push_back(area[i]);
  return out;
}

/// The ground of buildings that are not of a group, in the frame of its first member.
class Outsiders {
 public:
  Outsiders(const NeighbourSearch& search, const AlikeGroup& group) {
    const auto& all = search.buildings();
    const Vec3 origin_m = all[group.members.front()].origin_m;
    Box around;
    for (const Outline& outline : group.areas[0])
      for (const Vec3 p : outline) around.grow(p + origin_m);
    for (const std::size_t i : search.standing_in(grown(around, kContact_m))) {
      if (std::ranges::binary_search(group.members, i)) continue;
      const Vec3 moved_m = all[i].origin_m - origin_m;
      boxes_.push_back(all[i].box.moved(moved_m));
      for (auto& piece : moved_ground(all[i], moved_m))
        std::ranges::move(piece, std::back_inserter(outlines_));
    }
  }

  /// None stands in the box, seen from above.
  [[nodiscard]] bool are_clear_of(const Box& box) const {
    return std::ranges::none_of(boxes_, [&](const Box& its) {
      return its.min.x <= box.max.x && box.min.x <= its.max.x && its.min.y <= box.max.y &&
             box.min.y <= its.max.y;
    });
  }

  /// One of them stands against an edge.
  [[nodiscard]] bool stand_against(Vec3 from, Vec3 to) const {
    const double long_m = length(to - from);
    if (!(long_m > 0)) return false;
    const Vec3 along = (1 / long_m) * (to - from);
    const auto is_on = [&](Vec3 p, Vec3 q) {
      const double of_p = dot(p - from, along), of_q = dot(q - from, along);
      return length(cross(p - from, along)) <= kContact_m &&
             length(cross(q - from, along)) <= kContact_m &&
             std::min(std::max(of_p, of_q), long_m) - std::max(std::min(of_p, of_q), 0.0) >
                 kContact_m;
    };
    return std::ranges::any_of(outlines_, [&](const Outline& outline) {
      for (std::size_t i = 0; i < outline.size(); ++i)
        if (is_on(outline[i], outline[(i + 1) % outline.size()])) return true;
      return false;
    });
  }

 private:
  std::vector<Box> boxes_;
  std::vector<Outline> outlines_;
};

}  // namespace

bool asks_for_groups(const Profile& profile, double scale) {
  return profile.groups && scale >= profile.groups->from_scale;
}

CityGroups::CityGroups(const NeighbourSearch& search, const Profile& profile, double scale,
                       const ForEachShare& each)
    : search_(search), group_of_(search.size(), -1), unlike_(search.size()) {
  if (!asks_for_groups(profile, scale)) return;
  // What is no longer than the gaps that are closed is not seen in an outline either.
  const double least_m = profile.groups->gap_mm * kMillimetreOnMap * scale;
  const GroupingLimits limits{least_m, profile.groups->like_height_m};
  AlikeGroups found = alike_groups(search, limits);
  for (AlikeGroup& group : found.groups) {
    for (const std::size_t member : group.members)
      group_of_[member] = static_cast<int>(groups_.size());
    groups_.push_back({std::move(group), std::nullopt, {}});
  }
  for (const auto& [i, k] : found.unlike) {
    unlike_[i].push_back(k);
    unlike_[k].push_back(i);
  }
  each(groups_.size(), [&](std::size_t i) { make_solid(groups_[i], profile, least_m); });
}

void CityGroups::make_solid(DrawnGroup& group, const Profile& profile, double least_edge_m) const {
  const AlikeGroup& found = group.found;
  if (found.areas.size() != 1) {
    group.fault = found.areas.empty() ? "it covers no ground" : "its ground falls apart";
    return;
  }
  if (!(found.roof_m > found.ground_m)) {
    group.fault = "it has no height";
    return;
  }
  const Tolerances tolerances;
  detail::UprightBlock block{outlines_to_draw(found.areas[0], profile.least_piece_m2),
                             found.ground_m, found.roof_m};
  const Outsiders outsiders(search_, found);
  const auto may_cover = [&](const Box& box) { return outsiders.are_clear_of(box); };
  const auto is_fixed = [&](Vec3 p, Vec3 q) { return outsiders.stand_against(p, q); };
  detail::simplify_outlines(block.outlines, {least_edge_m, tolerances.weld_m, may_cover, is_fixed});
  Building faces = detail::faces_of({block});
  faces.id = id(found.members.front());
  const auto findings = validate(faces);
  if (!findings.empty()) {
    group.fault = fmt::format("{} {}", to_string(findings[0].code), findings[0].sentence);
    return;
  }
  group.solid = detail::solid_of({block}, tolerances);
  if (!group.solid) group.fault = "no closed solid comes of its outline";
}

std::optional<CityGroups::Membership> CityGroups::place_of(const Neighbourhood& building) const {
  if (!building.self || group_of_[*building.self] < 0) return std::nullopt;
  const auto number = static_cast<std::size_t>(group_of_[*building.self]);
  const DrawnGroup& group = groups_[number];
  if (!group.solid) return std::nullopt;
  return Membership{group.found.members.front() == *building.self, number};
}

std::vector<std::string> CityGroups::members(std::size_t group) const {
  std::vector<std::string> ids;
  for (const std::size_t member : groups_[group].found.members) ids.push_back(id(member));
  return ids;
}

std::vector<Issue> CityGroups::issues_of(const Neighbourhood& building) const {
  std::vector<Issue> issues;
  if (!building.self) return issues;
  const std::size_t self = *building.self;
  const auto add = [&](Severity severity, Code code, std::string sentence) {
    issues.push_back(building_issue(severity, code, id(self), std::move(sentence)));
  };
  for (const std::size_t other : unlike_[self])
    add(Severity::note, Code::G423,
        fmt::format("adjoins '{}', but their roofs differ too much in height: both stay by "
                    "themselves",
                    id(other)));
  if (group_of_[self] < 0) return issues;
  const DrawnGroup& group = groups_[static_cast<std::size_t>(group_of_[self])];
  const std::size_t first = group.found.members.front(), others = group.found.members.size() - 1;
  if (group.solid && first == self)
    add(Severity::note, Code::G421,
        fmt::format("became one block with {}", counted(others, "other")));
  else if (group.solid)
    add(Severity::note, Code::G421, fmt::format("became part of '{}'", id(first)));
  else if (first == self)
    add(Severity::warning, Code::G422,
        fmt::format("and {} that {} it stay as they were, as they make no valid block: {}",
                    counted(others, "other"), agreeing(others, "adjoins", "adjoin"), group.fault));
  return issues;
}

Redrawn drawn_group(const LabelledBuilding& labelled, const Solid& solid,
                    std::span<const std::string> members) {
  Redrawn out;
  out.labelled.building = labelled.building;
  out.labelled.attributes = labelled.attributes;
  out.labelled.attributes.emplace_back("oriel_members", fmt::format("{}", fmt::join(members, ";")));
  for (const Facet& facet : solid.facets) {
    const auto up = solid.planes[facet.plane.index()].coefficients[2];
    out.labelled.surface_of_polygon.push_back(static_cast<int>(out.labelled.surfaces.size()));
    out.labelled.surfaces.push_back({up > 0   ? "RoofSurface"
                                     : up < 0 ? "GroundSurface"
                                              : "WallSurface",
                                     -1,
                                     {}});
  }
  out.labelled.geometry = solid;
  for (Facet& facet : out.labelled.geometry->facets) facet.polygons.clear();
  return out;
}

}  // namespace oriel
