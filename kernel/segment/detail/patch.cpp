#include "kernel/segment/detail/patch.h"

#include "kernel/model/detail/index.h"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

class PatchFinder {
 public:
  PatchFinder(const Boundary& body, bool is_hole, const PatchOptions& options, std::int64_t& work)
      : body_(body),
        world_(body.world()),
        is_hole_(is_hole),
        options_(options),
        work_(work),
        number_of_(at(body.facet_count()), -1) {}

  std::vector<Patch> run() {
    grow_all();
    for (int f = 0; f < body_.facet_count(); ++f)
      if (body_.is_alive(f)) surface_ += body_.area(f);
    Component alone, widened;
    for (int n = 0; n < std::ssize(grown_); ++n) {
      start_with(n);
      offer(alone);
      for_fewer_sides(alone, [&](unsigned limits) {
        if (widen(n, limits)) offer(widened);
      });
    }
    return std::move(patches_);
  }

  /// The groups themselves.
  std::vector<Component> components() {
    grow_all();
    std::vector<Component> all;
    for (int n = 0; n < std::ssize(grown_); ++n) {
      start_with(n);
      find_sides(all.emplace_back());
      find_facets(all.back());
    }
    return all;
  }

 private:
  void grow_all() {
    for (int f = 0; f < body_.facet_count(); ++f)
      if (body_.is_alive(f) && number_of_[at(f)] < 0 && !is_ground(f)) grow(f);
    find_neighbours();
  }

  /// Inside a hole surfaces meet in reflex edges, on a protrusion in convex ones.
  [[nodiscard]] bool ties(int e) const { return body_.is_reflex(e) == is_hole_; }

  [[nodiscard]] bool is_ground(int f) const {
    return !is_hole_ && body_.facet(f).side == options_.free_side;
  }

  /// Where what is listed of a group stands among that of all groups.
  struct Place {
    std::size_t first = 0, last = 0;
    template <class T>
    [[nodiscard]] std::span<const T> of(const std::vector<T>& all) const {
      return std::span(all).subspan(first, last - first);
    }
  };
  /// Facets that hang together, with what is around them.
  struct Grown {
    Place facets;
    double area = 0;
    Place rim;     ///< half-edges to other groups or the ground
    Place sides;   ///< of its own facets, ascending
    Place beyond;  ///< what lies across the rim: sides, and the groups they are of; sorted
    bool meets_ground = false;
    unsigned own_limits = 0;  ///< the bits of its own sides in for_fewer_sides()
  };

  /// Sorts what stands from `first` on, each once.
  template <class T>
  static Place close(std::vector<T>& all, std::size_t first) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    std::ranges::sort(begin, all.end());
    all.erase(std::unique(begin, all.end()), all.end());
    return {first, all.size()};
  }

  /// Collects the facets that hang together with `start`.
  void grow(int start) {
    const int number = static_cast<int>(grown_.size());
    const std::size_t first = facets_.size(), first_rim = rims_.size(), first_side = sides_.size();
    Grown& group = grown_.emplace_back();
    facets_.push_back(start);
    number_of_[at(start)] = number;
    for (std::size_t i = first; i < facets_.size(); ++i) {
      sides_.push_back(body_.facet(facets_[i]).side);
      group.area += body_.area(facets_[i]);
      body_.for_each_edge(facets_[i], [&](int e) {
        const int g = body_.facet_of(body_.twin(e));
        if (number_of_[at(g)] == number) return;
        if (number_of_[at(g)] >= 0 || !ties(e) || is_ground(g)) {
          rims_.push_back(e);
          return;
        }
        number_of_[at(g)] = number;
        facets_.push_back(g);
      });
    }
    // An edge may have been met before its other side joined the group.
    const auto is_inside = [&](int e) {
      return number_of_[at(body_.facet_of(body_.twin(e)))] == number;
    };
    const auto rim = rims_.begin() + static_cast<std::ptrdiff_t>(first_rim);
    rims_.erase(std::remove_if(rim, rims_.end(), is_inside), rims_.end());
    group.facets = {first, facets_.size()};
    group.rim = {first_rim, rims_.size()};
    group.sides = close(sides_, first_side);
  }

  void find_neighbours() {
    beyond_.reserve(rims_.size());
    for (Grown& group : grown_) {
      const std::size_t first = beyond_.size();
      for (const int e : group.rim.of(rims_)) {
        const int g = body_.facet_of(body_.twin(e));
        if (is_ground(g))
          group.meets_ground = true;
        else
          beyond_.emplace_back(body_.facet(g).side, number_of_[at(g)]);
      }
      group.beyond = close(beyond_, first);
    }
    group_stamps_.assign(grown_.size(), 0);
  }

  /// One group alone.
  void start_with(int n) {
    widened_.assign(1, n);
    group_stamps_[at(n)] = ++last_stamp_;
  }
  [[nodiscard]] bool is_widened(int n) const { return group_stamps_[at(n)] == last_stamp_; }

  /// Of the groups at hand as one component: the sides on which its rim lies.
  void find_sides(Component& component) const {
    component.sides.clear();
    component.ground = -1;
    for (const int n : widened_) {
      const Grown& group = grown_[at(n)];
      for (const auto& [side, other] : group.beyond.of(beyond_))
        if (!is_widened(other)) component.sides.push_back(side);
      if (group.meets_ground) component.ground = options_.free_side;
    }
    if (component.ground >= 0) component.sides.push_back(component.ground);
    std::ranges::sort(component.sides);
    component.sides.erase(std::unique(component.sides.begin(), component.sides.end()),
                          component.sides.end());
  }

  /// The same of its facets and its rim.
  void find_facets(Component& component) const {
    component.facets.clear();
    component.rim.clear();
    for (const int n : widened_) {
      const Grown& group = grown_[at(n)];
      const auto facets = group.facets.of(facets_);
      component.facets.insert(component.facets.end(), facets.begin(), facets.end());
      for (const int e : group.rim.of(rims_)) {
        const int g = body_.facet_of(body_.twin(e));
        if (is_ground(g) || !is_widened(number_of_[at(g)])) component.rim.push_back(e);
      }
    }
    std::ranges::sort(component.facets);
    std::ranges::sort(component.rim);
  }

  /// Visits the sets of two or more of a component's split planes that leave one out at least, as
  /// bits of limit_bits_.
  template <class Visit>
  void for_fewer_sides(const Component& component, const Visit& visit) {
    std::vector<Side> sides = component.sides;
    std::erase(sides, component.ground);
    constexpr std::size_t kMost = 6;  // 2^6 sets: a component with more planes is no single feature
    if (sides.size() < 3 || sides.size() > kMost) return;
    if (limit_bits_.empty()) limit_bits_.assign(2 * at(world_.planes.size()), 0);
    for (std::size_t i = 0; i < sides.size(); ++i) limit_bits_[at(sides[i])] = 1U << i;
    for (Grown& group : grown_) {
      group.own_limits = 0;
      for (const Side side : group.sides.of(sides_)) group.own_limits |= limit_bits_[at(side)];
    }
    for (unsigned mask = 1; mask + 1 < 1U << sides.size(); ++mask)
      if (const int order = std::popcount(mask); order >= 2 && order <= options_.max_order)
        visit(mask);
    for (const Side side : sides) limit_bits_[at(side)] = 0;
  }

  /// Makes widened_ a group with all that lies beyond its rim but for the given planes (bits): a
  /// chimney's shaft with its head. False if that runs into one of those planes itself, or has more
  /// than half of the body's surface: then the rest is the part.
  bool widen(int start, unsigned limits) {
    std::vector<int>& groups = widened_;
    groups.assign(1, start);
    group_stamps_[at(start)] = ++last_stamp_;
    double area = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const Grown& group = grown_[at(groups[i])];
      area += group.area;
      const auto beyond = group.beyond.of(beyond_);
      work_ += std::ssize(beyond);
      if (2 * area > surface_ || (group.own_limits & limits) != 0) return false;
      for (const auto& [side, other] : beyond) {
        if (group_stamps_[at(other)] == last_stamp_ || (limit_bits_[at(side)] & limits) != 0)
          continue;
        group_stamps_[at(other)] = last_stamp_;
        groups.push_back(other);
      }
    }
    return groups.size() > 1;
  }

  /// The groups at hand.
  void offer(Component& component) {
    find_sides(component);
    if (!can_be_capped(component)) return;
    find_facets(component);
    if (!seen_.insert(component.facets).second) return;
    if (auto patch = cap_component(body_, is_hole_, component, work_))
      patches_.push_back(std::move(*patch));
  }

  [[nodiscard]] bool can_be_capped(const Component& component) const {
    const auto& sides = component.sides;
    const std::ptrdiff_t order = std::ssize(sides) - (component.ground >= 0 ? 1 : 0);
    if (widened_.size() == 1 && grown_[at(widened_[0])].facets.of(facets_).size() < 2) return false;
    if (order < 2 || order > options_.max_order) return false;
    if (component.ground >= 0 && order > 2) return false;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (std::ranges::find(options_.own_planes, sides[i] >> 1) != options_.own_planes.end())
        return false;
      for (std::size_t j = 0; j < i; ++j)
        if (has_same_normal(sides[i], sides[j])) return false;
    }
    return true;
  }

  [[nodiscard]] bool has_same_normal(Side s, Side t) const {
    return world_.planes.class_of(s >> 1) == world_.planes.class_of(t >> 1) && (s & 1) == (t & 1);
  }

  const Boundary& body_;
  World& world_;
  bool is_hole_;
  const PatchOptions& options_;
  std::int64_t& work_;
  std::vector<int> number_of_;  ///< by facet, the group it is in
  std::vector<Grown> grown_;
  // Of the groups, one after the other.
  std::vector<int> facets_, rims_;
  std::vector<Side> sides_;
  std::vector<std::pair<Side, int>> beyond_;
  double surface_ = 0;             ///< of the body
  std::vector<int> group_stamps_;  ///< the last widening that has met a group
  int last_stamp_ = 0;
  std::vector<int> widened_;  ///< groups
  /// By side: its bit in the sets of for_fewer_sides(), 0 if it is in none.
  std::vector<unsigned> limit_bits_;
  std::set<std::vector<int>> seen_;
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<Component> hole_components(const Boundary& body, std::int64_t& work) {
  work += body.half_edge_count();
  return PatchFinder(body, true, {}, work).components();
}

std::vector<Patch> find_patches(const Boundary& body, bool is_hole, const PatchOptions& options,
                                std::int64_t& work) {
  work += body.half_edge_count();
  return PatchFinder(body, is_hole, options, work).run();
}

}  // namespace oriel::detail
