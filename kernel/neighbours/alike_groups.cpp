#include "kernel/neighbours/alike_groups.h"

#include "kernel/geometry/disjoint_sets.h"
#include "kernel/geometry/shared_area.h"
#include "kernel/neighbours/contacts.h"
#include "model/tolerances.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace oriel {

namespace {

using detail::PlanArea;

/// Walls across a gap that is closed run against each other to 10 degrees, as short edges of
/// outlines do (kernel/blocks/simplify_outlines).
constexpr double kGapLean = 0.1736;
/// A strip that covers more of a third building's ground does not only touch it.
constexpr double kCovered_m2 = 0.01;

/// Ridges run alike to 10 degrees.
constexpr double kRidgeLean = 0.1736;

double shared_ground_m2(const PlanArea& strip, const std::vector<PlanArea>& ground) {
  double sum_m2 = 0;
  for (const PlanArea& area : ground) sum_m2 += shared_area_m2(strip, area, {0, 0, 1});
  return sum_m2;
}

bool is_whole(double value_m, double grid_m) {
  const double steps = value_m / grid_m;
  return std::abs(steps - std::round(steps)) <= kOffGrid;
}

double grid_of(const std::vector<PlanArea>& areas) {
  for (const PlanArea& area : areas)
    for (const Outline& outline : area)
      for (const Vec3 p : outline)
        if (!is_whole(p.x, kMillimetreGrid_m) || !is_whole(p.y, kMillimetreGrid_m))
          return kMicrometreGrid_m;
  return kMillimetreGrid_m;
}

double rounded_to(double value_m, double grid_m) { return std::round(value_m / grid_m) * grid_m; }

class GroupFinder {
 public:
  GroupFinder(const NeighbourSearch& search, const GroupingLimits& limits)
      : search_(search), limits_(limits), sets_(search.size()) {}

  AlikeGroups run() {
    for (const std::size_t i : search_.by_place())
      for (const std::size_t k : search_.near(i, reach_m()))
        if (k > i) join(i, k);
    std::ranges::sort(out_.unlike);
    std::ranges::sort(out_.kept_apart);
    std::map<int, std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < search_.size(); ++i)
      members[sets_.find(static_cast<int>(i))].push_back(i);
    for (auto& [first, of_group] : members)
      if (of_group.size() > 1) out_.groups.push_back(group_of(std::move(of_group)));
    return std::move(out_);
  }

 private:
  [[nodiscard]] const StandingBuilding& at(std::size_t i) const { return search_.buildings()[i]; }
  /// In a frame with that origin.
  [[nodiscard]] std::vector<PlanArea> ground_of(std::size_t i, Vec3 origin_m) const {
    return moved_ground(*search_.shaped(i).shape, at(i).origin_m - origin_m);
  }
  /// A crack between walls that touch is closed, too.
  [[nodiscard]] double reach_m() const { return std::max(limits_.gap_m, kContact_m); }

  void join(std::size_t i, std::size_t k) {
    const ShapedBuilding one = search_.shaped(i), other = search_.shaped(k);
    if (one.known.system != other.known.system || one.shape->ground.empty() ||
        other.shape->ground.empty())
      return;
    std::vector<PlanArea> strips = strips_between(i, k);
    const bool has_gap = !strips.empty();
    if (limits_.kept != nullptr)
      std::erase_if(strips, [&](const PlanArea& strip) {
        return limits_.kept->under_m2(strip, at(i).origin_m) > kCovered_m2;
      });
    const bool does_touch = detail::contact_between(one, other, nullptr).area_m2 >= kContact_m2;
    if (!does_touch && strips.empty()) {
      if (has_gap) out_.kept_apart.emplace_back(i, k);
      return;
    }
    const double apart_m =
        std::abs(at(i).roof_m + at(i).origin_m.z - at(k).roof_m - at(k).origin_m.z);
    if (apart_m > limits_.like_height_m) {
      out_.unlike.emplace_back(i, k);
      return;
    }
    sets_.unite(static_cast<int>(i), static_cast<int>(k));
    strips_[{i, k}] = std::move(strips);
  }

  /// In the frame of the first; those that no third building stands in.
  std::vector<PlanArea> strips_between(std::size_t i, std::size_t k) const {
    const Vec3 origin_m = at(i).origin_m;
    const auto own = search_.shaped(i).shape;
    const std::vector<PlanArea> of_k = ground_of(k, origin_m);
    std::vector<PlanArea> strips;
    for (const PlanArea& p : own->ground)
      for (const PlanArea& q : of_k)
        for (PlanArea& strip : detail::gaps_between(p, q, reach_m(), kGapLean))
          if (is_free(strip, i, k)) strips.push_back(std::move(strip));
    return strips;
  }

  [[nodiscard]] bool is_free(const PlanArea& strip, std::size_t i, std::size_t k) const {
    return std::ranges::none_of(search_.near(i, reach_m()), [&](std::size_t third) {
      return third != k && shared_ground_m2(strip, ground_of(third, at(i).origin_m)) > kCovered_m2;
    });
  }

  AlikeGroup group_of(std::vector<std::size_t> members) const {
    AlikeGroup group;
    const Vec3 origin_m = at(members.front()).origin_m;
    std::vector<PlanArea> areas;
    double roof = 0;
    group.ground_m = Box::kInfinity;
    for (const std::size_t member : members) {
      const StandingBuilding& one = at(member);
      for (PlanArea& area : ground_of(member, origin_m)) areas.push_back(std::move(area));
      const double up_m = one.origin_m.z - origin_m.z;
      group.ground_m2 += one.ground_m2;
      group.ground_m = std::min(group.ground_m, one.ground_m + up_m);
      roof += one.ground_m2 * (one.roof_m + up_m);
    }
    const double grid_m = group.grid_m = grid_of(areas);
    add_strips(members, origin_m, areas);
    group.roof_m = rounded_to(roof / group.ground_m2, grid_m);
    group.ground_m = rounded_to(group.ground_m, grid_m);
    Work work(kWorkBudget * std::ssize(members));
    group.areas = detail::united(areas, kContact_m, work);
    if (work.is_used_up()) group.used_up = work.budget();
    for (PlanArea& area : group.areas)
      for (Outline& outline : area)
        for (Vec3& p : outline) p = {rounded_to(p.x, grid_m), rounded_to(p.y, grid_m), 0};
    group.gable = common_gable(members, group.ground_m2, origin_m, grid_m);
    group.members = std::move(members);
    return group;
  }

  /// As the largest of the members has it, if others have it, too.
  [[nodiscard]] std::optional<GabledRoof> common_gable(const std::vector<std::size_t>& members,
                                                       double all_m2, Vec3 origin_m,
                                                       double grid_m) const {
    const StandingBuilding* largest = nullptr;
    for (const std::size_t member : members)
      if (at(member).gable && (largest == nullptr || at(member).ground_m2 > largest->ground_m2))
        largest = &at(member);
    if (largest == nullptr) return std::nullopt;
    GabledRoof roof{largest->gable->ridge, 0, 0};
    double sum_m2 = 0;
    for (const std::size_t member : members) {
      const StandingBuilding& one = at(member);
      if (!one.gable || std::abs(cross(one.gable->ridge, roof.ridge).z) > kRidgeLean) continue;
      const double up_m = one.origin_m.z - origin_m.z;
      sum_m2 += one.ground_m2;
      roof.ridge_m += one.ground_m2 * (one.gable->ridge_m + up_m);
      roof.eaves_m += one.ground_m2 * (one.gable->eaves_m + up_m);
    }
    if (sum_m2 <= all_m2 / 2) return std::nullopt;
    roof.ridge_m = rounded_to(roof.ridge_m / sum_m2, grid_m);
    roof.eaves_m = rounded_to(roof.eaves_m / sum_m2, grid_m);
    return roof;
  }

  void add_strips(const std::vector<std::size_t>& members, Vec3 origin_m,
                  std::vector<PlanArea>& areas) const {
    for (const std::size_t member : members)
      for (auto entry = strips_.lower_bound({member, 0});
           entry != strips_.end() && entry->first.first == member; ++entry)
        for (PlanArea strip : entry->second) {
          const Vec3 moved_m = at(member).origin_m - origin_m;
          for (Vec3& p : strip[0]) p = {p.x + moved_m.x, p.y + moved_m.y, 0};
          areas.push_back(std::move(strip));
        }
  }

  const NeighbourSearch& search_;
  const GroupingLimits& limits_;
  DisjointSets sets_;
  /// By pair, in the frame of the first of it.
  std::map<std::pair<std::size_t, std::size_t>, std::vector<PlanArea>> strips_;
  AlikeGroups out_;
};

}  // namespace

AlikeGroups alike_groups(const NeighbourSearch& search, const GroupingLimits& limits) {
  return GroupFinder(search, limits).run();
}

}  // namespace oriel
