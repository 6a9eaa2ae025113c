#include "kernel/neighbours/neighbours.h"

#include "kernel/base/sha256.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/geometry/shared_area.h"
#include "kernel/neighbours/before_wall.h"
#include "kernel/neighbours/contacts.h"
#include "kernel/neighbours/shape_store.h"
#include "model/tolerances.h"

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
std::string key_of(const StandingBuilding& building, const StandingShape& shape,
                   const std::string& crs) {
  std::string bytes = building.id + '\n' + crs + '\n';
  append_outlines(bytes, {{building.origin_m, building.box.min, building.box.max}});
  for (const UprightWall& wall : shape.walls) append_outlines(bytes, wall.outlines);
  for (const auto& piece : shape.ground) append_outlines(bytes, piece);
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
  const double all_m2 = std::abs(figure_area_m2(figure, normal));
  if (!(all_m2 > 0)) return 0;
  double shared_m2 = 0;
  for (const NeighbourWall& wall : walls) {
    if (length(wall.normal + normal) > kPartyWallLean ||
        std::abs(dot(figure[0][0] - wall.outlines[0][0], normal)) > kContact_m)
      continue;
    shared_m2 += shared_area_m2(figure, wall.outlines, normal);
  }
  return std::min(1.0, shared_m2 / all_m2);
}

NeighbourSearch::NeighbourSearch(ScratchSpace scratch)
    : shapes_(std::make_unique<detail::ShapeStore>(
          scratch.held_bytes, scratch_folder(scratch.beside.empty() ? "-" : scratch.beside))) {}

NeighbourSearch::~NeighbourSearch() = default;
NeighbourSearch::NeighbourSearch(NeighbourSearch&&) noexcept = default;
NeighbourSearch& NeighbourSearch::operator=(NeighbourSearch&&) noexcept = default;

void NeighbourSearch::add(const Building& building) {
  auto [known, shape] = standing_building(building);
  const auto number = static_cast<int>(systems_.size());
  known.system = systems_.try_emplace(building.frame.crs, number).first->second;
  keys_.push_back(key_of(known, shape, building.frame.crs));
  standing_.push_back(std::move(known));
  shapes_->add(std::move(shape));
}

/// As which number each of those that stay was added.
std::vector<std::size_t> NeighbourSearch::drop_repeated() {
  std::vector<std::size_t> order(standing_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto by_id = [&](std::size_t i) { return std::tie(standing_[i].id, keys_[i]); };
  std::ranges::sort(order, {}, by_id);
  const auto [first, end] = std::ranges::unique(order, {}, by_id);
  order.erase(first, end);
  std::vector<StandingBuilding> kept;
  kept.reserve(order.size());
  Sha256 all;
  for (const std::size_t i : order) {
    all.add(keys_[i]);
    kept.push_back(std::move(standing_[i]));
  }
  standing_ = std::move(kept);
  sha256_ = all.digest();
  for (std::size_t i = 0, k = 0; i < order.size(); i = k) {
    while (k < order.size() && standing_[k].id == standing_[i].id) ++k;
    if (k - i == 1) continue;
    for (std::size_t j = i; j < k; ++j) repeated_.emplace(keys_[order[j]], j);
    issues_.push_back(about_building(
        Code::E179, standing_[i].id,
        fmt::format("is the id of {} different buildings: each is a neighbour of the others",
                    k - i)));
  }
  keys_ = {};
  return order;
}

void NeighbourSearch::tell_systems() {
  if (systems_.size() < 2) return;
  std::vector<std::size_t> count(systems_.size());
  for (const StandingBuilding& building : standing_)
    ++count[static_cast<std::size_t>(building.system)];
  const auto most = std::ranges::max_element(
      systems_, {}, [&](const auto& e) { return count[static_cast<std::size_t>(e.second)]; });
  for (const auto& building : standing_) {
    if (building.system == most->second) continue;
    const auto own =
        std::ranges::find(systems_, building.system, [](const auto& e) { return e.second; });
    issues_.push_back(about_building(
        Code::E177, building.id,
        fmt::format("has coordinates in '{}', most buildings in '{}': neighbours are looked for "
                    "among those of one system",
                    own->first, most->first)));
  }
}

void NeighbourSearch::finish() {
  const std::vector<std::size_t> kept = drop_repeated();
  tell_systems();
  std::vector<Box> grounds;
  grounds.reserve(size());
  for (const StandingBuilding& building : standing_)
    grounds.push_back(flat(box_in_input(building)));
  tree_.emplace(std::move(grounds));
  by_place_.reserve(size());
  tree_->search([](const Box&) { return true; },
                [&](int i) { by_place_.push_back(static_cast<std::size_t>(i)); });
  shapes_->arrange(kept, by_place_);
  unite_touching();
}

void NeighbourSearch::unite_touching() {
  DisjointSets sets(size());
  std::vector<char> does_touch(size(), 0);
  for (const std::size_t i : by_place_) {
    const ShapedBuilding own = shaped(i);
    for (const std::size_t k : near_boxes(own.known, i)) {
      if (k < i || sets.find(static_cast<int>(i)) == sets.find(static_cast<int>(k))) continue;
      if (detail::contact_between(own, shaped(k), nullptr).area_m2 < kContact_m2) continue;
      sets.unite(static_cast<int>(i), static_cast<int>(k));
      does_touch[i] = does_touch[k] = 1;
    }
  }
  group_of_.assign(size(), -1);
  for (std::size_t i = 0; i < size(); ++i) {
    if (does_touch[i] == 0) continue;
    const auto first = static_cast<std::size_t>(sets.find(static_cast<int>(i)));
    if (first == i) {
      group_of_[i] = static_cast<int>(groups_.size());
      groups_.emplace_back();
    }
    TouchingGroup& group = groups_[static_cast<std::size_t>(group_of_[i] = group_of_[first])];
    group.members.push_back(i);
    group.box.grow(box_in_input(standing_[i]));
  }
  for (const std::size_t i : by_place_)
    if (const auto number = group_of_[i]; number >= 0) {
      TouchingGroup& group = groups_[static_cast<std::size_t>(number)];
      if (group.members.front() == i && group.members.size() > 2) find_yards(group);
    }
}

ShapedBuilding NeighbourSearch::shaped(std::size_t building) const {
  return {standing_[building], shapes_->at(building)};
}

/// Null: it touches none.
const NeighbourSearch::TouchingGroup* NeighbourSearch::group_of(std::size_t building) const {
  const int number = group_of_[building];
  return number < 0 ? nullptr : &groups_[static_cast<std::size_t>(number)];
}

/// Houses around a yard are three at least.
void NeighbourSearch::find_yards(TouchingGroup& group) {
  const Vec3 origin_m = standing_[group.members.front()].origin_m;
  std::vector<detail::PlanArea> grounds;
  for (const std::size_t member : group.members)
    for (auto& piece : moved_ground(*shapes_->at(member), standing_[member].origin_m - origin_m))
      grounds.push_back(std::move(piece));
  Work work(kWorkBudget * std::ssize(group.members));
  for (const detail::PlanArea& area : detail::united(grounds, kContact_m, work))
    group.yards.insert(group.yards.end(), area.begin() + 1, area.end());
  if (work.is_used_up())
    issues_.push_back(used_up(standing_[group.members.front()].id, work.budget(),
                              "finding the courtyards of its group",
                              "walls that only its outlines would show to face one count as facing "
                              "the street"));
}

std::optional<std::size_t> NeighbourSearch::find(const ShapedBuilding& building,
                                                 const std::string& crs) const {
  const auto same =
      std::ranges::equal_range(standing_, building.known.id, {}, &StandingBuilding::id);
  if (same.empty()) return std::nullopt;
  if (same.size() == 1) return static_cast<std::size_t>(same.begin() - standing_.begin());
  const auto found = repeated_.find(key_of(building.known, *building.shape, crs));
  if (found == repeated_.end()) return std::nullopt;
  return found->second;
}

/// Ascending.
std::vector<std::size_t> NeighbourSearch::near_boxes(const StandingBuilding& own,
                                                     std::optional<std::size_t> self) const {
  std::vector<std::size_t> out;
  const Box reach = grown(box_in_input(own), kContact_m);
  tree_->for_each_overlap(flat(reach), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    if (k != self && standing_[k].system == own.system &&
        overlap(reach, box_in_input(standing_[k])))
      out.push_back(k);
  });
  std::ranges::sort(out);
  return out;
}

Neighbourhood NeighbourSearch::of(const Building& building) const {
  auto [known, shape] = standing_building(building);
  if (const auto found = systems_.find(building.frame.crs); found != systems_.end())
    known.system = found->second;
  const ShapedBuilding own{known, std::make_shared<const StandingShape>(std::move(shape))};
  Neighbourhood out;
  out.self = find(own, building.frame.crs);
  out.origin_m = known.origin_m;
  for (const std::size_t k : near_boxes(known, out.self)) {
    const ShapedBuilding other = shaped(k);
    std::vector<NeighbourWall> walls;
    BuildingContact contact = detail::contact_between(own, other, &walls);
    contact.overlap_m2 = detail::common_ground_m2(own, other);
    const bool do_touch = contact.area_m2 >= kContact_m2;
    if (!do_touch) contact.area_m2 = 0;
    if (!do_touch && contact.overlap_m2 <= kOverlap_m2) continue;
    if (do_touch) std::ranges::move(walls, std::back_inserter(out.walls));
    out.contacts.push_back(std::move(contact));
  }
  out.issues = issues_of(known, out.contacts);
  return out;
}

std::optional<Outlook> NeighbourSearch::outlook(const Neighbourhood& of, Vec3 point,
                                                Vec3 normal) const {
  const Vec3 level{normal.x, normal.y, 0};
  if (!of.self || length(level) < kLeastRun) return std::nullopt;
  const Vec3 along = normalised(level);
  Vec3 from = Vec3{point.x, point.y, 0} + kStep_m * along;
  const auto shape = shapes_->at(*of.self);
  const auto& own = shape->ground;
  // A wall on the roof, as of a dormer, looks out over the building's own ground.
  if (detail::is_on_ground(own, from))
    if (const auto out_m = detail::first_crossing_m(own, from, along, Box::kInfinity))
      from = from + (*out_m + kStep_m) * along;
  if (is_on_other(of, from)) return Outlook::roof;
  const TouchingGroup* group = group_of(*of.self);
  if (group == nullptr) return Outlook::street;
  const Vec3 in_group = from + of.origin_m - standing_[group->members.front()].origin_m;
  for (const Outline& yard : group->yards)
    if (contains(std::span(&yard, 1), {0, 0, 1}, {in_group.x, in_group.y, 0})) return Outlook::yard;
  const bool is_enclosed = std::ranges::all_of(kWays, [&](const std::array<double, 2>& way) {
    const auto [ahead, aside] = way;
    return meets_group(of, from, ahead * along + aside * Vec3{-along.y, along.x, 0});
  });
  return is_enclosed ? Outlook::yard : Outlook::street;
}

bool NeighbourSearch::is_on_other(const Neighbourhood& of, Vec3 from) const {
  bool is_on = false;
  const Vec3 in_input{from.x + of.origin_m.x, from.y + of.origin_m.y, 0};
  tree_->for_each_overlap({in_input, in_input}, [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    if (k == *of.self || standing_[k].system != standing_[*of.self].system || is_on) return;
    is_on = detail::is_on_ground(moved_ground(*shapes_->at(k), standing_[k].origin_m - of.origin_m),
                                 from);
  });
  return is_on;
}

/// The building touches others; its own ground is looked through.
bool NeighbourSearch::meets_group(const Neighbourhood& of, Vec3 from, Vec3 along) const {
  const std::size_t self = *of.self;
  const Box& around = group_of(self)->box;
  const double reach_m = length(around.max - around.min);
  const Vec3 in_input{from.x + of.origin_m.x, from.y + of.origin_m.y, 0};
  std::optional<double> nearest_m;
  bool is_of_group = false;
  const auto look_at = [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    if (k == self || standing_[k].system != standing_[self].system) return;
    const auto ground = moved_ground(*shapes_->at(k), standing_[k].origin_m - of.origin_m);
    const auto at_m = detail::first_crossing_m(ground, from, along, reach_m);
    if (!at_m || (nearest_m && *nearest_m <= *at_m)) return;
    nearest_m = at_m;
    is_of_group = group_of_[k] == group_of_[self];
  };
  tree_->search(
      [&](const Box& box) {
        return comes_near(box, in_input, in_input + reach_m * along, kContact_m);
      },
      look_at);
  return is_of_group;
}

bool NeighbourSearch::is_built_on(const Neighbourhood& of, const Box& local_m) const {
  bool is_built = false;
  tree_->for_each_overlap(flat(local_m.moved(of.origin_m)), [&](int i) {
    is_built = is_built || static_cast<std::size_t>(i) != of.self;
  });
  return is_built;
}

std::vector<std::size_t> NeighbourSearch::standing_in(const Box& input_m) const {
  std::vector<std::size_t> out;
  tree_->for_each_overlap(flat(input_m),
                          [&](int i) { out.push_back(static_cast<std::size_t>(i)); });
  std::ranges::sort(out);
  return out;
}

std::vector<std::size_t> NeighbourSearch::near(std::size_t building, double reach_m) const {
  std::vector<std::size_t> out;
  tree_->for_each_overlap(grown(flat(box_in_input(standing_[building])), reach_m), [&](int i) {
    if (static_cast<std::size_t>(i) != building) out.push_back(static_cast<std::size_t>(i));
  });
  std::ranges::sort(out);
  return out;
}

}  // namespace oriel
