#include "kernel/attach/raise_across.h"

#include "kernel/attach/clearance.h"
#include "kernel/attach/new_facet.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "model/vec3.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace oriel {

namespace {

/// A point of the line in which the sides of a block cut a roof.
struct FootPoint {
  Vec3 point;
  bool is_meeting = false;  ///< of three planes
  /// The side of the block that the line follows from here, and the facet that it is on.
  int side = 0;
  FacetId facet{};
  /// Where it crosses an edge of the roof: the edge as the facet has it that the line comes from.
  /// (-1, -1) in a corner of the block.
  std::pair<int, int> edge{-1, -1};

  [[nodiscard]] bool is_crossing() const { return edge.first >= 0; }
};

/// The line in which the sides of a block cut the facets of a solid that look up, the block on its
/// left seen from above; it is closed. Begins in the corner between the last side and the first.
struct FootLine {
  std::vector<FootPoint> points;
  /// If there is none.
  std::string reason;
};

/// How far a point is in front of a plane.
double ahead_of(const Plane& plane, Vec3 point) {
  return dot(plane.normal, point) - plane.offset_m;
}

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
    for (const FacetId f : ids_below<FacetId>(solid_.facets.size())) {
      const Plane& plane = plane_of(f);
      if (plane.normal.z <= kRoof) continue;
      const auto corner = meeting(plane, sides_.back(), sides_.front());
      if (!corner || !contains(outlines_of(solid_.vertices, solid_.facets[f.index()].loops),
                               plane.normal, *corner))
        continue;
      if (!line_.empty() && line_[0].point.z >= corner->z) continue;
      line_ = {{*corner, true, 0, f, {-1, -1}}};
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
    for (const FacetId f : ids_below<FacetId>(solid_.facets.size()))
      for (const Loop& loop : solid_.facets[f.index()].loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
          if (loop[i] == a && loop[(i + 1) % loop.size()] == b) return f;
    return std::nullopt;
  }

  const Solid& solid_;
  const std::vector<Plane>& sides_;
  std::vector<FootPoint> line_;
};

/// A point of a facet's loop: a vertex of the solid, or where the foot's line enters the facet or
/// leaves it.
struct LoopPoint {
  int vertex = -1;  ///< of the new solid
  enum class Kind { corner, enters, leaves } kind = Kind::corner;
  std::size_t of_line = 0;
};

class AcrossRaiser {
 public:
  AcrossRaiser(const Solid& solid, const BlockAcross& block, const Clearance& clearance)
      : solid_(solid), block_(block), clearance_(clearance) {}

  Attached run() {
    FootLine line = FootTracer(solid_, block_).run();
    if (!line.reason.empty()) return refused(line.reason.c_str());
    line_ = std::move(line.points);
    if (const char* reason = why_not()) return refused(reason);
    Attached out;
    out.solid = solid_;
    add_vertices(*out.solid);
    for (const FacetId facet : under_)
      if (const char* reason = cut_foot_out(facet, *out.solid)) return refused(reason);
    add_sides(out);
    if (!is_closed(*out.solid)) return refused("another part stands there");
    return out;
  }

 private:
  static Attached refused(const char* reason) { return {std::nullopt, {}, reason}; }

  [[nodiscard]] const Facet& facet(FacetId id) const { return solid_.facets[id.index()]; }
  [[nodiscard]] Vec3 point(int v) const { return solid_.vertices[at(v)].point; }
  [[nodiscard]] const FootPoint& after(std::size_t k) const {
    return line_[(k + 1) % line_.size()];
  }
  /// Between this side and the next one the block has an upright edge, up to its top.
  [[nodiscard]] bool has_upright_edge(std::size_t side) const {
    return block_.lid || side + 2 < block_.sides.size();
  }
  [[nodiscard]] const Plane& top() const { return block_.lid ? *block_.lid : block_.sides.back(); }
  [[nodiscard]] bool is_inside(Vec3 p) const {
    return std::ranges::all_of(block_.sides,
                               [&](const Plane& side) { return ahead_of(side, p) < 0; });
  }

  const char* why_not() {
    for (const FootPoint& here : line_) {
      under_.insert(here.facet);
      if (here.is_crossing()) {
        crossed_.insert(here.edge);
        crossed_.insert({here.edge.second, here.edge.first});
      }
    }
    if (crossed_.empty()) return "its foot is on one facet";
    if (draws_short_edge()) return "it would draw an edge that is too short";
    if (!is_clear_of_edges()) return "its outline does not fit into the facet";
    if (!find_tops()) return "its top lies below the roof";
    if (meets_others()) return "it would come too near to another part";
    return nullptr;
  }

  [[nodiscard]] bool draws_short_edge() const {
    const double least_m = std::max(block_.least_edge_m, kLeastEdge_m);
    for (std::size_t k = 0; k < line_.size(); ++k) {
      if (length(after(k).point - line_[k].point) < least_m) return true;
      if (!line_[k].is_crossing()) continue;
      for (const int v : {line_[k].edge.first, line_[k].edge.second})
        if (!is_inside(point(v)) && length(line_[k].point - point(v)) < least_m) return true;
    }
    return false;
  }

  [[nodiscard]] bool is_clear_of_edges() const {
    for (std::size_t k = 0; k < line_.size(); ++k)
      for (const Loop& loop : facet(line_[k].facet).loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const int a = loop[i], b = loop[(i + 1) % loop.size()];
          if (crossed_.contains({a, b}) || (is_inside(point(a)) && is_inside(point(b)))) continue;
          const std::pair edge{point(a), point(b)};
          if (is_too_near(clearance_, distance({line_[k].point, after(k).point}, edge), edge))
            return false;
        }
    return true;
  }

  /// The upper ends of upright edges; false if the roof reaches through the top.
  bool find_tops() {
    for (std::size_t k = 0; k < line_.size(); ++k) {
      if (!line_[k].is_crossing()) continue;
      for (const int v : {line_[k].edge.first, line_[k].edge.second})
        if (is_inside(point(v)) && ahead_of(top(), point(v)) > -kLeastEdge_m) return false;
    }
    for (std::size_t i = 0; i < block_.sides.size(); ++i) {
      if (!has_upright_edge(i)) continue;
      const auto met =
          exact::meet(block_.sides[i], block_.sides[(i + 1) % block_.sides.size()], top());
      if (!met) return false;
      tops_.push_back(exact::to_metres(*met, solid_.grid_m));
    }
    return std::ranges::all_of(line_, [&](const FootPoint& here) {
      const bool is_on_top = !block_.lid && (ahead_of(top(), here.point) > -kLeastEdge_m);
      return is_on_top || ahead_of(top(), here.point) < -kLeastEdge_m;
    });
  }

  /// The roof rises over each edge that the foot crosses, so the block lies above all its facets.
  [[nodiscard]] bool is_in_valley() const {
    for (std::size_t k = 0; k < line_.size(); ++k) {
      if (!line_[k].is_crossing()) continue;
      const FacetId from = line_[before(k)].facet;
      const Plane& plane = solid_.planes[facet(from).plane.index()];
      if (ahead_of(plane, after(k).point) <= 0) return false;
    }
    return true;
  }

  /// Another facet has a part in the block grown by the clearance. The block lies above one of the
  /// facets under it, in a valley above all.
  [[nodiscard]] bool meets_others() const {
    constexpr double kNearlyAll = 0.999;
    std::vector<HalfSpaceM> limits;
    const double grown_m = kNearlyAll * std::max(clearance_.least_m, kLeastEdge_m);
    for (const Plane& side : block_.sides) limits.push_back({side.normal, side.offset_m + grown_m});
    if (block_.lid) limits.push_back({block_.lid->normal, block_.lid->offset_m + grown_m});
    const std::size_t count = limits.size();
    const bool is_above_all = is_in_valley();
    for (const FacetId f : ids_below<FacetId>(solid_.facets.size())) {
      if (under_.contains(f)) continue;
      const Vec3 normal = solid_.planes[solid_.facets[f.index()].plane.index()].normal;
      limits.resize(count);
      for (const FacetId roof : under_) {
        const Plane& plane = solid_.planes[facet(roof).plane.index()];
        if (!is_above_all) limits.resize(count);
        limits.push_back({-plane.normal, -plane.offset_m});
        if (is_above_all && limits.size() < count + under_.size()) continue;
        if (area_within(solid_.vertices, solid_.facets[f.index()], normal, limits) > kTouch_m2)
          return true;
      }
    }
    return false;
  }

  void add_vertices(Solid& solid) {
    first_of_line_ = static_cast<int>(solid.vertices.size());
    for (const FootPoint& here : line_) solid.vertices.push_back({here.point, here.is_meeting});
    first_top_ = static_cast<int>(solid.vertices.size());
    for (const Vec3 p : tops_) solid.vertices.push_back({p, true});
  }
  [[nodiscard]] int of_line(std::size_t k) const {
    return first_of_line_ + static_cast<int>(k % line_.size());
  }

  /// The loops of a facet with the points where the line enters and leaves it.
  [[nodiscard]] std::vector<LoopPoint> marked(FacetId id, const Loop& loop) const {
    std::vector<LoopPoint> points;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::pair edge{loop[i], loop[(i + 1) % loop.size()]};
      points.push_back({edge.first});
      const std::size_t first = points.size();
      for (std::size_t k = 0; k < line_.size(); ++k) {
        if (line_[k].edge == edge)
          points.push_back({of_line(k), LoopPoint::Kind::leaves, k});
        else if (line_[k].edge == std::pair{edge.second, edge.first} && line_[k].facet == id)
          points.push_back({of_line(k), LoopPoint::Kind::enters, k});
      }
      std::sort(points.begin() + static_cast<std::ptrdiff_t>(first), points.end(),
                [&](const LoopPoint& p, const LoopPoint& q) {
                  const Vec3 from = point(edge.first);
                  return length(line_[p.of_line].point - from) <
                         length(line_[q.of_line].point - from);
                });
    }
    return points;
  }

  /// What is left of a loop: from where the line enters to where it leaves, and back along it.
  std::vector<Loop> pieces_of(const std::vector<LoopPoint>& points) const {
    std::vector<Loop> pieces;
    std::set<std::size_t> done;
    const std::size_t n = points.size();
    for (std::size_t start = 0; start < n; ++start) {
      if (points[start].kind != LoopPoint::Kind::enters || done.contains(start)) continue;
      Loop piece;
      std::size_t i = start;
      do {
        done.insert(i);
        piece.push_back(points[i].vertex);
        for (i = (i + 1) % n; points[i].kind == LoopPoint::Kind::corner; i = (i + 1) % n)
          piece.push_back(points[i].vertex);
        if (points[i].kind != LoopPoint::Kind::leaves) return {};
        std::size_t k = points[i].of_line;
        piece.push_back(of_line(k));
        for (k = before(k); !line_[k].is_crossing(); k = before(k)) piece.push_back(of_line(k));
        const auto back = std::ranges::find_if(points, [&](const LoopPoint& p) {
          return p.kind == LoopPoint::Kind::enters && p.of_line == k;
        });
        if (back == points.end()) return {};
        i = static_cast<std::size_t>(back - points.begin());
      } while (i != start && piece.size() <= 4 * (n + line_.size()));
      pieces.push_back(std::move(piece));
    }
    return pieces;
  }
  [[nodiscard]] std::size_t before(std::size_t k) const {
    return (k + line_.size() - 1) % line_.size();
  }

  /// Takes the foot out of one of the facets under it, which may fall into pieces.
  const char* cut_foot_out(FacetId id, Solid& solid) const {
    const Facet whole = facet(id);
    for (std::size_t l = 1; l < whole.loops.size(); ++l)
      if (is_inside(point(whole.loops[l][0]))) return "another part stands there";
    const std::vector<Loop> pieces = pieces_of(marked(id, whole.loops[0]));
    if (pieces.empty()) return "its outline does not fit into the facet";
    std::vector<FacetId> ids{id};
    const Plane plane = solid_.planes[whole.plane.index()];
    solid.facets[id.index()].loops = {pieces[0]};
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      ids.push_back(detail::add_facet(solid, plane, pieces[i], id));
      solid.facets[ids.back().index()].polygons = whole.polygons;
    }
    for (std::size_t l = 1; l < whole.loops.size(); ++l) {
      const auto around = std::ranges::find_if(ids, [&](FacetId piece) {
        return contains(outlines_of(solid.vertices, {solid.facets[piece.index()].loops[0]}),
                        plane.normal, point(whole.loops[l][0]));
      });
      if (around == ids.end()) return "its outline does not fit into the facet";
      solid.facets[around->index()].loops.push_back(whole.loops[l]);
    }
    return nullptr;
  }

  /// The sides, each from its foot up to the top, and the lid.
  void add_sides(Attached& out) const {
    const std::size_t count = block_.sides.size();
    std::vector<Loop> loops(count);
    for (std::size_t k = 0; k < line_.size(); ++k) {
      const auto side = at(line_[k].side);
      loops[side].push_back(of_line(k));
      if (after(k).side != line_[k].side) loops[side].push_back(of_line(k + 1));
    }
    Loop lid;
    for (int t = 0; t < std::ssize(tops_); ++t) lid.push_back(first_top_ + t);
    for (std::size_t i = 0; i < count; ++i) {
      if (has_upright_edge(i)) loops[i].push_back(lid[i]);
      const std::size_t last = (i + count - 1) % count;
      if (has_upright_edge(last)) loops[i].push_back(lid[last]);
    }
    if (!block_.lid) loops.back().insert(loops.back().end(), lid.begin(), lid.end());
    for (std::size_t i = 0; i < count; ++i)
      out.facets.push_back(
          detail::add_facet(*out.solid, block_.sides[i], loops[i], line_[0].facet));
    if (block_.lid)
      out.facets.push_back(detail::add_facet(*out.solid, *block_.lid, lid, line_[0].facet));
  }

  const Solid& solid_;
  const BlockAcross& block_;
  const Clearance& clearance_;
  std::vector<FootPoint> line_;
  std::set<FacetId> under_;
  std::set<std::pair<int, int>> crossed_;  ///< either way
  std::vector<Vec3> tops_;                 ///< by side: of the edge to the next one
  int first_of_line_ = 0, first_top_ = 0;
};

}  // namespace

Attached raise_across(const Solid& solid, const BlockAcross& block, const Clearance& clearance) {
  return AcrossRaiser(solid, block, clearance).run();
}

}  // namespace oriel
