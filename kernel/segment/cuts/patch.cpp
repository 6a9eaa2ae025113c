#include "kernel/segment/cuts/patch.h"

#include "kernel/base/index.h"
#include "model/description/counting_sort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

namespace oriel::detail {

namespace {

class FlushPatchFinder {
 public:
  FlushPatchFinder(FlatBody& flat, const PatchOptions& options, std::vector<Patch>& patches)
      : flat_(flat),
        body_(flat.body()),
        planes_(body_.world().planes),
        options_(options),
        patches_(patches) {}

  void run() {
    for (const BodyFacetId f : body_.facet_ids()) {
      if (body_.world().work.is_used_up()) return;
      if (body_.is_alive(f) && body_.facet(f).side != options_.free_side) look_along(f);
    }
  }

 private:
  /// What a facet with a bump has at least: two of them turn inward, two are the bump's own.
  static constexpr int kLeastCorners = 6;

  /// A stretch of a facet's outline between two corners that turn inward, with none between them:
  /// from `first` up to `after`.
  struct Bump {
    EdgeId first, after;
  };

  void look_along(BodyFacetId f) {
    const LoopId outline = body_.facet(f).loops[0];
    const Vec3 normal = planes_.normal(body_.facet(f).side);
    const EdgeId start = body_.loop(outline).first;
    EdgeId e = start;
    for (int i = 1; i < kLeastCorners; ++i) {
      e = body_.next(e);
      if (e == start) return;
    }
    find_inward_corners(start, normal);
    for (std::size_t i = 0; corners_.size() > 1 && i < corners_.size(); ++i)
      try_bump(f, {corners_[i], corners_[(i + 1) % corners_.size()]});
  }

  /// Of an outline: the half-edges that begin where it turns inward.
  void find_inward_corners(EdgeId start, Vec3 normal) {
    constexpr double kStraight = 1e-6;  // tolerance of doubles, of the sine
    corners_.clear();
    EdgeId e = start;
    Vec3 at_e = body_.at(e);
    Vec3 before = at_e - body_.at(body_.prev(e));
    do {
      const EdgeId next = body_.next(e);
      const Vec3 at_next = body_.at(next);
      const Vec3 after = at_next - at_e;
      const double turn = dot(cross(before, after), normal);
      if (turn < 0 && turn < -kStraight * length(before) * length(after)) corners_.push_back(e);
      e = next;
      at_e = at_next;
      before = after;
    } while (e != start);
  }

  void try_bump(BodyFacetId f, Bump bump) {
    const EdgeId before = body_.prev(bump.first);
    const PlaneSide one = body_.side_of_edge(body_.twin(before)),
                    other = body_.side_of_edge(body_.twin(bump.after));
    if (!can_cut(one) || !can_cut(other)) return;
    if (planes_.class_of(one >> 1) == planes_.class_of(other >> 1)) return;
    const PlaneSide flush = body_.facet(f).side;
    if (std::ranges::any_of(options_.sides, [&](PlaneSide side) {
          return side != one && side != other && side != flush;
        }))
      return;
    if (!do_meet(before, bump.after, planes_.normal(body_.facet(f).side))) return;
    if (!find_component(f, bump, {one, other})) return;
    if (auto patch = cap_component(flat_, false, component_)) patches_.push_back(std::move(*patch));
  }

  [[nodiscard]] bool can_cut(PlaneSide side) const {
    return std::ranges::find(options_.own_planes, side >> 1) == options_.own_planes.end();
  }

  /// The edges on both sides of the bump, carried on into the facet, come to one point.
  [[nodiscard]] bool do_meet(EdgeId before, EdgeId after, Vec3 normal) const {
    const Vec3 from = body_.at(body_.next(before)), to = body_.at(after);
    const Vec3 ahead = from - body_.at(before), back = to - body_.at(body_.next(after));
    const Vec3 gap = to - from;
    const double turn = dot(cross(ahead, back), normal);
    return turn * dot(cross(gap, back), normal) > 0 && turn * dot(cross(gap, ahead), normal) > 0;
  }

  /// What hangs together over convex edges beyond the bump, without the facet. False if it has
  /// edges with others than the facet and the two sides.
  bool find_component(BodyFacetId f, Bump bump, std::pair<PlaneSide, PlaneSide> limits) {
    const PlaneSide flush = body_.facet(f).side;
    const auto is_limit = [&](PlaneSide side) {
      return side == limits.first || side == limits.second;
    };
    component_.ground = flush;
    component_.sides = {limits.first, limits.second, flush};
    component_.facets.clear();
    component_.rim.clear();
    StampSet<BodyFacetId>& met = body_.world().scratch.facets_of_piece;
    met.start(body_.facet_count());
    for (EdgeId e = bump.first; e != bump.after; e = body_.next(e)) {
      const BodyFacetId g = body_.facet_of(body_.twin(e));
      if (is_limit(body_.facet(g).side)) return false;
      if (met.insert(g)) component_.facets.push_back(g);
    }
    bool is_bounded = true;
    for (std::size_t i = 0; is_bounded && i < component_.facets.size(); ++i)
      body_.for_each_edge(component_.facets[i], [&](EdgeId e) {
        body_.world().work.add(1);
        const BodyFacetId g = body_.facet_of(body_.twin(e));
        const PlaneSide beyond = body_.facet(g).side;
        const bool is_bound = is_limit(beyond);
        if (beyond == flush || body_.is_reflex(e)) {
          component_.rim.push_back(e);
          is_bounded &= is_bound || beyond == flush;
        } else if (is_bound) {
          is_bounded = false;
        } else if (met.insert(g)) {
          component_.facets.push_back(g);
        }
      });
    if (!is_bounded) return false;
    std::ranges::sort(component_.sides);
    std::ranges::sort(component_.facets);
    std::ranges::sort(component_.rim);
    return true;
  }

  FlatBody& flat_;
  const Boundary& body_;
  const PlaneTable& planes_;
  const PatchOptions& options_;
  std::vector<Patch>& patches_;
  std::vector<EdgeId> corners_;  ///< that turn inward, of the outline at hand
  Component component_;          ///< of the bump at hand
};

/// Adds protrusions that stand across the meeting of two planes and are flush with a facet: a
/// chimney astride a ridge in the plane of the gable. The facet belongs to the part and to the rest
/// and is split where the two planes meet it: along the edges that it has there with the rest, up
/// to where these meet inside it.
void add_flush_patches(FlatBody& body, const PatchOptions& options, std::vector<Patch>& patches) {
  FlushPatchFinder(body, options, patches).run();
}

/// A component with more planes is no single feature.
constexpr std::size_t kMostLimits = 6;

/// Sets of its planes, at most.
constexpr std::size_t kMostSets = 1U << kMostLimits;

/// How many bits numbers have.
constexpr auto kOrders = [] {
  std::array<int, kMostSets> orders{};
  for (unsigned mask = 0; mask < orders.size(); ++mask) orders[mask] = std::popcount(mask);
  return orders;
}();

/// Facets of a body that hang together: PatchFinder.
using GrownId = Id<struct GrownTag>;

class PatchFinder {
 public:
  PatchFinder(const Boundary& body, bool is_hole, const PatchOptions& options)
      : body_(body),
        flat_(body),
        world_(body.world()),
        is_hole_(is_hole),
        options_(options),
        number_of_(at(body.facet_count())) {}

  std::vector<Patch> run() {
    grow_all();
    for (const BodyFacetId f : body_.facet_ids())
      if (body_.is_alive(f)) surface_ += body_.area(f);
    Component alone, widened;
    met_groups_.reserve(4 * grown_.size());
    const std::size_t most = options_.max_order < 0 ? 0 : at(options_.max_order);
    for (const GrownId n : grown_.ids()) {
      if (world_.work.is_used_up()) break;
      start_with(n);
      // What is widened has no other sides.
      if (!find_sides(alone, std::max(most, kMostLimits)) || !has_sides_asked(alone)) continue;
      offer(alone);
      for_fewer_sides(n, alone, [&](unsigned limits) {
        widen(n, limits);
        if (is_met_first() && find_sides(widened, most) && has_sides_asked(widened)) offer(widened);
      });
    }
    if (options_.is_natural_order && most > 1) add_flush_patches(flat_, options_, patches_);
    return std::move(patches_);
  }

  /// The groups themselves.
  std::vector<Component> components() {
    grow_all();
    std::vector<Component> all;
    for (const GrownId n : grown_.ids()) {
      start_with(n);
      find_sides(all.emplace_back(), std::numeric_limits<std::size_t>::max());
      find_facets(all.back());
    }
    return all;
  }

 private:
  void grow_all() {
    facets_.reserve(at(body_.facet_count()));
    sides_.reserve(at(body_.facet_count()));
    grown_.reserve(at(body_.facet_count()));
    rims_.reserve(at(body_.half_edge_count() - body_.dead_edge_count()));
    for (const BodyFacetId f : body_.facet_ids())
      if (body_.is_alive(f) && !number_of_[f].is_valid() && !is_ground(f)) grow(f);
    find_neighbours();
  }

  /// Inside a hole surfaces meet in reflex edges, on a protrusion in convex ones.
  [[nodiscard]] bool ties(EdgeId e) const { return body_.is_reflex(e) == is_hole_; }

  [[nodiscard]] bool is_ground(BodyFacetId f) const {
    return !is_hole_ && body_.facet(f).side == options_.free_side;
  }

  /// Where what is listed of a group stands among that of all groups.
  struct ListRange {
    std::size_t first = 0, last = 0;
    template <class T>
    [[nodiscard]] std::span<const T> of(const std::vector<T>& all) const {
      return std::span(all).subspan(first, last - first);
    }
  };
  /// Facets that hang together, with what is around them.
  struct Grown {
    ListRange facets;
    double area = 0;
    Vec3 open;         ///< the sum of area × normal, which caps have to make up for
    ListRange rim;     ///< half-edges to other groups or the ground
    ListRange sides;   ///< of its own facets, ascending
    ListRange beyond;  ///< what lies across the rim: sides, and the groups they are of; sorted
    bool meets_ground = false;
  };
  /// A half-edge of a rim, and the facet beyond it.
  struct RimEdge {
    EdgeId edge;
    BodyFacetId beyond;
  };

  /// Sorts what stands from `first` on, each once.
  template <class T>
  static ListRange close(std::vector<T>& all, std::size_t first) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    std::ranges::sort(begin, all.end());
    all.erase(std::unique(begin, all.end()), all.end());
    return {first, all.size()};
  }

  /// Collects the facets that hang together with `start`.
  void grow(BodyFacetId start) {
    const GrownId number = grown_.next_id();
    const std::size_t first = facets_.size(), first_rim = rims_.size(), first_side = sides_.size();
    grown_.emplace_back();
    Grown& group = grown_[number];
    facets_.push_back(start);
    number_of_[start] = number;
    for (std::size_t i = first; i < facets_.size(); ++i) {
      sides_.push_back(body_.facet(facets_[i]).side);
      const double area = body_.area(facets_[i]);
      group.area += area;
      group.open = group.open + area * world_.planes.normal(sides_.back());
      body_.for_each_edge(facets_[i], [&](EdgeId e) {
        const BodyFacetId g = body_.facet_of(body_.twin(e));
        if (number_of_[g] == number) return;
        if (number_of_[g].is_valid() || !ties(e) || is_ground(g)) {
          rims_.push_back({e, g});
          return;
        }
        number_of_[g] = number;
        facets_.push_back(g);
      });
    }
    // An edge may have been met before its other side joined the group.
    const auto is_inside = [&](const RimEdge& e) { return number_of_[e.beyond] == number; };
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
      for (const RimEdge& e : group.rim.of(rims_)) {
        if (is_ground(e.beyond))
          group.meets_ground = true;
        else
          beyond_.emplace_back(body_.facet(e.beyond).side, number_of_[e.beyond]);
      }
      group.beyond = close(beyond_, first);
    }
    at_hand_.assign(grown_.size(), {});
    queue_.resize(grown_.size() + 1);
  }

  /// One group alone.
  void start_with(GrownId n) {
    queue_[0] = n;
    widened_ = std::span(queue_).first(1);
    at_hand_[n].stamp = ++last_stamp_;
  }
  [[nodiscard]] bool is_widened(GrownId n) const { return at_hand_[n].stamp == last_stamp_; }

  /// The groups at hand, several, were not at hand before.
  bool is_met_first() {
    std::uint64_t name = 0;  // that of the same groups in any order
    for (const GrownId n : widened_) name += scrambled(n);
    const auto [first, last] = met_.equal_range(name);
    if (std::any_of(first, last, [&](const auto& met) { return is_at_hand(met.second); }))
      return false;
    const std::size_t begin = met_groups_.size();
    met_groups_.insert(met_groups_.end(), widened_.begin(), widened_.end());
    met_.emplace(name, ListRange{begin, met_groups_.size()});
    return true;
  }
  [[nodiscard]] bool is_at_hand(const ListRange& set) const {
    const auto groups = set.of(met_groups_);
    return groups.size() == widened_.size() &&
           std::ranges::all_of(groups, [&](GrownId n) { return is_widened(n); });
  }
  static std::uint64_t scrambled(GrownId n) {
    std::uint64_t x = (static_cast<std::uint64_t>(n.value) + 1) * 0x9E3779B97F4A7C15U;
    x ^= x >> 32;
    return x * x;
  }

  /// Of the groups at hand as one component: the sides on which its rim lies. False, and not all of
  /// them, if these are more than `most` without the ground.
  bool find_sides(Component& component, std::size_t most) const {
    std::vector<PlaneSide>& sides = component.sides;
    sides.clear();
    component.ground = -1;
    for (const GrownId n : widened_) {
      const Grown& group = grown_[n];
      for (const auto& [side, other] : group.beyond.of(beyond_)) {
        if (is_widened(other) || std::ranges::find(sides, side) != sides.end()) continue;
        if (sides.size() == most) return false;
        sides.push_back(side);
      }
      if (group.meets_ground) component.ground = options_.free_side;
    }
    if (component.ground >= 0) sides.push_back(component.ground);
    std::ranges::sort(sides);
    return true;
  }

  /// The same of its facets and its rim.
  void find_facets(Component& component) const {
    component.facets.clear();
    component.rim.clear();
    for (const GrownId n : widened_) {
      const Grown& group = grown_[n];
      const auto facets = group.facets.of(facets_);
      component.facets.insert(component.facets.end(), facets.begin(), facets.end());
      for (const RimEdge& e : group.rim.of(rims_))
        if (is_ground(e.beyond) || !is_widened(number_of_[e.beyond]))
          component.rim.push_back(e.edge);
    }
    std::ranges::sort(component.facets);
    std::ranges::sort(component.rim);
  }

  /// Visits the sets of two or more of a component's split planes that leave one out at least, as
  /// bits of limit_bits_, and between which group `n`, which the component is, can be widened.
  template <class Visit>
  void for_fewer_sides(GrownId n, const Component& component, const Visit& visit) {
    boost::container::small_vector<PlaneSide, kMostLimits> sides;
    for (const PlaneSide side : component.sides)
      if (side != component.ground) sides.push_back(side);
    if (sides.size() < 3 || sides.size() > kMostLimits) return;
    if (limit_bits_.empty()) limit_bits_.assign(2 * at(world_.planes.size()), 0);
    if (groups_by_side_.items.empty()) sort_groups_by_side();
    for (std::size_t i = 0; i < sides.size(); ++i) {
      limit_bits_[at(sides[i])] = 1U << i;
      for (const int group : groups_by_side_[at(sides[i])])
        at_hand_[GrownId{group}].own_limits |= 1U << i;
    }
    // Widened once more there, as few as they are: in ascending order, which ties are decided by.
    const auto sets = sets_to_widen_in(n, sides.size());
    for (auto set = sets.rbegin(); set != sets.rend(); ++set) visit(*set);
    for (const PlaneSide side : sides) {
      limit_bits_[at(side)] = 0;
      for (const int group : groups_by_side_[at(side)]) at_hand_[GrownId{group}].own_limits = 0;
    }
  }

  void sort_groups_by_side() {
    Numbers group_of(sides_.size());
    for (const GrownId n : grown_.ids())
      for (std::size_t i = grown_[n].sides.first; i < grown_[n].sides.last; ++i)
        group_of[i] = n.value;
    groups_by_side_ = sort_into_buckets(sides_, 2 * at(world_.planes.size()));
    for (int& item : groups_by_side_.items) item = group_of[at(item)];
  }

  /// Descending. A widening that fails tells of all sets with fewer planes, as it goes further in
  /// them: it becomes too large there as well, and runs into the same planes where the set has
  /// them.
  boost::container::small_vector<unsigned, kMostSets> sets_to_widen_in(GrownId n,
                                                                       std::size_t sides) {
    const unsigned all = (1U << sides) - 1;
    boost::container::small_vector<unsigned, kMostSets> sets;
    std::array<unsigned, kMostSets> run_into;
    run_into[all] = at_hand_[n].own_limits;
    for (unsigned set = all - 1; set > 0; --set) {
      unsigned& met = run_into[set] = 0;
      for (unsigned others = all & ~set; others != 0; others &= others - 1)
        met |= run_into[set | (others & -others)];
      const int order = kOrders[set];
      if ((met & set) != 0 || order < 2 || order > options_.max_order) continue;
      met |= widen(n, set);
      if ((met & set) == 0) sets.push_back(set);
    }
    return sets;
  }

  /// Makes widened_ a group with all that lies beyond its rim but for the given planes (bits): a
  /// chimney's shaft with its head. Returns the planes that it runs into, and stops, if it does so;
  /// all, if it has more than half of the body's surface: then the rest is the part.
  unsigned widen(GrownId start, unsigned limits) {
    std::vector<GrownId>& groups = queue_;
    groups[0] = start;
    at_hand_[start].stamp = ++last_stamp_;
    std::size_t size = 1;
    double area = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const Grown& group = grown_[groups[i]];
      area += group.area;
      const auto beyond = group.beyond.of(beyond_);
      world_.work.add(std::ssize(beyond));
      if (2 * area > surface_) return ~0U;
      unsigned met = 0;
      for (const auto& next : beyond) {  // without branches, which nobody could foresee
        const GrownId other = next.second;
        auto& [stamp, own_limits] = at_hand_[other];
        const bool is_new = (stamp != last_stamp_) & ((limit_bits_[at(next.first)] & limits) == 0);
        const int all_bits = -static_cast<int>(is_new);
        groups[size] = other;
        size += static_cast<std::size_t>(is_new);
        stamp ^= (stamp ^ last_stamp_) & all_bits;
        met |= own_limits & static_cast<unsigned>(all_bits);
      }
      if ((met & limits) != 0) return met & limits;
    }
    widened_ = std::span(groups).first(size);
    return 0;
  }

  /// The groups at hand, whose sides the component has.
  void offer(Component& component) {
    if (!can_be_capped(component) || !may_be_chosen(component)) return;
    find_facets(component);
    if (auto patch = cap_component(flat_, is_hole_, component))
      patches_.push_back(std::move(*patch));
  }

  [[nodiscard]] bool has_sides_asked(const Component& component) const {
    return std::ranges::all_of(options_.sides, [&](PlaneSide side) {
      return std::ranges::find(component.sides, side) != component.sides.end();
    });
  }

  [[nodiscard]] bool can_be_capped(const Component& component) const {
    const auto& sides = component.sides;
    const std::ptrdiff_t order = std::ssize(sides) - (component.ground >= 0 ? 1 : 0);
    if (widened_.size() == 1 && grown_[widened_[0]].facets.of(facets_).size() < 2) return false;
    if (order < 2 || order > options_.max_order) return false;
    bool is_stepped = false;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (std::ranges::find(options_.own_planes, sides[i] >> 1) != options_.own_planes.end())
        return false;
      for (std::size_t j = 0; j < i; ++j) is_stepped |= has_same_normal(sides[i], sides[j]);
    }
    if (is_stepped) return options_.is_natural_order && !is_hole_ && order > 2;
    return component.ground < 0 || order == 2;
  }

  /// Caps that have no more than the areas that are asked for may close the groups at hand. The
  /// ground, of which a part may be taken, tells nothing.
  [[nodiscard]] bool may_be_chosen(const Component& component) const {
    if (component.ground >= 0) return true;
    Vec3 open;
    double area = 0, old_area = 0, covered = 0;
    for (const GrownId n : widened_) {
      open = open + grown_[n].open;
      area += grown_[n].area;
    }
    boost::container::small_vector<Vec3, 4> normals;
    for (const PlaneSide side : component.sides) {
      normals.push_back(world_.planes.normal(side));
      old_area += body_.area_on(side);
      covered += body_.area_on(side ^ 1);
    }
    constexpr double kOff = 0.02;  // of the area: what noise may move of it
    const double slack = kOff * area;
    return least_cap_area({normals.data(), normals.size()}, open, slack) <=
           options_.most_value * old_area + covered + slack;
  }

  [[nodiscard]] bool has_same_normal(PlaneSide s, PlaneSide t) const {
    return world_.planes.class_of(s >> 1) == world_.planes.class_of(t >> 1) && (s & 1) == (t & 1);
  }

  const Boundary& body_;
  FlatBody flat_;
  World& world_;
  bool is_hole_;
  const PatchOptions& options_;
  IndexedVector<BodyFacetId, GrownId> number_of_;  ///< the group that a facet is in
  IndexedVector<GrownId, Grown> grown_;
  // Of the groups, one after the other.
  std::vector<BodyFacetId> facets_;
  std::vector<RimEdge> rims_;
  std::vector<PlaneSide> sides_;
  std::vector<std::pair<PlaneSide, GrownId>> beyond_;
  double surface_ = 0;  ///< of the body
  /// A group as widenings ask about it.
  struct AtHand {
    int stamp = 0;            ///< of the last widening that has met it
    unsigned own_limits = 0;  ///< the bits of its own sides in for_fewer_sides()
  };
  IndexedVector<GrownId, AtHand> at_hand_;
  int last_stamp_ = 0;
  std::vector<GrownId> queue_;        ///< room for all groups, and what is put there in vain
  std::span<const GrownId> widened_;  ///< the groups at hand, the first in queue_
  /// By side: its bit in the sets of for_fewer_sides(), 0 if it is in none.
  std::vector<unsigned> limit_bits_;
  Buckets groups_by_side_;  ///< by one of their own sides; empty: not sorted yet
  /// Groups that were at hand together, in met_groups_, by a name that others hardly have.
  std::unordered_multimap<std::uint64_t, ListRange> met_;
  std::vector<GrownId> met_groups_;
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<Component> hole_components(const Boundary& body) {
  body.world().work.add(body.half_edge_count());
  return PatchFinder(body, true, {}).components();
}

std::vector<Patch> find_patches(const Boundary& body, bool is_hole, const PatchOptions& options) {
  body.world().work.add(body.half_edge_count());
  return PatchFinder(body, is_hole, options).run();
}

}  // namespace oriel::detail
