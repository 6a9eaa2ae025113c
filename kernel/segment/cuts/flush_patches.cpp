#include "kernel/segment/cuts/flush_patches.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <optional>
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

}  // namespace

void add_flush_patches(FlatBody& body, const PatchOptions& options, std::vector<Patch>& patches) {
  FlushPatchFinder(body, options, patches).run();
}

}  // namespace oriel::detail
