#include "kernel/attach/foot_line.h"

#include "kernel/attach/clearance.h"
#include "kernel/base/index.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace oriel::detail {

namespace {

/// Facets that are steeper than this (sine from the vertical) are no roofs: 75 degrees.
constexpr double kRoof = 0.26;
/// A block has few sides, and no roof so many facets under it.
constexpr std::size_t kMostPoints = 64;

class FootTracer {
 public:
  FootTracer(const Solid& solid, const BlockAcross& block) : solid_(solid), sides_(block.sides) {}

  FootLine run() {
    if (!find_start()) return {{}, "its outline does not fit into the facet"};
    while (line_.size() < kMostPoints) {
      const char* reason = go_on();
      if (reason != nullptr) return {{}, reason};
      if (line_.back().side != 0 || line_.back().is_crossing()) continue;
      // Round to where it began.
      const bool is_closed = line_.back().facet == line_.front().facet &&
                             length(line_.back().point - line_.front().point) < kLeastEdge_m;
      line_.pop_back();
      if (!is_closed) break;
      return {std::move(line_), {}};
    }
    return {{}, "its outline does not close on the roof"};
  }

 private:
  [[nodiscard]] const Plane& plane_of(FacetId id) const {
    return solid_.planes[solid_.facets[id.index()].plane.index()];
  }
  [[nodiscard]] const Plane& side(int i) const { return sides_[at(i) % sides_.size()]; }
  [[nodiscard]] std::optional<Vec3> meeting(const Plane& p, const Plane& q, const Plane& r) const {
    const auto point = exact::meet(p, q, r);
    if (!point) return std::nullopt;
    return exact::to_metres(*point, solid_.grid_m);
  }

  /// The highest facet that the edge between the last side and the first comes out of.
  bool find_start() {
    for (int f = 0; f < std::ssize(solid_.facets); ++f) {
      const Plane& plane = plane_of({f});
      if (plane.normal.z <= kRoof) continue;
      const auto corner = meeting(plane, sides_.back(), sides_.front());
      if (!corner || !contains(outlines_of(solid_.vertices, solid_.facets[at(f)].loops),
                               plane.normal, *corner))
        continue;
      if (!line_.empty() && line_[0].point.z >= corner->z) continue;
      line_ = {{*corner, true, 0, {f}, {-1, -1}}};
    }
    return !line_.empty();
  }

  /// The next point of the line; a reason if there is none.
  const char* go_on() {
    const FootPoint here = line_.back();
    const Plane& plane = plane_of(here.facet);
    const Vec3 along = normalised(cross(plane.normal, side(here.side).normal));
    const Plane& next = side(here.side + 1);
    const double towards = dot(next.normal, along);
    const double to_corner = towards > 0 ? -ahead_of(next, here.point) / towards : Box::kInfinity;
    double to_edge = Box::kInfinity;
    std::pair<int, int> crossed{-1, -1};
    for (const Loop& loop : solid_.facets[here.facet.index()].loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::pair edge{loop[i], loop[(i + 1) % loop.size()]};
        const double way = way_out(here, plane.normal, along, edge);
        if (way >= to_edge) continue;
        to_edge = way;
        crossed = edge;
      }
    if (std::abs(to_edge - to_corner) < kLeastEdge_m) return "its corner lies on an edge";
    return to_corner < to_edge ? turn(here, next) : cross_over(here, crossed);
  }

  /// How far along the line it is to an edge over which it leaves the facet.
  [[nodiscard]] double way_out(const FootPoint& here, Vec3 normal, Vec3 along,
                               std::pair<int, int> edge) const {
    if (here.is_crossing() && edge == std::pair{here.edge.second, here.edge.first})
      return Box::kInfinity;
    const Vec3 a = solid_.vertices[at(edge.first)].point;
    const Vec3 b = solid_.vertices[at(edge.second)].point;
    const double of_a = ahead_of(side(here.side), a), of_b = ahead_of(side(here.side), b);
    if ((of_a > 0) == (of_b > 0) || dot(cross(normal, b - a), along) >= 0) return Box::kInfinity;
    const double way = dot(a + of_a / (of_a - of_b) * (b - a) - here.point, along);
    return way > 0 ? way : Box::kInfinity;
  }

  const char* turn(const FootPoint& here, const Plane& next) {
    const auto corner = meeting(plane_of(here.facet), side(here.side), next);
    if (!corner) return "its outline does not fit into the facet";
    const int count = static_cast<int>(sides_.size());
    line_.push_back({*corner, true, (here.side + 1) % count, here.facet, {-1, -1}});
    return nullptr;
  }

  const char* cross_over(const FootPoint& here, std::pair<int, int> edge) {
    if (edge.first < 0) return "its outline does not close on the roof";
    const auto beyond = facet_with(edge.second, edge.first);
    if (!beyond || plane_of(*beyond).normal.z <= kRoof)
      return "its outline does not fit into the facet";
    const Vec3 a = solid_.vertices[at(edge.first)].point;
    const Vec3 b = solid_.vertices[at(edge.second)].point;
    const auto met = meeting(plane_of(here.facet), plane_of(*beyond), side(here.side));
    const bool is_meeting = met && distance_to_segment(*met, a, b) < kLeastEdge_m;
    const double of_a = ahead_of(side(here.side), a), of_b = ahead_of(side(here.side), b);
    const Vec3 on_edge = exact::on_grid(a + of_a / (of_a - of_b) * (b - a), solid_.grid_m);
    line_.push_back({is_meeting ? *met : on_edge, is_meeting, here.side, *beyond, edge});
    return nullptr;
  }

  [[nodiscard]] std::optional<FacetId> facet_with(int a, int b) const {
    for (int f = 0; f < std::ssize(solid_.facets); ++f)
      for (const Loop& loop : solid_.facets[at(f)].loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
          if (loop[i] == a && loop[(i + 1) % loop.size()] == b) return FacetId{f};
    return std::nullopt;
  }

  const Solid& solid_;
  const std::vector<Plane>& sides_;
  std::vector<FootPoint> line_;
};

}  // namespace

double ahead_of(const Plane& plane, Vec3 point) {
  return dot(plane.normal, point) - plane.offset_m;
}

FootLine foot_line(const Solid& solid, const BlockAcross& block) {
  return FootTracer(solid, block).run();
}

}  // namespace oriel::detail
