#include "kernel/segment/cuts/corner_holes.h"

#include "kernel/base/index.h"
#include "kernel/segment/sections/edge_index.h"
#include "kernel/segment/sections/section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <span>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

namespace {

/// Makes the whole outline of the section just behind the plane edges of the body. False if it
/// follows no closed loops.
bool imprint_all(Boundary& body, PlaneSide side, double weld_m) {
  EdgeIndex edges(body, std::array{side >> 1});
  const int behind = (side & 1) != 0 ? 1 : -1;
  Section section{side >> 1, behind};
  section_at(body, section, edges.edges_at(0, section.direction), {-1, weld_m});
  if (section.loops.empty()) return section.crossings.empty();
  Lump all;
  for (const RegionId r : section.regions.ids())
    if (section.regions[r].is_material) all.regions.push_back(r);
  std::vector<PointId> touched;
  imprint(body, section, all, touched);
  return true;
}

/// The holes that the planes cap which are imprinted in a body.
class CornerCutter {
 public:
  /// `old_edges` and `old_points`: so many there were before the planes were imprinted.
  CornerCutter(std::shared_ptr<const Boundary> body, std::span<const PlaneSide> sides,
               int old_edges, int old_points, double weld_m)
      : old_edges_(old_edges),
        old_points_(old_points),
        body_(std::move(body)),
        sides_(sides),
        weld_m_(weld_m) {}

  std::vector<Patch> run() {
    // It is indexed, and asked what lies behind the planes.
    body_->world().work.add(2 * body_->half_edge_count());
    std::vector<Patch> patches;
    const std::vector<Component> components = components_behind();
    if (components.empty()) return patches;
    FlatBody flat(*body_);
    for (const Component& component : components) {
      auto patch = cap_component(flat, true, component);
      if (!patch || !is_exact(component)) continue;
      patch->is_natural =
          std::ranges::all_of(component.rim, [&](EdgeId e) { return e.value < old_edges_; });
      patch->imprinted = body_;
      patches.push_back(std::move(*patch));
    }
    return patches;
  }

 private:
  /// No new point of the rim had to be put beside the plane it was cut at, as happens on edges
  /// between rounded vertices: cuts there make slivers that are not flat.
  [[nodiscard]] bool is_exact(const Component& component) const {
    const World& world = body_->world();
    constexpr double kBesidePlane = 1.0 / 16;  // of weld_m: vertices are one long before
    return std::ranges::all_of(component.rim, [&](EdgeId e) {
      const PointId point = body_->origin(e);
      const PlaneSide side = rim_side(*body_, sides_, e);
      const double distance =
          dot(world.planes.normal(side), world.points.at(point)) - world.planes.offset_m(side);
      return point.value < old_points_ || std::abs(distance) <= kBesidePlane * weld_m_;
    });
  }

  /// A side with the ranks of all points in its class: each is asked of all.
  struct SideWithRanks {
    PointRanks ranks;
    int rank, direction;
  };

  [[nodiscard]] boost::container::small_vector<SideWithRanks, 4> sides_with_ranks() const {
    World& world = body_->world();
    boost::container::small_vector<SideWithRanks, 4> sides;
    for (const PlaneSide side : sides_)
      sides.push_back({world.points.ranks(world.planes.class_of(side >> 1)),
                       world.planes.rank_of(side >> 1), (side & 1) != 0 ? -1 : 1});
    return sides;
  }

  [[nodiscard]] bool is_behind_all(BodyFacetId f, std::span<const SideWithRanks> sides) const {
    if (!body_->is_alive(f)) return false;
    const PlaneSide own = body_->facet(f).side;
    if (std::ranges::any_of(sides_, [&](PlaneSide s) { return s >> 1 == own >> 1; })) return false;
    return std::ranges::all_of(body_->facet(f).loops, [&](LoopId l) {
      const EdgeId first = body_->loop(l).first;
      EdgeId e = first;
      do {
        for (const SideWithRanks& side : sides)
          if ((side.ranks[body_->origin(e)] - side.rank) * side.direction > 0) return false;
        e = body_->next(e);
      } while (e != first);
      return true;
    });
  }

  /// Connected facets behind all planes whose rim lies on all of them, and that bend inward.
  std::vector<Component> components_behind() {
    const auto sides = sides_with_ranks();
    IndexedVector<BodyFacetId, int> state(at(body_->facet_count()),
                                          0);  // 1: behind, 2: and in a component
    for (const BodyFacetId f : body_->facet_ids())
      state[f] = is_behind_all(f, {sides.data(), sides.size()}) ? 1 : 0;
    std::vector<Component> found;
    for (const BodyFacetId start : body_->facet_ids()) {
      if (state[start] != 1) continue;
      Component component{{start}, {}, {}};
      state[start] = 2;
      bool has_bend = false;
      for (std::size_t i = 0; i < component.facets.size(); ++i)
        body_->for_each_edge(component.facets[i], [&](EdgeId e) {
          const BodyFacetId g = body_->facet_of(body_->twin(e));
          if (state[g] == 0) {
            component.rim.push_back(e);
            return;
          }
          has_bend |= body_->is_reflex(e);
          if (state[g] != 1) return;
          state[g] = 2;
          component.facets.push_back(g);
        });
      if (!has_bend || !lies_on_all(component)) continue;
      std::ranges::sort(component.facets);
      std::ranges::sort(component.rim);
      component.sides.assign(sides_.begin(), sides_.end());
      found.push_back(std::move(component));
    }
    return found;
  }

  [[nodiscard]] bool lies_on_all(const Component& component) const {
    std::set<PlaneSide> met;
    for (const EdgeId e : component.rim) {
      const PlaneSide side = rim_side(*body_, sides_, e);
      if (side < 0) return false;
      met.insert(side);
    }
    return met.size() == sides_.size();
  }

  int old_edges_, old_points_;
  std::shared_ptr<const Boundary> body_;
  std::span<const PlaneSide> sides_;
  double weld_m_;
};

class CornerHoleFinder {
 public:
  CornerHoleFinder(const Boundary& body, const CornerHoleOptions& options)
      : body_(body.without_dead()), work_(body.world().work), options_(options) {
    for (const BodyFacetId f : body.living_facets()) all_sides_.insert(body.facet(f).side);
  }

  std::vector<Patch> run() {
    const std::vector<Component> groups = hole_components(body_);
    number_groups(groups);
    for (const Component& group : groups) {
      if (work_.is_used_up()) break;
      if (group.facets.size() < 2) continue;
      const Component component = options_.has_all_sides ? with_neighbours(group, groups) : group;
      levels_.clear();
      levels_.push_back({-1, edges_of(component)});
      try_sets(sides_for(component), 0);
    }
    return std::move(patches_);
  }

 private:
  void number_groups(std::span<const Component> groups) {
    group_of_.assign(at(body_.facet_count()), -1);
    for (int g = 0; g < std::ssize(groups); ++g)
      for (const BodyFacetId f : groups[at(g)].facets) group_of_[f] = g;
  }

  /// A pocket with those that open into it: a tunnel from another wall has its own bends.
  [[nodiscard]] Component with_neighbours(const Component& group,
                                          std::span<const Component> groups) const {
    std::set<int> joined{group_of_[group.facets[0]]};
    for (const EdgeId e : group.rim) joined.insert(group_of_[body_.facet_of(body_.twin(e))]);
    Component all;
    for (const int g : joined)
      if (groups[at(g)].facets.size() >= 2)
        all.facets.insert(all.facets.end(), groups[at(g)].facets.begin(),
                          groups[at(g)].facets.end());
    return all;
  }

  /// An edge of the component at hand that reaches behind all planes of a set.
  struct ReachingEdge {
    EdgeId edge;
    bool is_bend =
        false;         ///< a part of it lies behind all of them, and the body bends inward there
    unsigned met = 0;  ///< by place in the set: it comes to the plane
  };
  /// A set of planes with one more of them.
  struct SetLevel {
    PlaneSide side = -1;
    std::vector<ReachingEdge> edges = {};
    std::shared_ptr<Boundary> body = nullptr;  ///< with all of them imprinted
    bool is_tried = false;                     ///< if they can be
    bool is_kept = false;                      ///< the points that this made are in use
    PointTable::PointMark mark = {};           ///< before them
  };

  /// All sets of the order that can make a corner, each once. They are grown plane by plane, as
  /// what a set cannot cap none can that has more planes.
  void try_sets(std::span<const PlaneSide> sides, std::size_t first) {
    for (std::size_t i = first; i < sides.size() && !work_.is_used_up(); ++i) {
      if (!fits(sides[i]) || !grow(sides[i])) continue;
      if (std::ssize(set_) == options_.order)
        try_set();
      else
        try_sets(sides, i + 1);
      shrink();
    }
  }

  /// It is a split plane, and equal normals never combine.
  [[nodiscard]] bool fits(PlaneSide side) const {
    if (std::ranges::find(options_.own_planes, side >> 1) != options_.own_planes.end())
      return false;
    const PlaneTable& planes = body_.world().planes;
    return std::ranges::none_of(set_, [&](PlaneSide s) {
      return planes.class_of(s >> 1) == planes.class_of(side >> 1) && (s & 1) == (side & 1);
    });
  }

  /// Adds a plane to the set, if it can cut with it: the wall of a hole holds a bend, of which a
  /// part lies behind all planes, and each plane meets an edge of the component where it is not in
  /// front of another.
  bool grow(PlaneSide side) {
    const SetLevel& before = levels_.back();
    if (before.is_tried && before.body == nullptr) return false;
    const unsigned bit = 1U << set_.size();
    SetLevel grown{side};
    unsigned met = 0;
    bool has_bend = false;
    work_.add(std::ssize(before.edges));
    for (ReachingEdge reaching : before.edges) {
      const int from = level(body_.origin(reaching.edge), side),
                to = level(body_.target(reaching.edge), side);
      if (std::min(from, to) > 0) continue;
      if (std::max(from, to) >= 0) reaching.met |= bit;
      reaching.is_bend = reaching.is_bend && std::min(from, to) < 0;
      met |= reaching.met;
      has_bend |= reaching.is_bend;
      grown.edges.push_back(reaching);
    }
    if (!has_bend || met != 2 * bit - 1) return false;
    levels_.push_back(std::move(grown));
    set_.push_back(side);
    return true;
  }

  /// Takes the last plane out of the set, and forgets its points if nothing was found with it.
  void shrink() {
    const SetLevel last = std::move(levels_.back());
    levels_.pop_back();
    set_.pop_back();
    if (last.is_kept)
      levels_.back().is_kept = true;
    else if (last.is_tried)
      body_.world().points.forget_since(last.mark);
    if (last.body != nullptr && last.body.use_count() == 1) spare_.push_back(last.body);
  }

  /// In the room of a copy that is no longer in use, if there is one.
  std::shared_ptr<Boundary> copy_of(const Boundary& body) {
    if (spare_.empty()) return std::make_shared<Boundary>(body);
    std::shared_ptr<Boundary> copy = std::move(spare_.back());
    spare_.pop_back();
    *copy = body;
    return copy;
  }

  /// The body with the first planes of the set imprinted; null if one of them cannot be.
  std::shared_ptr<const Boundary> imprinted(std::size_t count) {
    SetLevel& last = levels_[count];
    if (std::exchange(last.is_tried, true)) return last.body;
    const auto before = count > 1 ? imprinted(count - 1) : nullptr;
    last.mark = body_.world().points.mark();
    if (count > 1 && before == nullptr) return nullptr;
    auto body = copy_of(before != nullptr ? *before : body_);
    work_.add(2 * body->half_edge_count());  // it is copied, and indexed and changed
    if (imprint_all(*body, last.side, options_.weld_m)) last.body = std::move(body);
    return last.body;
  }

  /// The sides beyond the rim. If all are asked for, those beyond every convex edge, be it between
  /// two facets of the component, and those of all facets of the body that cross one of its own.
  [[nodiscard]] std::vector<PlaneSide> sides_for(const Component& component) const {
    if (!options_.has_all_sides) return component.sides;
    std::set<PlaneSide> sides;
    for (const BodyFacetId f : component.facets)
      body_.for_each_edge(f, [&](EdgeId e) {
        if (!body_.is_reflex(e)) sides.insert(body_.side_of_edge(body_.twin(e)));
      });
    work_.add(std::ssize(all_sides_) * std::ssize(component.facets));
    for (const PlaneSide side : all_sides_)
      if (std::ranges::any_of(component.facets, [&](BodyFacetId f) { return crosses(f, side); }))
        sides.insert(side);
    return {sides.begin(), sides.end()};
  }

  [[nodiscard]] bool crosses(BodyFacetId f, PlaneSide side) const {
    bool has_front = false, has_back = false;
    body_.for_each_edge(f, [&](EdgeId e) {
      const int here = level(body_.origin(e), side);
      has_front |= here > 0;
      has_back |= here < 0;
    });
    return has_front && has_back;
  }

  /// The edges of a component's facets, each once.
  [[nodiscard]] std::vector<ReachingEdge> edges_of(const Component& component) const {
    std::vector<EdgeId> edges;
    for (const BodyFacetId f : component.facets)
      body_.for_each_edge(f, [&](EdgeId e) { edges.push_back(std::min(e, body_.twin(e))); });
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<ReachingEdge> reaching;
    for (const EdgeId e : edges) reaching.push_back({e, body_.is_reflex(e)});
    return reaching;
  }

  [[nodiscard]] int level(PointId point, PlaneSide side) const {
    return body_.world().points.level(point, side);
  }

  void try_set() {
    if (!seen_.insert(set_).second) return;
    auto& points = body_.world().points;
    const auto old_points = levels_[1].is_tried ? levels_[1].mark.points : points.size();
    const auto body = imprinted(set_.size());
    if (body == nullptr) return;
    auto patches =
        CornerCutter(body, set_, body_.half_edge_count(), old_points, options_.weld_m).run();
    levels_.back().is_kept = !patches.empty();
    std::ranges::move(patches, std::back_inserter(patches_));
  }

  const Boundary body_;  ///< without what is dead, as it is copied for every set
  Work& work_;
  const CornerHoleOptions& options_;
  std::set<PlaneSide> all_sides_;
  IndexedVector<BodyFacetId, int> group_of_;
  std::vector<PlaneSide> set_;  ///< at hand
  std::vector<std::shared_ptr<Boundary>> spare_;
  std::vector<SetLevel> levels_;  ///< of no plane, of the set's first, of its first two …
  std::set<std::vector<PlaneSide>> seen_;
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<Patch> find_corner_holes(const Boundary& body, const CornerHoleOptions& options) {
  return CornerHoleFinder(body, options).run();
}

void remove_seams(Boundary& body) {
  for (const BodyFacetId f : body.living_facets())
    if (body.is_alive(f)) body.heal(f);
}

}  // namespace oriel::detail
