#include "kernel/segment/detail/corner_holes.h"

#include "kernel/segment/detail/edge_index.h"
#include "kernel/segment/detail/section.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The holes of one set of planes.
class CornerCutter {
 public:
  CornerCutter(const Boundary& body, const std::vector<Side>& sides, double weld_m,
               Scratch& scratch, std::int64_t& work)
      : old_edges_(body.half_edge_count()),
        body_(std::make_shared<Boundary>(body)),
        sides_(sides),
        weld_m_(weld_m),
        scratch_(scratch),
        work_(work) {}

  /// Empty unless one of them splits facets.
  std::vector<Patch> run() {
    work_ += std::ssize(sides_) * body_->half_edge_count();
    for (const Side side : sides_)
      if (!imprint_all(side)) return {};
    std::vector<Patch> patches;
    bool has_split = false;
    for (const Component& component : components_behind()) {
      auto patch = cap_component(*body_, true, component, work_);
      if (!patch) continue;
      has_split |= std::ranges::any_of(component.rim, [&](int e) { return e >= old_edges_; });
      patch->imprinted = body_;
      patches.push_back(std::move(*patch));
    }
    if (!has_split) patches.clear();
    return patches;
  }

 private:
  /// Makes the whole outline of the section just behind the plane edges of the body.
  bool imprint_all(Side side) {
    const EdgeIndex edges(*body_, {side >> 1});
    const int behind = (side & 1) != 0 ? 1 : -1;
    const Section section =
        section_at(*body_, side >> 1, behind, edges.edges_at(0), {-1, weld_m_}, scratch_);
    if (section.loops.empty()) return section.crossings.empty();
    Lump all;
    for (int r = 0; r < std::ssize(section.regions); ++r)
      if (section.regions[at(r)].is_material) all.regions.push_back(r);
    std::vector<int> touched;
    imprint(*body_, section, all, touched);
    return true;
  }

  [[nodiscard]] bool is_behind_all(int f) const {
    if (!body_->is_alive(f)) return false;
    const Side own = body_->facet(f).side;
    if (std::ranges::any_of(sides_, [&](Side s) { return s >> 1 == own >> 1; })) return false;
    bool is_behind = true;
    body_->for_each_edge(f, [&](int e) {
      for (const Side side : sides_) {
        const int level = body_->world().points.side(body_->origin(e), side >> 1);
        is_behind &= ((side & 1) != 0 ? -level : level) <= 0;
      }
    });
    return is_behind;
  }

  /// Connected facets behind all planes whose rim lies on all of them, and that bend inward.
  std::vector<Component> components_behind() {
    std::vector<int> state(at(body_->facet_count()), 0);  // 1: behind, 2: and in a component
    for (int f = 0; f < body_->facet_count(); ++f) state[at(f)] = is_behind_all(f) ? 1 : 0;
    std::vector<Component> found;
    for (int start = 0; start < body_->facet_count(); ++start) {
      if (state[at(start)] != 1) continue;
      Component component{{start}, {}, {}};
      state[at(start)] = 2;
      bool has_bend = false;
      for (std::size_t i = 0; i < component.facets.size(); ++i)
        body_->for_each_edge(component.facets[i], [&](int e) {
          const int g = body_->facet_of(body_->twin(e));
          if (state[at(g)] == 0) {
            component.rim.push_back(e);
            return;
          }
          has_bend |= body_->is_reflex(e);
          if (state[at(g)] != 1) return;
          state[at(g)] = 2;
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
    std::set<Side> met;
    for (const int e : component.rim) {
      const Side side = rim_side(*body_, sides_, e);
      if (side < 0) return false;
      met.insert(side);
    }
    return met.size() == sides_.size();
  }

  int old_edges_;
  std::shared_ptr<Boundary> body_;
  const std::vector<Side>& sides_;
  double weld_m_;
  Scratch& scratch_;
  std::int64_t& work_;
};

class CornerHoleFinder {
 public:
  CornerHoleFinder(const Boundary& body, int order, const std::vector<int>& own_planes,
                   double weld_m, std::int64_t budget, std::int64_t& work)
      : body_(body),
        order_(order),
        own_planes_(own_planes),
        weld_m_(weld_m),
        budget_(budget),
        work_(work) {}

  std::vector<Patch> run() {
    for (const Component& component : hole_components(body_, work_)) {
      if (component.facets.size() < 2) continue;
      bends_ = bends_of(component);
      std::vector<Side> set;
      try_sets(component.sides, 0, set);
    }
    return std::move(patches_);
  }

 private:
  /// All sets of the order that can make a corner, each once.
  void try_sets(const std::vector<Side>& sides, std::size_t first, std::vector<Side>& set) {
    if (std::ssize(set) == order_) return try_set(set);
    for (std::size_t i = first; i < sides.size() && work_ <= budget_; ++i) {
      if (!fits(set, sides[i])) continue;
      set.push_back(sides[i]);
      try_sets(sides, i + 1, set);
      set.pop_back();
    }
  }

  /// It is a split plane, and equal normals never combine.
  [[nodiscard]] bool fits(const std::vector<Side>& set, Side side) const {
    if (std::ranges::find(own_planes_, side >> 1) != own_planes_.end()) return false;
    const PlaneTable& planes = body_.world().planes;
    return std::ranges::none_of(set, [&](Side s) {
      return planes.class_of(s >> 1) == planes.class_of(side >> 1) && (s & 1) == (side & 1);
    });
  }

  /// The reflex edges between facets of a component.
  [[nodiscard]] std::vector<int> bends_of(const Component& component) const {
    std::vector<int> bends;
    for (const int f : component.facets)
      body_.for_each_edge(f, [&](int e) {
        if (e < body_.twin(e) && body_.is_reflex(e)) bends.push_back(e);
      });
    return bends;
  }

  /// The wall of a hole holds a bend: a part of one lies behind all planes.
  [[nodiscard]] bool has_bend_behind(const std::vector<Side>& set) const {
    auto& points = body_.world().points;
    const auto is_behind = [&](int point, Side side) {
      return points.side(point, side >> 1) * ((side & 1) != 0 ? -1 : 1) < 0;
    };
    return std::ranges::any_of(bends_, [&](int e) {
      return std::ranges::all_of(set, [&](Side side) {
        return is_behind(body_.origin(e), side) || is_behind(body_.target(e), side);
      });
    });
  }

  void try_set(const std::vector<Side>& set) {
    work_ += std::ssize(bends_);
    if (!has_bend_behind(set) || !seen_.insert(set).second) return;
    for (Patch& patch : CornerCutter(body_, set, weld_m_, scratch_, work_).run())
      patches_.push_back(std::move(patch));
  }

  const Boundary& body_;
  int order_;
  const std::vector<int>& own_planes_;
  double weld_m_;
  std::int64_t budget_;
  std::int64_t& work_;
  Scratch scratch_;
  std::vector<int> bends_;  ///< of the component at hand
  std::set<std::vector<Side>> seen_;
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<Patch> find_corner_holes(const Boundary& body, int order,
                                     const std::vector<int>& own_planes, double weld_m,
                                     std::int64_t budget, std::int64_t& work) {
  return CornerHoleFinder(body, order, own_planes, weld_m, budget, work).run();
}

void remove_seams(Boundary& body) {
  for (const int f : body.living_facets())
    if (body.is_alive(f)) body.heal(f);
}

}  // namespace oriel::detail
