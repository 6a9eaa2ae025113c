#include "kernel/segment/detail/patch.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// On which side of the corner that the planes of a cut make something lies.
enum class Corner {
  convex_outside,  ///< outside of it: a chimney on a ridge; the rest is inside
  convex_inside,   ///< inside of it: a hole in an edge
  concave          ///< in front of all planes: a post in an inner corner
};

/// Facets with how they hang together.
struct Component {
  std::vector<int> facets;
  std::vector<int> rim;     ///< half-edges of its facets, their twins beyond
  std::vector<Side> sides;  ///< beyond the rim, ascending
  Side ground = -1;         ///< one of the sides, if the patch stands on the ground
};

/// Caps for one component, or nothing.
class Capper {
 public:
  Capper(const Boundary& body, const Component& component, Corner corner)
      : body_(body), world_(body.world()), component_(component), corner_(corner) {
    for (const int e : component.rim) label_[e] = body.side_of_edge(body.twin(e));
  }

  std::optional<std::vector<Cap>> run() {
    if (!order_rim()) return std::nullopt;
    std::vector<Cap> caps;
    for (const Side side : component_.sides) {
      auto cap = cap_on(side);
      if (!cap) return std::nullopt;
      caps.push_back(std::move(*cap));
    }
    return caps;
  }

 private:
  /// Where the rim changes from one plane to another.
  struct Switch {
    int point;
    Side from, to;
    int rim;  ///< the first rim half-edge behind it
  };

  /// The rim half-edge that follows each on its closed curve.
  bool order_rim() {
    for (const int e : component_.rim) {
      int follower = body_.next(e);
      for (int steps = 0; !label_.contains(follower); ++steps) {
        if (steps > body_.half_edge_count()) return false;
        follower = body_.next(body_.twin(follower));
      }
      follower_[e] = follower;
      if (label_[e] != label_[follower])
        switches_.push_back({body_.origin(follower), label_[e], label_[follower], follower});
    }
    return true;
  }

  std::optional<Cap> cap_on(Side side) {
    Cap cap{side, {}, {}, false};
    if (side == component_.ground) {
      cap.side = side ^ 1;
      cap.is_taken = true;
    }
    std::map<int, bool> is_done;
    for (const int start : component_.rim) {
      if (label_[start] != side || is_done[start]) continue;
      CapLoop loop;
      int e = start;
      do {
        is_done[e] = true;
        loop.edges.push_back({e, body_.origin(e), body_.target(e)});
        const int follower = follower_[e];
        if (label_[follower] == side) {
          e = follower;
          continue;
        }
        const auto back = walk_in_the_open(side, label_[follower], body_.target(e), loop);
        if (!back || loop.edges.size() > at(body_.half_edge_count())) return std::nullopt;
        e = *back;
      } while (e != start && !is_done[e]);
      if (e != start) return std::nullopt;
      cap.loops.push_back(std::move(loop));
    }
    return cap;
  }

  /// From `point`, where the rim leaves the plane of `side` for that of `other`, along the edges of
  /// the corner to where the rim comes back to `side`: adds the free edges, returns the rim
  /// half-edge there.
  std::optional<int> walk_in_the_open(Side side, Side other, int point, CapLoop& loop) {
    for (int steps = 0; steps <= 4; ++steps) {
      const auto stop = next_stop(side, other, point);
      if (!stop) return std::nullopt;
      loop.edges.push_back({-1, point, stop->point});
      if (stop->rim >= 0) return stop->rim;
      point = stop->point;
      other = stop->other;
    }
    return std::nullopt;
  }

  struct Stop {
    int point;
    int rim;     ///< where the rim takes over, or -1
    Side other;  ///< the plane to walk along next, if it does not
  };

  /// The nearest point ahead on the line in which two planes meet: where the rim comes from `other`
  /// to `side`, or where a third plane of the corner meets them.
  std::optional<Stop> next_stop(Side side, Side other, int point) {
    const Vec3 line = cross(world_.planes.normal(side), world_.planes.normal(other));
    const bool is_at_ground = side == component_.ground || other == component_.ground;
    const Vec3 ahead = corner_ == Corner::concave && !is_at_ground ? -line : line;
    const double here = dot(ahead, world_.points.at(point));
    std::optional<Stop> nearest;
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](const Stop& stop) {
      const double distance = dot(ahead, world_.points.at(stop.point)) - here;
      if (stop.point == point || distance <= 0 || distance >= least) return;
      least = distance;
      nearest = stop;
    };
    for (const Switch& s : switches_)
      if (s.from == other && s.to == side) offer({s.point, s.rim, other});
    for (const Side third : component_.sides) {
      if (third == side || third == other) continue;
      const auto meeting = world_.points.meet(side >> 1, other >> 1, third >> 1);
      if (meeting && is_on_corner(*meeting)) offer({*meeting, -1, third});
    }
    return nearest;
  }

  [[nodiscard]] bool is_on_corner(int point) {
    return std::ranges::all_of(component_.sides, [&](Side side) {
      const int level = world_.points.side(point, side >> 1) * ((side & 1) != 0 ? -1 : 1);
      return corner_ == Corner::concave && side != component_.ground ? level >= 0 : level <= 0;
    });
  }

  const Boundary& body_;
  World& world_;
  const Component& component_;
  Corner corner_;
  std::map<int, Side> label_;
  std::map<int, int> follower_;
  std::vector<Switch> switches_;
};

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
    for (int f = 0; f < body_.facet_count(); ++f)
      if (body_.is_alive(f) && number_of_[at(f)] < 0 && !is_ground(f)) grow(f);
    find_neighbours();
    for (int f = 0; f < body_.facet_count(); ++f)
      if (body_.is_alive(f)) surface_ += body_.area(f);
    for (int n = 0; n < std::ssize(grown_); ++n) {
      offer(component_of({n}));
      for (const auto& sides : fewer_sides(component_of({n})))
        if (const auto parts = widen(n, sides)) offer(component_of(*parts));
    }
    return std::move(patches_);
  }

 private:
  /// Inside a hole surfaces meet in reflex edges, on a protrusion in convex ones.
  [[nodiscard]] bool ties(int e) const { return body_.is_reflex(e) == is_hole_; }

  [[nodiscard]] bool is_ground(int f) const {
    return !is_hole_ && body_.facet(f).side == options_.free_side;
  }

  /// Facets that hang together, with what is around them.
  struct Grown {
    std::vector<int> facets;
    double area = 0;
    std::vector<int> rim;     ///< half-edges to other groups or the ground
    std::vector<Side> sides;  ///< of its own facets, ascending
    /// What lies across the rim: sides, and the groups they are of; sorted.
    std::vector<std::pair<Side, int>> beyond;
  };

  /// Collects the facets that hang together with `start`.
  void grow(int start) {
    const int number = static_cast<int>(grown_.size());
    Grown group{{start}, 0, {}, {}, {}};
    number_of_[at(start)] = number;
    for (std::size_t i = 0; i < group.facets.size(); ++i) {
      group.sides.push_back(body_.facet(group.facets[i]).side);
      group.area += body_.area(group.facets[i]);
      body_.for_each_edge(group.facets[i], [&](int e) {
        const int g = body_.facet_of(body_.twin(e));
        if (number_of_[at(g)] == number) return;
        if (number_of_[at(g)] >= 0 || !ties(e) || is_ground(g)) {
          group.rim.push_back(e);
          return;
        }
        number_of_[at(g)] = number;
        group.facets.push_back(g);
      });
    }
    // An edge may have been met before its other side joined the group.
    std::erase_if(group.rim,
                  [&](int e) { return number_of_[at(body_.facet_of(body_.twin(e)))] == number; });
    std::ranges::sort(group.sides);
    grown_.push_back(std::move(group));
  }

  void find_neighbours() {
    for (Grown& group : grown_) {
      for (const int e : group.rim) {
        const int g = body_.facet_of(body_.twin(e));
        if (!is_ground(g)) group.beyond.emplace_back(body_.facet(g).side, number_of_[at(g)]);
      }
      std::ranges::sort(group.beyond);
      group.beyond.erase(std::unique(group.beyond.begin(), group.beyond.end()), group.beyond.end());
    }
    group_stamps_.assign(grown_.size(), 0);
  }

  /// Several groups as one component.
  [[nodiscard]] Component component_of(const std::vector<int>& groups) const {
    Component component;
    for (const int n : groups) {
      const Grown& group = grown_[at(n)];
      component.facets.insert(component.facets.end(), group.facets.begin(), group.facets.end());
      for (const int e : group.rim) {
        const int g = body_.facet_of(body_.twin(e));
        if (std::ranges::find(groups, number_of_[at(g)]) != groups.end()) continue;
        component.rim.push_back(e);
        component.sides.push_back(body_.facet(g).side);
        if (is_ground(g)) component.ground = options_.free_side;
      }
    }
    std::ranges::sort(component.facets);
    std::ranges::sort(component.rim);
    std::ranges::sort(component.sides);
    component.sides.erase(std::unique(component.sides.begin(), component.sides.end()),
                          component.sides.end());
    return component;
  }

  /// The sets of two or more of a component's split planes that leave one out at least.
  [[nodiscard]] std::vector<std::vector<Side>> fewer_sides(const Component& component) const {
    std::vector<Side> sides = component.sides;
    std::erase(sides, component.ground);
    constexpr std::size_t kMost = 6;  // 2^6 sets: a component with more planes is no single feature
    std::vector<std::vector<Side>> sets;
    if (sides.size() < 3 || sides.size() > kMost) return sets;
    for (unsigned mask = 1; mask + 1 < 1U << sides.size(); ++mask) {
      std::vector<Side> set;
      for (std::size_t i = 0; i < sides.size(); ++i)
        if ((mask >> i & 1U) != 0) set.push_back(sides[i]);
      if (set.size() >= 2 && std::ssize(set) <= options_.max_order) sets.push_back(std::move(set));
    }
    return sets;
  }

  /// A group with all that lies beyond its rim but for the given planes: a chimney's shaft with its
  /// head. Nothing if that runs into one of those planes itself, or has more than half of the
  /// body's surface: then the rest is the part.
  [[nodiscard]] std::optional<std::vector<int>> widen(int start, const std::vector<Side>& limits) {
    std::vector<int> groups{start};
    group_stamps_[at(start)] = ++last_stamp_;
    double area = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const Grown& group = grown_[at(groups[i])];
      area += group.area;
      work_ += std::ssize(group.beyond);
      const auto is_in_group = [&](Side s) { return std::ranges::binary_search(group.sides, s); };
      if (2 * area > surface_ || std::ranges::any_of(limits, is_in_group)) return std::nullopt;
      for (const auto& [side, other] : group.beyond) {
        if (group_stamps_[at(other)] == last_stamp_ || std::ranges::binary_search(limits, side))
          continue;
        group_stamps_[at(other)] = last_stamp_;
        groups.push_back(other);
      }
    }
    if (groups.size() == 1) return std::nullopt;
    return groups;
  }

  void offer(const Component& component) {
    if (!can_be_capped(component) || !seen_.insert(component.facets).second) return;
    if (auto patch = cap(component)) patches_.push_back(std::move(*patch));
  }

  [[nodiscard]] bool can_be_capped(const Component& component) const {
    const auto& sides = component.sides;
    const std::ptrdiff_t order = std::ssize(sides) - (component.ground >= 0 ? 1 : 0);
    if (component.facets.size() < 2 || order < 2 || order > options_.max_order) return false;
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

  /// +1: in front of the oriented plane.
  [[nodiscard]] int level(int point, Side side) const {
    const int level = world_.points.side(point, side >> 1);
    return (side & 1) != 0 ? -level : level;
  }

  [[nodiscard]] std::optional<Corner> corner_of(const Component& component) const {
    bool is_behind_all = is_hole_, is_before_all = !is_hole_, is_before_one = !is_hole_;
    for (const int f : component.facets) {
      body_.for_each_edge(f, [&](int e) {
        work_ += std::ssize(component.sides);
        int most = -1, least = 1;
        for (const Side side : component.sides) {
          if (side == component.ground) continue;
          most = std::max(most, level(body_.origin(e), side));
          least = std::min(least, level(body_.origin(e), side));
        }
        is_behind_all &= most <= 0;
        is_before_all &= least >= 0;
        is_before_one &= most >= 0;
      });
      if (!is_behind_all && !is_before_all && !is_before_one) return std::nullopt;
    }
    if (is_behind_all) return Corner::convex_inside;
    return is_before_all ? Corner::concave : Corner::convex_outside;
  }

  std::optional<Patch> cap(const Component& component) {
    const auto corner = corner_of(component);
    if (!corner) return std::nullopt;
    auto caps = Capper(body_, component, *corner).run();
    if (!caps) return std::nullopt;
    Patch patch{is_hole_, component.facets, std::move(*caps), 0, 0, 0};
    if (!are_edges_free(patch)) return std::nullopt;
    if (!measure(patch)) return std::nullopt;
    return patch;
  }

  /// No facet outside the patch stands in the way of a free edge.
  [[nodiscard]] bool are_edges_free(const Patch& patch) const {
    for (const Cap& cap : patch.caps)
      for (const CapLoop& loop : cap.loops)
        for (const CapEdge& edge : loop.edges)
          if (edge.rim < 0 && edge.from < edge.to && is_crossed(edge.from, edge.to)) return false;
    return true;
  }

  [[nodiscard]] bool is_crossed(int from, int to) const {
    const Vec3 p = world_.points.at(from), q = world_.points.at(to);
    for (int f = 0; f < body_.facet_count(); ++f) {
      if (!body_.is_alive(f)) continue;
      const Side side = body_.facet(f).side;
      if (level(from, side) * level(to, side) >= 0) continue;
      const Vec3 normal = world_.planes.normal(side);
      const double hp = dot(normal, p) - world_.planes.offset_m(side),
                   hq = dot(normal, q) - world_.planes.offset_m(side);
      if (contains(body_.outlines(f), normal, p + (hp / (hp - hq)) * (q - p))) return true;
    }
    return false;
  }

  /// Fills in areas and volume, takes covered facets off the caps; false if a cap has no area.
  bool measure(Patch& patch) const {
    double patch_sum = 0, cap_sum = 0;
    for (const int f : patch.facets)
      patch_sum += world_.planes.offset_m(body_.facet(f).side) * body_.area(f);
    for (Cap& cap : patch.caps) {
      std::vector<Outline> shape;
      for (const CapLoop& loop : cap.loops) {
        shape.emplace_back();
        for (const CapEdge& edge : loop.edges) shape.back().push_back(world_.points.at(edge.from));
      }
      const Vec3 normal = world_.planes.normal(cap.side);
      double area = 0;
      for (const Outline& outline : shape) area += signed_area(outline, normal);
      cap_sum += world_.planes.offset_m(cap.side) * area;
      if (cap.is_taken) continue;
      for (const int g : body_.facets_on(cap.side ^ 1)) {
        if (std::ranges::binary_search(patch.facets, g)) continue;
        const auto inside = interior_point(body_.outlines(g), normal);
        if (!inside || !contains(shape, normal, *inside)) continue;
        cap.covered.push_back(g);
        area -= body_.area(g);
      }
      if (area <= 0) return false;
      patch.new_area += area;
      patch.old_area += body_.area_on(cap.side);
    }
    // A protrusion's own caps look the other way; a hole's walls do.
    patch.volume = (patch.is_hole ? cap_sum - patch_sum : patch_sum - cap_sum) / 3;
    return patch.volume > 0;
  }

  const Boundary& body_;
  World& world_;
  bool is_hole_;
  const PatchOptions& options_;
  std::int64_t& work_;
  std::vector<int> number_of_;  ///< by facet, the group it is in
  std::vector<Grown> grown_;
  double surface_ = 0;             ///< of the body
  std::vector<int> group_stamps_;  ///< the last widening that has met a group
  int last_stamp_ = 0;
  std::set<std::vector<int>> seen_;
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<Side> Patch::sides() const {
  std::vector<Side> sides;
  for (const Cap& cap : caps)
    if (!cap.is_taken) sides.push_back(cap.side);
  std::ranges::sort(sides);
  return sides;
}

std::vector<Patch> find_patches(const Boundary& body, bool is_hole, const PatchOptions& options,
                                std::int64_t& work) {
  work += body.half_edge_count();
  return PatchFinder(body, is_hole, options, work).run();
}

}  // namespace oriel::detail
