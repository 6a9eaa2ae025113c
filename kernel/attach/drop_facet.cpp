#include "kernel/attach/drop_facet.h"

#include "kernel/attach/clearance.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/base/text/counted.h"
#include "kernel/geometry/exact.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel {

namespace {

class FacetDropper {
 public:
  FacetDropper(const Solid& solid, FacetId facet, double reach_m)
      : solid_(solid), dropped_(facet), reach_m_(reach_m) {}

  DroppedFacet run() {
    const Facet& facet = solid_.facets[dropped_.index()];
    if (facet.loops.size() != 1) return refused("it has holes");
    corners_ = facet.loops[0];
    if (corners_.size() != 3 && corners_.size() != 4)
      return refused("it has " + counted(corners_.size(), "corner"));
    if (!find_sides()) return refused("more than three planes meet in one of its corners");
    if (std::string reason = meet(); !reason.empty()) return refused(std::move(reason));
    if (leaves_less_than_triangle()) return refused("a neighbouring facet would vanish");
    if (turns_edge()) return refused("a neighbouring edge would vanish");
    if (is_in_the_way(solid_, dropped_, moves_)) return refused("something lies in its way");
    return {without_facet(), {}};
  }

 private:
  static DroppedFacet refused(std::string reason) { return {std::nullopt, std::move(reason)}; }

  /// The facet at each side of the dropped one, from its corner of that number to the next one.
  /// False if a corner has others than the two of its sides.
  bool find_sides() {
    const std::size_t n = corners_.size();
    sides_.assign(n, {});
    std::map<int, std::set<FacetId>> facets_at;
    for (const FacetId f : ids_below<FacetId>(solid_.facets.size())) {
      if (f == dropped_) continue;
      for (const Loop& loop : solid_.facets[f.index()].loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const auto corner = std::ranges::find(corners_, loop[i]);
          if (corner == corners_.end()) continue;
          facets_at[loop[i]].insert(f);
          const auto k = static_cast<std::size_t>(corner - corners_.begin());
          const std::size_t before = (k + n - 1) % n;
          if (loop[(i + 1) % loop.size()] == corners_[before]) sides_[before] = f;
        }
    }
    const auto has_three = [&](std::size_t i) {
      const FacetId one = sides_[(i + n - 1) % n], other = sides_[i];
      return one.is_valid() && other.is_valid() && one != other &&
             facets_at[corners_[i]].size() == 2;
    };
    for (std::size_t i = 0; i < n; ++i)
      if (!has_three(i)) return false;
    return true;
  }

  [[nodiscard]] Vec3 point(int v) const { return solid_.vertices[at(v)].point; }
  [[nodiscard]] double side_m(std::size_t i) const {
    return length(point(corners_[(i + 1) % corners_.size()]) - point(corners_[i]));
  }

  /// Finds where corners go; what is in the way of that.
  std::string meet() {
    if (corners_.size() == 3) return meet({0, 1, 2}, {0, 1, 2});
    const std::size_t first = side_m(0) + side_m(2) < side_m(1) + side_m(3) ? 0 : 1;
    std::string reason;
    for (const std::size_t i : {first, first + 2})
      if (reason.empty()) reason = meet({i, (i + 1) % 4}, {(i + 3) % 4, i, (i + 1) % 4});
    return reason;
  }

  /// The corners of these numbers go to where the facets at three sides meet.
  std::string meet(const std::vector<std::size_t>& corners, std::array<std::size_t, 3> sides) {
    const auto plane = [&](std::size_t i) -> const Plane& {
      return solid_.planes[solid_.facets[sides_[sides.at(i)].index()].plane.index()];
    };
    const auto met = exact::meet(plane(0), plane(1), plane(2));
    if (!met) return "its neighbours do not meet";
    const Vec3 to = exact::to_metres(*met, solid_.grid_m);
    for (const std::size_t i : corners) {
      if (length(to - point(corners_[i])) > reach_m_) return "its neighbours meet too far away";
      moves_[corners_[i]] = to;
      becomes_[corners_[i]] = corners_[corners[0]];
    }
    return {};
  }

  [[nodiscard]] int after(int v) const {
    const auto found = becomes_.find(v);
    return found == becomes_.end() ? v : found->second;
  }
  [[nodiscard]] Vec3 point_after(int v) const {
    const auto found = moves_.find(v);
    return found == moves_.end() ? point(v) : found->second;
  }

  [[nodiscard]] Loop loop_after(const Loop& loop) const {
    Loop out;
    for (const int v : loop)
      if (out.empty() || out.back() != after(v)) out.push_back(after(v));
    while (out.size() > 1 && out.front() == out.back()) out.pop_back();
    return out;
  }

  [[nodiscard]] bool leaves_less_than_triangle() const {
    return std::ranges::any_of(sides_, [&](FacetId side) {
      return std::ranges::any_of(solid_.facets[side.index()].loops,
                                 [&](const Loop& loop) { return loop_after(loop).size() < 3; });
    });
  }

  /// Of edges that do not become a point.
  [[nodiscard]] bool turns_edge() const {
    for (const FacetId side : sides_)
      for (const Loop& loop : solid_.facets[side.index()].loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const int p = loop[i], q = loop[(i + 1) % loop.size()];
          if (after(p) == after(q)) continue;
          const Vec3 was = point(q) - point(p);
          if (dot(point_after(q) - point_after(p), was) < kLeastEdge_m * length(was)) return true;
        }
    return false;
  }

  [[nodiscard]] Solid without_facet() const {
    Solid out = solid_;
    for (const auto& [v, to] : moves_) out.vertices[at(after(v))] = {to, true};
    for (const FacetId side : sides_)
      for (Loop& loop : out.facets[side.index()].loops) loop = loop_after(loop);
    out.facets.erase(out.facets.begin() + static_cast<std::ptrdiff_t>(dropped_.index()));
    for (Shell& shell : out.shells) {
      std::erase(shell.facets, dropped_);
      for (FacetId& id : shell.facets)
        if (dropped_ < id) id = FacetId{static_cast<int>(id.index()) - 1};
    }
    return out;
  }

  const Solid& solid_;
  FacetId dropped_;
  double reach_m_;
  Loop corners_;
  std::vector<FacetId> sides_;  ///< of each side of the dropped facet the one beside it
  Moves moves_;                 ///< by corner
  std::map<int, int> becomes_;  ///< by corner the vertex that stands for it
};

}  // namespace

DroppedFacet drop_facet(const Solid& solid, FacetId facet, double reach_m) {
  return FacetDropper(solid, facet, reach_m).run();
}

}  // namespace oriel
