#include "kernel/neighbours/neighbours.h"

#include "kernel/base/sha256.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/geometry/shared_area.h"
#include "kernel/model/tolerances.h"
#include "kernel/neighbours/before_wall.h"
#include "kernel/neighbours/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using detail::Outline;

/// Buildings overlap if they share more ground: walls ten metres long that touch kContact_m into
/// each other.
constexpr double kOverlap_m2 = 0.5;
/// A building stands in another one if so much of its ground is the other's.
constexpr double kInside = 0.99;
/// A wall stands over what is this near before it.
constexpr double kStep_m = kContact_m + 0.01;
/// Where one looks from a wall, ahead and aside: straight on, and at 45 degrees to both sides.
constexpr double kHalfRight = 0.70710678118654752;
constexpr std::array<std::array<double, 2>, 3> kWays{
    {{1, 0}, {kHalfRight, kHalfRight}, {kHalfRight, -kHalfRight}}};
/// So nearly upright normals look nowhere.
constexpr double kLeastRun = 0.05;

void append_number(std::string& bytes, double value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof raw);
}

void append_outlines(std::string& bytes, const std::vector<Outline>& outlines) {
  for (const Outline& outline : outlines) {
    append_number(bytes, static_cast<double>(outline.size()));
    for (const Vec3 p : outline) {
      append_number(bytes, p.x);
      append_number(bytes, p.y);
      append_number(bytes, p.z);
    }
  }
}

/// All that is kept of a building, as a hash.
std::string key_of(const StandingBuilding& building) {
  std::string bytes = building.id + '\n' + building.crs + '\n';
  append_outlines(bytes, {{building.origin_m, building.box.min, building.box.max}});
  for (const UprightWall& wall : building.walls) append_outlines(bytes, wall.outlines);
  for (const auto& piece : building.ground) append_outlines(bytes, piece);
  append_number(bytes, building.roof_m);
  if (building.gable)
    append_outlines(
        bytes, {{building.gable->ridge, {building.gable->ridge_m, building.gable->eaves_m, 0}}});
  return sha256(bytes);
}

Box flat(Box box) {
  if (box.is_empty()) return box;
  box.min.z = box.max.z = 0;
  return box;
}

/// An empty box would be a hole in the tree: a building without polygons stands at its origin.
Box box_in_input(const StandingBuilding& building) {
  if (building.box.is_empty()) return {building.origin_m, building.origin_m};
  return building.box.moved(building.origin_m);
}

std::vector<Issue> issues_of(const StandingBuilding& own,
                             const std::vector<BuildingContact>& contacts) {
  std::vector<Issue> out;
  for (const BuildingContact& contact : contacts) {
    if (contact.overlap_m2 >= kInside * own.ground_m2 && contact.overlap_m2 > kOverlap_m2)
      out.push_back(
          building_issue(Severity::warning, Code::E176, own.id,
                         fmt::format("stands in '{}', which covers its ground", contact.building)));
    else if (contact.overlap_m2 > kOverlap_m2)
      out.push_back(building_issue(Severity::warning, Code::E175, own.id,
                                   fmt::format("overlaps '{}': both cover {:.2f} m2 of ground",
                                               contact.building, contact.overlap_m2)));
    else if (contact.area_m2 > 0 && contact.widest_m > kPartyWall_m)
      out.push_back(
          building_issue(Severity::note, Code::E178, own.id,
                         fmt::format("touches '{}' with walls that are up to {:.0f} mm apart",
                                     contact.building, 1000 * contact.widest_m)));
  }
  return out;
}

Issue about_building(Code code, const std::string& id, std::string sentence) {
  return building_issue(Severity::warning, code, id, std::move(sentence));
}

}  // namespace

double Neighbourhood::covered_share(std::span<const Outline> figure, Vec3 normal) const {
  const double all_m2 = std::abs(detail::figure_area_m2(figure, normal));
  if (!(all_m2 > 0)) return 0;
  double shared_m2 = 0;
  for (const NeighbourWall& wall : walls) {
    if (length(wall.normal + normal) > kPartyWallLean ||
        std::abs(dot(figure[0][0] - wall.outlines[0][0], normal)) > kContact_m)
      continue;
    shared_m2 += detail::shared_area_m2(figure, wall.outlines, normal);
  }
  return std::min(1.0, shared_m2 / all_m2);
}

void NeighbourSearch::add(const Building& building) {
  standing_.push_back(standing_building(building));
  keys_.push_back(key_of(standing_.back()));
}

void NeighbourSearch::drop_repeated() {
  std::vector<std::size_t> order(standing_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::tie(standing_[i].id, keys_[i]); });
  std::vector<StandingBuilding> kept;
  std::vector<std::string> keys;
  for (const std::size_t i : order) {
    if (!by_key_.try_emplace(keys_[i], kept.size()).second) continue;
    by_id_[standing_[i].id].push_back(kept.size());
    kept.push_back(std::move(standing_[i]));
    keys.push_back(std::move(keys_[i]));
  }
  standing_ = std::move(kept);
  keys_ = std::move(keys);
  std::string all;
  for (const std::string& key : keys_) all += key;
  sha256_ = oriel::sha256(all);
  for (const auto& [id, places] : by_id_)
    if (places.size() > 1)
      issues_.push_back(about_building(
          Code::E179, id,
          fmt::format("is the id of {} different buildings: each is a neighbour of the others",
                      places.size())));
}

void NeighbourSearch::finish() {
  drop_repeated();
  std::map<std::string, std::size_t> systems;
  for (const StandingBuilding& building : standing_) ++systems[building.crs];
  if (systems.size() > 1) {
    const auto most = std::ranges::max_element(systems, {}, [](const auto& e) { return e.second; });
    for (const StandingBuilding& building : standing_)
      if (building.crs != most->first)
        issues_.push_back(about_building(
            Code::E177, building.id,
            fmt::format("has coordinates in '{}', most buildings in '{}': neighbours are looked "
                        "for among those of one system",
                        building.crs, most->first)));
  }
  std::vector<Box> boxes, grounds;
  for (const StandingBuilding& building : standing_) {
    boxes.push_back(box_in_input(building));
    grounds.push_back(flat(boxes.back()));
  }
  tree_.emplace(std::move(boxes));
  ground_tree_.emplace(std::move(grounds));
  find_groups();
}

void NeighbourSearch::find_groups() {
  detail::DisjointSets sets(standing_.size());
  for (std::size_t i = 0; i < standing_.size(); ++i)
    for (const std::size_t k : near_boxes(box_in_input(standing_[i]), standing_[i], i)) {
      if (k < i || sets.find(static_cast<int>(i)) == sets.find(static_cast<int>(k))) continue;
      const Vec3 moved_m = standing_[k].origin_m - standing_[i].origin_m;
      const BuildingContact contact =
          detail::contact_between(standing_[i], standing_[k], moved_m, nullptr);
      if (contact.area_m2 >= kContact_m2) sets.unite(static_cast<int>(i), static_cast<int>(k));
    }
  std::map<int, std::size_t> number_of;
  for (std::size_t i = 0; i < standing_.size(); ++i) {
    const auto [entry, is_new] =
        number_of.try_emplace(sets.find(static_cast<int>(i)), groups_.size());
    if (is_new) groups_.emplace_back();
    TouchingGroup& group = groups_[entry->second];
    group.members.push_back(i);
    group.box.grow(box_in_input(standing_[i]));
    group_of_.push_back(entry->second);
  }
  for (TouchingGroup& group : groups_)
    if (group.members.size() > 2) find_yards(group);
}

/// Houses around a yard are three at least.
void NeighbourSearch::find_yards(TouchingGroup& group) const {
  const Vec3 origin_m = standing_[group.members.front()].origin_m;
  std::vector<detail::PlanArea> grounds;
  for (const std::size_t member : group.members)
    for (auto& piece : moved_ground(standing_[member], standing_[member].origin_m - origin_m))
      grounds.push_back(std::move(piece));
  for (const detail::PlanArea& area : detail::united(grounds, kContact_m))
    group.yards.insert(group.yards.end(), area.begin() + 1, area.end());
}

std::optional<std::size_t> NeighbourSearch::find(const StandingBuilding& building) const {
  const auto found = by_id_.find(building.id);
  if (found == by_id_.end()) return std::nullopt;
  if (found->second.size() == 1) return found->second.front();
  const auto by_key = by_key_.find(key_of(building));
  if (by_key == by_key_.end()) return std::nullopt;
  return by_key->second;
}

/// Ascending.
std::vector<std::size_t> NeighbourSearch::near_boxes(const Box& box, const StandingBuilding& own,
                                                     std::optional<std::size_t> self) const {
  std::vector<std::size_t> out;
  tree_->for_each_overlap(grown(box, kContact_m), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    if (k != self && standing_[k].crs == own.crs) out.push_back(k);
  });
  std::ranges::sort(out);
  return out;
}

Neighbourhood NeighbourSearch::of(const Building& building) const {
  const StandingBuilding own = standing_building(building);
  Neighbourhood out;
  out.self = find(own);
  out.origin_m = own.origin_m;
  for (const std::size_t k : near_boxes(box_in_input(own), own, out.self)) {
    const Vec3 moved_m = standing_[k].origin_m - own.origin_m;
    std::vector<NeighbourWall> walls;
    BuildingContact contact = detail::contact_between(own, standing_[k], moved_m, &walls);
    contact.overlap_m2 = detail::common_ground_m2(own, standing_[k], moved_m);
    const bool do_touch = contact.area_m2 >= kContact_m2;
    if (!do_touch) contact.area_m2 = 0;
    if (!do_touch && contact.overlap_m2 <= kOverlap_m2) continue;
    if (do_touch) std::ranges::move(walls, std::back_inserter(out.walls));
    out.contacts.push_back(std::move(contact));
  }
  out.issues = issues_of(own, out.contacts);
  return out;
}

std::optional<Outlook> NeighbourSearch::outlook(const Neighbourhood& of, Vec3 point,
                                                Vec3 normal) const {
  const Vec3 level{normal.x, normal.y, 0};
  if (!of.self || length(level) < kLeastRun) return std::nullopt;
  const Vec3 along = normalised(level);
  Vec3 from = Vec3{point.x, point.y, 0} + kStep_m * along;
  const auto& own = standing_[*of.self].ground;
  // A wall on the roof, as of a dormer, looks out over the building's own ground.
  if (detail::is_on_ground(own, from))
    if (const auto out_m = detail::first_crossing_m(own, from, along, Box::kInfinity))
      from = from + (*out_m + kStep_m) * along;
  if (is_on_other(of, from)) return Outlook::roof;
  const TouchingGroup& group = groups_[group_of_[*of.self]];
  const Vec3 in_group = from + of.origin_m - standing_[group.members.front()].origin_m;
  for (const Outline& yard : group.yards)
    if (detail::contains(std::span(&yard, 1), {0, 0, 1}, {in_group.x, in_group.y, 0}))
      return Outlook::yard;
  const bool is_enclosed = std::ranges::all_of(kWays, [&](const std::array<double, 2>& way) {
    const auto [ahead, aside] = way;
    return meets_group(of, from, ahead * along + aside * Vec3{-along.y, along.x, 0});
  });
  return is_enclosed ? Outlook::yard : Outlook::street;
}

bool NeighbourSearch::is_on_other(const Neighbourhood& of, Vec3 from) const {
  bool is_on = false;
  const Vec3 in_input{from.x + of.origin_m.x, from.y + of.origin_m.y, 0};
  ground_tree_->for_each_overlap({in_input, in_input}, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    if (k == *of.self || standing_[k].crs != standing_[*of.self].crs || is_on) return;
    is_on =
        detail::is_on_ground(moved_ground(standing_[k], standing_[k].origin_m - of.origin_m), from);
  });
  return is_on;
}

/// The building's own ground is looked through.
bool NeighbourSearch::meets_group(const Neighbourhood& of, Vec3 from, Vec3 along) const {
  const std::size_t self = *of.self;
  const TouchingGroup& group = groups_[group_of_[self]];
  if (group.members.size() < 2) return false;
  const double reach_m = length(group.box.max - group.box.min);
  const Vec3 in_input{from.x + of.origin_m.x, from.y + of.origin_m.y, 0};
  std::optional<double> nearest_m;
  bool is_of_group = false;
  const auto look_at = [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    if (k == self || standing_[k].crs != standing_[self].crs) return;
    const auto ground = moved_ground(standing_[k], standing_[k].origin_m - of.origin_m);
    const auto at_m = detail::first_crossing_m(ground, from, along, reach_m);
    if (!at_m || (nearest_m && *nearest_m <= *at_m)) return;
    nearest_m = at_m;
    is_of_group = group_of_[k] == group_of_[self];
  };
  ground_tree_->search(
      [&](const Box& box) {
        return detail::comes_near(box, in_input, in_input + reach_m * along, kContact_m);
      },
      look_at);
  return is_of_group;
}

bool NeighbourSearch::is_built_on(const Neighbourhood& of, const Box& local_m) const {
  bool is_built = false;
  ground_tree_->for_each_overlap(flat(local_m.moved(of.origin_m)), [&](int i) {
    is_built = is_built || static_cast<std::size_t>(i) != of.self;
  });
  return is_built;
}

std::vector<std::size_t> NeighbourSearch::standing_in(const Box& input_m) const {
  std::vector<std::size_t> out;
  ground_tree_->for_each_overlap(flat(input_m),
                                 [&](int i) { out.push_back(static_cast<std::size_t>(i)); });
  std::ranges::sort(out);
  return out;
}

std::vector<std::size_t> NeighbourSearch::near(std::size_t building, double reach_m) const {
  std::vector<std::size_t> out;
  ground_tree_->for_each_overlap(grown(flat(box_in_input(standing_[building])), reach_m),
                                 [&](int i) {
                                   if (static_cast<std::size_t>(i) != building)
                                     out.push_back(static_cast<std::size_t>(i));
                                 });
  std::ranges::sort(out);
  return out;
}

}  // namespace oriel
