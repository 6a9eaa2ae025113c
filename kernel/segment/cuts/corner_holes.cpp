#include "kernel/segment/cuts/corner_holes.h"

#include "kernel/base/index.h"
#include "kernel/segment/sections/edge_index.h"
#include "kernel/segment/sections/section.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <set>

namespace oriel::detail {

namespace {

/// The holes of one set of planes.
class CornerCutter {
 public:
  CornerCutter(const Boundary& body, const std::vector<PlaneSide>& sides, double weld_m,
               std::int64_t& work)
      : old_edges_(body.half_edge_count()),
        old_points_(body.world().points.size()),
        body_(std::make_shared<Boundary>(body)),
        sides_(sides),
        weld_m_(weld_m),
        work_(work) {}

  std::vector<Patch> run() {
    // The body is copied, and asked what lies behind the planes; for each it is indexed and
    // changed.
    work_ += 2 * (std::ssize(sides_) + 1) * body_->half_edge_count();
    for (const PlaneSide side : sides_)
      if (!imprint_all(side)) return {};
    std::vector<Patch> patches;
    FlatBody flat(*body_);
    for (const Component& component : components_behind()) {
      auto patch = cap_component(flat, true, component, work_);
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
      const int point = body_->origin(e);
      const PlaneSide side = rim_side(*body_, sides_, e);
      const double distance =
          dot(world.planes.normal(side), world.points.at(point)) - world.planes.offset_m(side);
      return point < old_points_ || std::abs(distance) <= kBesidePlane * weld_m_;
    });
  }

  /// Makes the whole outline of the section just behind the plane edges of the body.
  bool imprint_all(PlaneSide side) {
    EdgeIndex edges(*body_, {side >> 1});
    const int behind = (side & 1) != 0 ? 1 : -1;
    Section section{side >> 1, behind};
    section_at(*body_, section, edges.edges_at(0, section.direction), {-1, weld_m_});
    if (section.loops.empty()) return section.crossings.empty();
    Lump all;
    for (int r = 0; r < std::ssize(section.regions); ++r)
      if (section.regions[at(r)].is_material) all.regions.push_back(r);
    std::vector<int> touched;
    imprint(*body_, section, all, touched);
    return true;
  }

  [[nodiscard]] bool is_behind_all(BodyFacetId f) const {
    if (!body_->is_alive(f)) return false;
    const PlaneSide own = body_->facet(f).side;
    if (std::ranges::any_of(sides_, [&](PlaneSide s) { return s >> 1 == own >> 1; })) return false;
    return std::ranges::all_of(body_->facet(f).loops, [&](LoopId l) {
      const EdgeId first = body_->loop(l).first;
      EdgeId e = first;
      do {
        for (const PlaneSide side : sides_)
          if (body_->world().points.level(body_->origin(e), side) > 0) return false;
        e = body_->next(e);
      } while (e != first);
      return true;
    });
  }

  /// Connected facets behind all planes whose rim lies on all of them, and that bend inward.
  std::vector<Component> components_behind() {
    IndexedVector<BodyFacetId, int> state(at(body_->facet_count()),
                                          0);  // 1: behind, 2: and in a component
    for (const BodyFacetId f : body_->facet_ids()) state[f] = is_behind_all(f) ? 1 : 0;
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
      component.sides = sides_;
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
  std::shared_ptr<Boundary> body_;
  const std::vector<PlaneSide>& sides_;
  double weld_m_;
  std::int64_t& work_;
};

class CornerHoleFinder {
 public:
  CornerHoleFinder(const Boundary& body, const CornerHoleOptions& options, std::int64_t& work)
      : body_(body), options_(options), work_(work) {
    for (const BodyFacetId f : body.living_facets()) all_sides_.insert(body.facet(f).side);
  }

  std::vector<Patch> run() {
    const std::vector<Component> groups = hole_components(body_, work_);
    number_groups(groups);
    for (const Component& group : groups) {
      if (group.facets.size() < 2) continue;
      const Component component = options_.has_all_sides ? with_neighbours(group, groups) : group;
      edges_ = edges_of(component);
      std::vector<PlaneSide> set;
      try_sets(sides_for(component), 0, set);
    }
    return std::move(patches_);
  }

 private:
  void number_groups(const std::vector<Component>& groups) {
    group_of_.assign(at(body_.facet_count()), -1);
    for (int g = 0; g < std::ssize(groups); ++g)
      for (const BodyFacetId f : groups[at(g)].facets) group_of_[f] = g;
  }

  /// A pocket with those that open into it: a tunnel from another wall has its own bends.
  [[nodiscard]] Component with_neighbours(const Component& group,
                                          const std::vector<Component>& groups) const {
    std::set<int> joined{group_of_[group.facets[0]]};
    for (const EdgeId e : group.rim) joined.insert(group_of_[body_.facet_of(body_.twin(e))]);
    Component all;
    for (const int g : joined)
      if (groups[at(g)].facets.size() >= 2)
        all.facets.insert(all.facets.end(), groups[at(g)].facets.begin(),
                          groups[at(g)].facets.end());
    return all;
  }

  /// All sets of the order that can make a corner, each once.
  void try_sets(const std::vector<PlaneSide>& sides, std::size_t first,
                std::vector<PlaneSide>& set) {
    if (std::ssize(set) == options_.order) return try_set(set);
    for (std::size_t i = first; i < sides.size() && work_ <= options_.budget; ++i) {
      if (!fits(set, sides[i])) continue;
      set.push_back(sides[i]);
      try_sets(sides, i + 1, set);
      set.pop_back();
    }
  }

  /// It is a split plane, and equal normals never combine.
  [[nodiscard]] bool fits(const std::vector<PlaneSide>& set, PlaneSide side) const {
    if (std::ranges::find(options_.own_planes, side >> 1) != options_.own_planes.end())
      return false;
    const PlaneTable& planes = body_.world().planes;
    return std::ranges::none_of(set, [&](PlaneSide s) {
      return planes.class_of(s >> 1) == planes.class_of(side >> 1) && (s & 1) == (side & 1);
    });
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
  [[nodiscard]] std::vector<EdgeId> edges_of(const Component& component) const {
    std::vector<EdgeId> edges;
    for (const BodyFacetId f : component.facets)
      body_.for_each_edge(f, [&](EdgeId e) { edges.push_back(std::min(e, body_.twin(e))); });
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  }

  [[nodiscard]] int level(int point, PlaneSide side) const {
    return body_.world().points.level(point, side);
  }

  /// The wall of a hole holds a bend, of which a part lies behind all planes, and each plane meets
  /// an edge of the component where it is not in front of another.
  [[nodiscard]] bool can_cut(const std::vector<PlaneSide>& set) const {
    bool has_bend = false;
    std::vector<char> is_met(set.size(), 0);
    for (const EdgeId e : edges_) {
      bool is_behind = true, reaches_behind = true;
      for (const PlaneSide side : set) {
        const int low = std::min(level(body_.origin(e), side), level(body_.target(e), side));
        is_behind &= low < 0;
        reaches_behind &= low <= 0;
        if (!reaches_behind) break;
      }
      has_bend |= is_behind && body_.is_reflex(e);
      for (std::size_t i = 0; reaches_behind && i < set.size(); ++i)
        is_met[i] |=
            level(body_.origin(e), set[i]) >= 0 || level(body_.target(e), set[i]) >= 0 ? 1 : 0;
    }
    return has_bend && std::ranges::find(is_met, 0) == is_met.end();
  }

  void try_set(const std::vector<PlaneSide>& set) {
    work_ += std::ssize(edges_);
    if (!can_cut(set) || !seen_.insert(set).second) return;
    auto& points = body_.world().points;
    const auto mark = points.mark();
    auto patches = CornerCutter(body_, set, options_.weld_m, work_).run();
    if (patches.empty()) points.forget_since(mark);
    std::ranges::move(patches, std::back_inserter(patches_));
  }

  const Boundary& body_;
  const CornerHoleOptions& options_;
  std::int64_t& work_;
  std::set<PlaneSide> all_sides_;
  IndexedVector<BodyFacetId, int> group_of_;
  std::vector<EdgeId> edges_;  ///< of the component at hand
  std::set<std::vector<PlaneSide>> seen_;
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<Patch> find_corner_holes(const Boundary& body, const CornerHoleOptions& options,
                                     std::int64_t& work) {
  return CornerHoleFinder(body, options, work).run();
}

void remove_seams(Boundary& body) {
  for (const BodyFacetId f : body.living_facets())
    if (body.is_alive(f)) body.heal(f);
}

}  // namespace oriel::detail
