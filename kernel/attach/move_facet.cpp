#include "kernel/attach/move_facet.h"

#include "kernel/attach/clearance.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/exact.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace oriel {

namespace {

class FacetMover {
 public:
  FacetMover(const Solid& solid, FacetId facet, double out_m)
      : solid_(solid),
        moving_(facet),
        from_(solid.planes[solid.facets[facet.index()].plane.index()]),
        to_(plane_in_front(from_, out_m, solid.grid_m)) {
    for (const Loop& loop : solid.facets[facet.index()].loops)
      for (const int v : loop) moved_.try_emplace(v);
  }

  MovedFacet run() {
    if (to_.offset == from_.offset) return {std::nullopt, "it would move by nothing"};
    find_planes();
    for (auto& [vertex, corner] : moved_)
      if (!meet(corner)) return {std::nullopt, "more than three planes meet in one of its corners"};
    if (turns_edge()) return {std::nullopt, "an edge of it would vanish"};
    if (is_in_the_way(solid_, moving_, moves())) return {std::nullopt, "something lies in its way"};
    Solid out = solid_;
    out.facets[moving_.index()].plane = {static_cast<int>(out.planes.size())};
    out.planes.push_back(to_);
    for (const auto& [vertex, corner] : moved_) out.vertices[at(vertex)] = {corner.point, true};
    return {std::move(out), {}};
  }

 private:
  /// A vertex of the moving facet: the planes of the other facets there, and where it goes.
  struct Corner {
    std::vector<const Plane*> planes;
    bool is_met_again = false;  ///< by another facet of the moving one's plane
    Vec3 point;
  };

  void find_planes() {
    for (const FacetId f : ids_below<FacetId>(solid_.facets.size())) {
      if (f == moving_) continue;
      const Plane& plane = solid_.planes[solid_.facets[f.index()].plane.index()];
      for (const Loop& loop : solid_.facets[f.index()].loops)
        for (const int v : loop)
          if (const auto found = moved_.find(v); found != moved_.end()) add(found->second, plane);
    }
  }

  void add(Corner& corner, const Plane& plane) const {
    const auto is_same = [](const Plane& p, const Plane& q) {
      return p.coefficients == q.coefficients && p.offset == q.offset;
    };
    if (is_same(plane, from_)) corner.is_met_again = true;
    if (std::ranges::none_of(corner.planes, [&](const Plane* p) { return is_same(*p, plane); }))
      corner.planes.push_back(&plane);
  }

  bool meet(Corner& corner) const {
    if (corner.is_met_again || corner.planes.size() != 2) return false;
    const auto point = exact::meet(to_, *corner.planes[0], *corner.planes[1]);
    if (point) corner.point = exact::to_metres(*point, solid_.grid_m);
    return point.has_value();
  }

  [[nodiscard]] Vec3 before(int v) const { return solid_.vertices[at(v)].point; }
  [[nodiscard]] Vec3 after(int v) const {
    const auto found = moved_.find(v);
    return found == moved_.end() ? before(v) : found->second.point;
  }

  [[nodiscard]] Moves moves() const {
    Moves moves;
    for (const auto& [v, corner] : moved_) moves.emplace(v, corner.point);
    return moves;
  }

  [[nodiscard]] bool turns_edge() const {
    for (const Facet& facet : solid_.facets)
      for (const Loop& loop : facet.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const int p = loop[i], q = loop[(i + 1) % loop.size()];
          if (!moved_.contains(p) && !moved_.contains(q)) continue;
          const Vec3 was = before(q) - before(p);
          if (dot(after(q) - after(p), was) < kLeastEdge_m * length(was)) return true;
        }
    return false;
  }

  const Solid& solid_;
  FacetId moving_;
  Plane from_, to_;
  std::map<int, Corner> moved_;  ///< by vertex
};

}  // namespace

MovedFacet move_facet(const Solid& solid, FacetId facet, double out_m) {
  return FacetMover(solid, facet, out_m).run();
}

Plane plane_in_front(const Plane& plane, double out_m, double grid_m) {
  const auto& c = plane.coefficients;
  const double size =
      length({static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])});
  return exact::make_plane(c, plane.offset + std::llround(out_m * size / grid_m), grid_m);
}

}  // namespace oriel
