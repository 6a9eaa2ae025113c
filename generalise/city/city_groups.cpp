#include "generalise/city/city_groups.h"

#include "kernel/base/text/counted.h"
#include "kernel/blocks/gabled_block.h"
#include "kernel/blocks/simplify_outlines.h"
#include "kernel/blocks/upright_block.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/planar.h"
#include "kernel/neighbours/detached_rows.h"
#include "kernel/validate/validate.h"
#include "model/tolerances.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace {

using detail::PlanArea;

constexpr double kMillimetreOnMap = 1e-3;
/// A building stands on ground that is to be kept free, not only at its rim (as buildings overlap,
/// E175).
constexpr double kOnKept_m2 = 0.5;
/// What a block gains of such ground is no more than rounding.
constexpr double kGained_m2 = 0.01;
/// A gable is higher, and so are walls under its eaves.
constexpr double kLeastGable_m = 0.5;
/// A facet is part of the roof or the ground, not upright, by its normal.
constexpr double kNotUpright = 0.1;

/// The outer outline, and courtyards that are not too small.
std::vector<Outline> outlines_to_draw(const PlanArea& area, double least_yard_m2) {
  std::vector<Outline> out{area.front()};
  for (std::size_t i = 1; i < area.size(); ++i)
    if (std::abs(signed_area(area[i], {0, 0, 1})) >= least_yard_m2) out.push_back(area[i]);
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
      for (auto& piece : moved_ground(*search.shaped(i).shape, moved_m))
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

namespace {

bool asks_for_rows(const Profile& profile, double scale) {
  return profile.groups && profile.groups->row_ratio > 0 &&
         scale >= profile.groups->rows_from_scale;
}

bool asks_for_blocks(const Profile& profile, double scale) {
  return profile.groups && scale >= profile.groups->from_scale;
}

using BuildingPairs = std::vector<std::pair<std::size_t, std::size_t>>;

BuildingPairs both_ways(BuildingPairs pairs) {
  const std::size_t count = pairs.size();
  for (std::size_t i = 0; i < count; ++i) pairs.emplace_back(pairs[i].second, pairs[i].first);
  std::ranges::sort(pairs);
  return pairs;
}

/// Those of which a building is the first.
auto of_pair(const BuildingPairs& pairs, std::size_t building) {
  return std::ranges::equal_range(pairs, building, {}, &BuildingPairs::value_type::first);
}

}  // namespace

/// What a solid is made of.
struct CityGroups::BlockForm {
  std::optional<UprightBlock> upright;
  std::optional<GabledBlock> gabled;
  double grid_m = 0;

  /// The faces of it; those of a gabled one are all that its solid is made of.
  [[nodiscard]] Building faces(const std::string& id) const {
    Building out = gabled ? faces_of(*gabled, grid_m) : faces_of({*upright});
    out.id = id;
    return out;
  }
  [[nodiscard]] std::optional<Solid> solid(const std::string& id) const {
    return gabled ? block_solid(faces(id), Tolerances{}) : block_solid({*upright}, Tolerances{});
  }
};

bool asks_for_groups(const Profile& profile, double scale) {
  return asks_for_blocks(profile, scale) || asks_for_rows(profile, scale);
}

CityGroups::CityGroups(const NeighbourSearch& search, const Profile& profile, double scale,
                       const ForEachShare& each, const KeptGround* kept)
    : search_(search), group_of_(search.size(), -1), kept_(kept) {
  if (asks_for_blocks(profile, scale)) find_blocks(profile, scale, each);
  if (asks_for_rows(profile, scale)) find_rows(profile);
}

void CityGroups::find_blocks(const Profile& profile, double scale, const ForEachShare& each) {
  // What is no longer than the gaps that are closed is not seen in an outline either.
  const double least_m = profile.groups->gap_mm * kMillimetreOnMap * scale;
  const GroupingLimits limits{least_m, profile.groups->like_height_m, kept_};
  AlikeGroups found = alike_groups(search_, limits);
  for (AlikeGroup& group : found.groups) {
    for (const std::size_t member : group.members)
      group_of_[member] = static_cast<int>(groups_.size());
    groups_.push_back({std::move(group), nullptr, false, Code::G422, {}});
    look_at_kept(groups_.back());
  }
  kept_apart_ = both_ways(found.kept_apart);
  unlike_ = both_ways(found.unlike);
  each(groups_.size(), [&](std::size_t i) {
    make_solid(groups_[i], profile, least_m);
    groups_[i].found.areas = {};
  });
}

/// Of buildings that nothing adjoins.
void CityGroups::find_rows(const Profile& profile) {
  const auto is_detached = [&](std::size_t i) {
    return group_of_[i] < 0 && of_pair(unlike_, i).empty();
  };
  for (const DetachedRow& row : detached_rows(search_, profile.groups->like_height_m, is_detached))
    add_row(row, profile.groups->row_ratio);
}

/// Those that stay are as far from each other as can be, both ends among them; the nearest one
/// along the row stands for each of the others.
void CityGroups::add_row(const std::vector<std::size_t>& row, double ratio) {
  const auto count = static_cast<double>(row.size());
  const auto staying = static_cast<std::size_t>(std::max(2.0, std::round(count * ratio)));
  if (staying >= row.size()) return;
  std::vector<std::size_t> places;
  for (std::size_t j = 0; j < staying; ++j)
    places.push_back((j * (row.size() - 1) + (staying - 1) / 2) / (staying - 1));
  const auto far = [](std::size_t p, std::size_t q) { return p > q ? p - q : q - p; };
  std::vector<std::pair<std::size_t, std::size_t>> members;  // and who stands for them
  for (std::size_t i = 0; i < row.size(); ++i)
    members.emplace_back(
        row[i],
        row[*std::ranges::min_element(places, {}, [&](std::size_t p) { return far(p, i); })]);
  std::ranges::sort(members);
  DrawnGroup& group = groups_.emplace_back();
  for (const auto& [member, by] : members) {
    group.found.members.push_back(member);
    group.stays.push_back(by);
    group_of_[member] = static_cast<int>(groups_.size()) - 1;
  }
}

/// Of a building of a row.
std::size_t CityGroups::standing_for(std::size_t building) const {
  const DrawnGroup& group = groups_[static_cast<std::size_t>(group_of_[building])];
  const auto found = std::ranges::lower_bound(group.found.members, building);
  return group.stays[static_cast<std::size_t>(found - group.found.members.begin())];
}

std::vector<std::string> CityGroups::stood_for(const Neighbourhood& building) const {
  std::vector<std::string> ids;
  if (!building.self || group_of_[*building.self] < 0) return ids;
  const DrawnGroup& group = groups_[static_cast<std::size_t>(group_of_[*building.self])];
  for (std::size_t i = 0; i < group.stays.size(); ++i)
    if (group.stays[i] == *building.self) ids.push_back(id(group.found.members[i]));
  return ids.size() > 1 ? ids : std::vector<std::string>{};
}

/// How much of it a building covers.
double CityGroups::on_kept_m2(std::size_t building) const {
  double sum_m2 = 0;
  for (const auto& piece : search_.shaped(building).shape->ground)
    sum_m2 += kept_->under_m2(piece, search_.buildings()[building].origin_m);
  return sum_m2;
}

/// How much of it the members of a group cover already.
void CityGroups::look_at_kept(DrawnGroup& group) {
  if (kept_ == nullptr) return;
  for (const std::size_t member : group.found.members) {
    const double sum_m2 = on_kept_m2(member);
    if (sum_m2 <= kOnKept_m2) continue;
    on_kept_m2_.emplace(member, sum_m2);
    group.code = Code::G440;
    group.fault = fmt::format("'{}' stands on ground that is to be kept free", id(member));
  }
}

bool CityGroups::covers_kept(DrawnGroup& group, const std::vector<Outline>& outlines) const {
  if (kept_ == nullptr) return false;
  double members_m2 = 0;
  for (const std::size_t member : group.found.members) members_m2 += on_kept_m2(member);
  const Vec3 origin_m = search_.buildings()[group.found.members.front()].origin_m;
  const double gained_m2 = kept_->under_m2(outlines, origin_m) - members_m2;
  if (gained_m2 <= kGained_m2) return false;
  group.code = Code::G440;
  group.fault =
      fmt::format("it would cover {:.2f} m2 of ground that is to be kept free", gained_m2);
  return true;
}

/// One gable over the whole block, if it is long enough for that and the members have such roofs.
void CityGroups::make_gabled(DrawnGroup& group, const std::vector<Outline>& outlines) const {
  const AlikeGroup& found = group.found;
  if (!found.gable || outlines.size() != 1) return;
  const auto outline = under_ridge(outlines[0], found.gable->ridge);
  const double eaves_m = found.gable->eaves_m, ridge_m = found.gable->ridge_m;
  if (!outline || ridge_m - eaves_m < kLeastGable_m || eaves_m - found.ground_m < kLeastGable_m)
    return;
  BlockForm form;
  form.gabled = {*outline, found.ground_m, eaves_m, ridge_m};
  form.grid_m = found.grid_m;
  const std::string& first = id(found.members.front());
  if (!validate(form.faces(first)).empty() || !form.solid(first)) return;
  group.form = std::make_shared<const BlockForm>(std::move(form));
  group.is_gabled = true;
}

Solid CityGroups::solid(std::size_t group) const {
  const DrawnGroup& drawn = groups_[group];
  return *drawn.form->solid(id(drawn.found.members.front()));
}

void CityGroups::make_solid(DrawnGroup& group, const Profile& profile, double least_edge_m) const {
  const AlikeGroup& found = group.found;
  if (!group.fault.empty()) return;
  if (found.used_up > 0) {
    group.code = Code::E502;
    group.fault =
        fmt::format("uniting its ground used up the work budget of {} steps", found.used_up);
    return;
  }
  if (found.areas.size() != 1) {
    group.fault = found.areas.empty() ? "it covers no ground" : "its ground falls apart";
    return;
  }
  if (!(found.roof_m > found.ground_m)) {
    group.fault = "it has no height";
    return;
  }
  const Tolerances tolerances;
  UprightBlock block{outlines_to_draw(found.areas[0], profile.least_piece_m2), found.ground_m,
                     found.roof_m};
  const Outsiders outsiders(search_, found);
  const Vec3 origin_m = search_.buildings()[found.members.front()].origin_m;
  const auto may_cover = [&](const Box& box) {
    if (!outsiders.are_clear_of(box)) return false;
    const Outline around{{box.min.x, box.min.y, 0},
                         {box.max.x, box.min.y, 0},
                         {box.max.x, box.max.y, 0},
                         {box.min.x, box.max.y, 0}};
    return kept_ == nullptr || kept_->under_m2(std::span(&around, 1), origin_m) <= kGained_m2;
  };
  const auto is_fixed = [&](Vec3 p, Vec3 q) { return outsiders.stand_against(p, q); };
  simplify_outlines(block.outlines, {least_edge_m, tolerances.weld_m, may_cover, is_fixed});
  if (covers_kept(group, block.outlines)) return;
  make_gabled(group, block.outlines);
  if (group.is_gabled) return;
  BlockForm form;
  form.upright = std::move(block);
  const std::string& first = id(found.members.front());
  const auto findings = validate(form.faces(first));
  if (!findings.empty()) {
    group.fault = fmt::format("{} {}", to_string(findings[0].code), findings[0].sentence);
    return;
  }
  if (form.solid(first))
    group.form = std::make_shared<const BlockForm>(std::move(form));
  else
    group.fault = "no closed solid comes of its outline";
}

std::optional<CityGroups::Membership> CityGroups::place_of(const Neighbourhood& building) const {
  if (!building.self || group_of_[*building.self] < 0) return std::nullopt;
  const auto number = static_cast<std::size_t>(group_of_[*building.self]);
  const DrawnGroup& group = groups_[number];
  if (is_row(number)) {
    const std::size_t by = standing_for(*building.self);
    return by == *building.self ? std::nullopt : std::optional(Membership{false, number, by});
  }
  if (!group.form) return std::nullopt;
  const std::size_t leader = group.found.members.front();
  return Membership{leader == *building.self, number, leader};
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
  for (const auto& [_, other] : of_pair(unlike_, self))
    add(Severity::note, Code::G423,
        fmt::format("adjoins '{}', but their roofs differ too much in height: both stay by "
                    "themselves",
                    id(other)));
  for (const auto& [_, other] : of_pair(kept_apart_, self))
    add(Severity::note, Code::G440,
        fmt::format("stays apart from '{}': the gap between them is ground that is to be kept free",
                    id(other)));
  if (const auto on_kept = on_kept_m2_.find(self); on_kept != on_kept_m2_.end())
    add(Severity::warning, Code::E191,
        fmt::format("covers {:.2f} m2 of ground that is to be kept free", on_kept->second));
  if (group_of_[self] < 0) return issues;
  const DrawnGroup& group = groups_[static_cast<std::size_t>(group_of_[self])];
  const std::size_t first = group.found.members.front(), others = group.found.members.size() - 1;
  if (!group.stays.empty()) {
    const std::size_t by = standing_for(self);
    if (by != self)
      add(Severity::note, Code::G421,
          fmt::format("is left out of a row of {} buildings: '{}' stands for it", others + 1,
                      id(by)));
    return issues;
  }
  if (group.form && first == self)
    add(Severity::note, Code::G421,
        fmt::format("became one block with {}{}", counted(others, "other"),
                    group.is_gabled ? ", under one gable" : ""));
  else if (group.form)
    add(Severity::note, Code::G421, fmt::format("became part of '{}'", id(first)));
  else if (first == self)
    add(Severity::warning, group.code,
        fmt::format("and {} that {} it stay as they were, as no block comes of them: {}",
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
    const auto& plane = solid.planes[facet.plane.index()].coefficients;
    const double up = normalised(Vec3{static_cast<double>(plane[0]), static_cast<double>(plane[1]),
                                      static_cast<double>(plane[2])})
                          .z;
    out.labelled.surface_of_polygon.push_back(static_cast<int>(out.labelled.surfaces.size()));
    out.labelled.surfaces.push_back({up > kNotUpright    ? "RoofSurface"
                                     : up < -kNotUpright ? "GroundSurface"
                                                         : "WallSurface",
                                     -1,
                                     {}});
  }
  out.labelled.geometry = solid;
  for (Facet& facet : out.labelled.geometry->facets) facet.polygons.clear();
  return out;
}

}  // namespace oriel
