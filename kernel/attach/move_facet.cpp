#include "kernel/attach/move_facet.h"

#include "kernel/attach/detail/clearance.h"
#include "kernel/geometry/exact.h"
#include "kernel/model/detail/index.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace oriel {

namespace {

/// Edges of the result are no shorter: what is nearer becomes one vertex when it is read again.
constexpr double kLeastEdge_m = 0.001;

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
    if (is_in_the_way()) return {std::nullopt, "something lies in its way"};
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
    for (int f = 0; f < std::ssize(solid_.facets); ++f) {
      if (FacetId{f} == moving_) continue;
      const Plane& plane = solid_.planes[solid_.facets[at(f)].plane.index()];
      for (const Loop& loop : solid_.facets[at(f)].loops)
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

  /// What the facet passes through: in its own axes the box around its corners, before and after.
  [[nodiscard]] std::vector<detail::HalfSpaceM> passage() const {
    const Vec3 n = from_.normal;
    const Vec3 u = normalised(std::abs(n.z) < 0.9 ? cross({0, 0, 1}, n) : cross({1, 0, 0}, n));
    std::vector<detail::HalfSpaceM> limits;
    for (const Vec3 direction : {u, -u, cross(n, u), -cross(n, u)}) {
      detail::HalfSpaceM limit{direction, -Box::kInfinity};
      for (const auto& [v, corner] : moved_)
        limit.offset_m =
            std::max({limit.offset_m, dot(direction, before(v)), dot(direction, corner.point)});
      limits.push_back(limit);
    }
    limits.push_back({n, std::max(from_.offset_m, to_.offset_m) + kLeastEdge_m});
    limits.push_back({-n, -std::min(from_.offset_m, to_.offset_m) + kLeastEdge_m});
    return limits;
  }

  [[nodiscard]] bool is_in_the_way() const {
    const auto limits = passage();
    const auto is_within = [&](Vec3 point) {
      return std::ranges::all_of(limits, [&](const detail::HalfSpaceM& limit) {
        return dot(limit.normal, point) <= limit.offset_m;
      });
    };
    for (int f = 0; f < std::ssize(solid_.facets); ++f) {
      if (FacetId{f} == moving_) continue;
      const Facet& facet = solid_.facets[at(f)];
      bool is_beside = false, has_point_within = false;
      for (const Loop& loop : facet.loops)
        for (const int v : loop) {
          is_beside = is_beside || moved_.contains(v);
          has_point_within = has_point_within || (!moved_.contains(v) && is_within(before(v)));
        }
      if (has_point_within) return true;
      const Vec3 normal = solid_.planes[facet.plane.index()].normal;
      if (!is_beside &&
          detail::area_within(solid_.vertices, facet, normal, limits) > detail::kTouch_m2)
        return true;
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
