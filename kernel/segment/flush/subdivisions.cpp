#include "kernel/segment/flush/subdivisions.h"

#include "kernel/base/index.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "kernel/solidify/soup/soup.h"
#include "model/vec3.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

/// Points of a plane, found where they lie on edges: the T-vertices between polygons that were
/// drawn one by one.
class PointsOnEdges {
 public:
  /// A point is on an edge if it is no further from it than `slack_m`.
  PointsOnEdges(const std::vector<Vec3>& points, ReachAxes axes, double slack_m, Work& work);

  /// Indices of the points on the edge between two points, without these, in the order from `from`
  /// to `to`. Looks at the points in the edge's strip along u or v, whichever has fewer.
  [[nodiscard]] std::vector<int> between(int from, int to) const;

 private:
  /// Indices of the points, and their coordinate along one axis, ascending.
  struct Strip {
    std::vector<double> coordinates;
    std::vector<int> points;
    [[nodiscard]] std::pair<std::size_t, std::size_t> range(double low, double high) const;
  };
  [[nodiscard]] Strip strip_along(Vec3 axis) const;

  const std::vector<Vec3>& points_;
  ReachAxes axes_;
  double slack_m_;
  Work& work_;
  Strip by_u_, by_v_;
};

PointsOnEdges::PointsOnEdges(const std::vector<Vec3>& points, ReachAxes axes, double slack_m,
                             Work& work)
    : points_(points),
      axes_(axes),
      slack_m_(slack_m),
      work_(work),
      by_u_(strip_along(axes.u)),
      by_v_(strip_along(axes.v)) {}

PointsOnEdges::Strip PointsOnEdges::strip_along(Vec3 axis) const {
  Strip strip;
  strip.points.resize(points_.size());
  std::iota(strip.points.begin(), strip.points.end(), 0);
  const auto coordinate = [&](int p) { return dot(points_[at(p)], axis); };
  std::ranges::stable_sort(strip.points, {}, coordinate);
  for (const int p : strip.points) strip.coordinates.push_back(coordinate(p));
  return strip;
}

std::pair<std::size_t, std::size_t> PointsOnEdges::Strip::range(double low, double high) const {
  const auto first = std::ranges::lower_bound(coordinates, low);
  const auto past = std::ranges::upper_bound(coordinates, high);
  return {static_cast<std::size_t>(first - coordinates.begin()),
          static_cast<std::size_t>(past - coordinates.begin())};
}

std::vector<int> PointsOnEdges::between(int from, int to) const {
  const Vec3 start = points_[at(from)], along = points_[at(to)] - start;
  const auto range_along = [&](const Strip& strip, Vec3 axis) {
    const double p = dot(start, axis), q = p + dot(along, axis);
    return strip.range(std::min(p, q) - slack_m_, std::max(p, q) + slack_m_);
  };
  const auto u = range_along(by_u_, axes_.u), v = range_along(by_v_, axes_.v);
  const bool is_u_shorter = u.second - u.first < v.second - v.first;
  const Strip& strip = is_u_shorter ? by_u_ : by_v_;
  const auto [first, past] = is_u_shorter ? u : v;
  work_.add(1 + static_cast<std::int64_t>(past - first));
  if (work_.is_used_up()) return {};
  std::vector<std::pair<double, int>> found;
  const double square = dot(along, along);
  for (std::size_t i = first; i < past; ++i) {
    const int p = strip.points[i];
    if (p == from || p == to) continue;
    const Vec3 offset = points_[at(p)] - start;
    const double t = dot(offset, along) / square;
    if (t > 0 && t < 1 && length(offset - t * along) <= slack_m_) found.emplace_back(t, p);
  }
  std::ranges::sort(found);
  std::vector<int> between;
  for (const auto& [t, p] : found) between.push_back(p);
  return between;
}

/// By Polygon::source.
using BySource = std::vector<const Polygon*>;

BySource polygons_by_source(const Building& building) {
  BySource by_source;
  for (const Polygon& polygon : building.polygons) {
    if (polygon.source < 0) continue;
    if (std::ssize(by_source) <= polygon.source) by_source.resize(at(polygon.source) + 1);
    by_source[at(polygon.source)] = &polygon;
  }
  return by_source;
}

/// Another polygon can only lie inset in one with an inner ring, with an outer ring that turns
/// inward twice, or with one that meets itself (a bridge to a hole).
bool may_host(const Building& building, const Polygon& polygon, Vec3 normal, double grid_m) {
  if (polygon.rings.size() > 1) return true;
  if (polygon.rings[0].size() < 6) return false;
  const Outline ring = outlines_of(building, polygon, grid_m)[0];
  const auto point = [&](std::size_t i) { return ring[i % ring.size()]; };
  int left = 0, right = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double turn = dot(cross(point(i + 1) - point(i), point(i + 2) - point(i + 1)), normal);
    left += turn > 0 ? 1 : 0;
    right += turn < 0 ? 1 : 0;
  }
  // Whichever way round the input has it.
  return std::min(left, right) >= 2;
}

/// A wall around a door on its lower edge has eight corners, so six triangles; the door has two.
constexpr std::size_t kFewestAroundRectangle = 8;

class SubdivisionMaker {
 public:
  SubdivisionMaker(const Building& building, const Solid& solid, const Tolerances& tolerances,
                   Work& work)
      : building_(building), solid_(solid), tolerances_(tolerances), work_(work) {}

  Subdivisions run() {
    const BySource by_source = polygons_by_source(building_);
    choose_facets(by_source);
    if (out_.subdivisions.empty()) return std::move(out_);
    const Building part = chosen_part(by_source);
    std::vector<Issue> of_solidify;  // it has told them
    const Soup soup = weld(part, tolerances_, of_solidify);
    sort_into_subdivisions(soup);
    pair_edges();
    return std::move(out_);
  }

 private:
  void choose_facets(const BySource& by_source) {
    subdivision_of_source_.resize(by_source.size());
    for (int f = 0; f < std::ssize(solid_.facets); ++f) {
      const Facet& facet = solid_.facets[at(f)];
      if (facet.polygons.size() < 2) continue;
      const Vec3 normal = solid_.planes[facet.plane.index()].normal;
      bool has_host = false, has_hints = false;
      const std::string& hint = by_source[at(facet.polygons[0])]->hint;
      for (const int source : facet.polygons) {
        has_hints |= by_source[at(source)]->hint != hint;
        has_host = has_host || may_host(building_, *by_source[at(source)], normal, solid_.grid_m);
      }
      if (!has_host && !has_hints && facet.polygons.size() < kFewestAroundRectangle) continue;
      for (const int source : facet.polygons)
        subdivision_of_source_[at(source)] = out_.subdivisions.next_id();
      out_.subdivisions.push_back({FacetId{f}, {}, {}, has_hints, has_host});
    }
  }

  /// The building with the polygons of the subdivisions only, and the vertices they use.
  [[nodiscard]] Building chosen_part(const BySource& by_source) {
    Building part;
    std::vector<int> place(building_.vertices.size(), -1);
    for (const Polygon* polygon : by_source) {
      if (polygon == nullptr || !subdivision_of_source_[at(polygon->source)].is_valid()) continue;
      Polygon copy = *polygon;
      for (auto& ring : copy.rings)
        for (int& v : ring) {
          if (place[at(v)] < 0) {
            place[at(v)] = static_cast<int>(part.vertices.size());
            part.vertices.push_back(building_.vertices[at(v)]);
          }
          v = place[at(v)];
        }
      hints_.emplace(polygon->hint, 0);
      hint_of_source_.emplace(polygon->source, &hints_.find(polygon->hint)->second);
      part.polygons.push_back(std::move(copy));
    }
    int number = 0;
    for (auto& [hint, its_number] : hints_) its_number = number++;
    return part;
  }

  void sort_into_subdivisions(const Soup& soup) {
    IndexedVector<SubdivisionId, std::vector<int>> members(out_.subdivisions.size());
    for (int p = 0; p < soup.polygon_count(); ++p)
      members[subdivision_of_source_[at(soup.polygons[at(p)].source)]].push_back(p);
    std::vector<int> place(soup.points.size());
    for (const SubdivisionId s : members.ids()) {
      Subdivision& subdivision = out_.subdivisions[s];
      const Plane& plane = solid_.planes[solid_.facets[subdivision.facet.index()].plane.index()];
      const int first_point = static_cast<int>(out_.points.size());
      const auto point_of = [&](int v) {
        if (place[at(v)] < first_point || place[at(v)] >= std::ssize(out_.points) ||
            origin_[at(place[at(v)])] != v) {
          place[at(v)] = static_cast<int>(out_.points.size());
          const Vec3 p = exact::to_metres(soup.points[at(v)], soup.grid_m);
          out_.points.push_back(p + (plane.offset_m - dot(p, plane.normal)) * plane.normal);
          origin_.push_back(v);
        }
        return place[at(v)];
      };
      subdivision.first_polygon = out_.polygons.next_id();
      for (const int polygon : members[s])
        for (const int v : soup.corners_of(polygon)) point_of(v);
      const std::vector<Vec3> points(out_.points.begin() + first_point, out_.points.end());
      const PointsOnEdges on_edges(points, axes_in(plane.normal), tolerances_.weld_m, work_);
      const std::vector<PointPair> edges = edges_of(soup, members[s]);
      // An edge that two polygons share needs no points, however near some are to it.
      const auto between = [&](int v, int w) {
        if (std::ranges::binary_search(edges, PointPair{w, v})) return std::vector<int>{};
        return on_edges.between(point_of(v) - first_point, point_of(w) - first_point);
      };
      for (const int polygon : members[s])
        add_polygon(soup, polygon, s, plane.normal, [&](std::span<const int> ring) {
          return with_points_between(ring, first_point, point_of, between);
        });
      subdivision.past_polygon = out_.polygons.next_id();
    }
  }

  /// The directed edges of polygons, sorted.
  static std::vector<PointPair> edges_of(const Soup& soup, const std::vector<int>& polygons) {
    std::vector<PointPair> edges;
    for (const int polygon : polygons)
      for (const int r : soup.rings_of(polygon)) {
        const std::span<const int> ring = soup.ring(r);
        for (std::size_t i = 0; i < ring.size(); ++i)
          edges.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
      }
    std::ranges::sort(edges);
    return edges;
  }

  /// The points of a ring, also those of other polygons that lie on its edges.
  template <class PointOf, class Between>
  static std::vector<int> with_points_between(std::span<const int> ring, int first_point,
                                              PointOf point_of, Between points_between) {
    std::vector<int> corners, points;
    for (const int v : ring) corners.push_back(point_of(v));
    const std::set<int> own(corners.begin(), corners.end());
    std::set<int> taken;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      points.push_back(corners[i]);
      for (const int between : points_between(ring[i], ring[(i + 1) % ring.size()]))
        if (const int p = between + first_point; !own.contains(p) && taken.insert(p).second)
          points.push_back(p);
    }
    return points;
  }

  template <class PointsOf>
  void add_polygon(const Soup& soup, int polygon, SubdivisionId subdivision, Vec3 normal,
                   PointsOf points_of) {
    const int source = soup.polygons[at(polygon)].source;
    SubdivisionPolygon record{
        source, *hint_of_source_.at(source), subdivision, out_.edges.next_id(), {}, 0};
    for (const int r : soup.rings_of(polygon)) {
      const std::vector<int> ring = points_of(soup.ring(r));
      const int first = out_.edges.next_id().value;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const int next = i + 1 < ring.size() ? first + static_cast<int>(i) + 1 : first;
        out_.edges.push_back({ring[i], out_.polygons.next_id(), InputEdgeId{next}, {}});
      }
    }
    record.past_edge = out_.edges.next_id();
    const Vec3 base = out_.start(record.first_edge);
    for (const InputEdgeId e : record.edges())
      record.area_m2 += dot(cross(out_.start(e) - base, out_.vector(e)), normal) / 2;
    if (record.area_m2 < 0) turn_round(record);
    out_.polygons.push_back(record);
  }

  /// The input had the polygon the wrong way round.
  void turn_round(SubdivisionPolygon& record) {
    std::vector<SubdivisionEdge> turned;
    for (const InputEdgeId e : record.edges())
      turned.push_back({out_.to(e), out_.edges[e].polygon, {}, {}});
    for (const InputEdgeId e : record.edges())
      turned[at(out_.edges[e].next.value - record.first_edge.value)].next = e;
    std::ranges::copy(turned, out_.edges.begin() + record.first_edge.value);
    record.area_m2 = -record.area_m2;
  }

  void pair_edges() {
    const auto key = [](int from, int to) {
      return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
    };
    std::unordered_map<std::uint64_t, InputEdgeId> edges;
    edges.reserve(out_.edges.size());
    for (const InputEdgeId e : out_.edges.ids())
      edges.emplace(key(out_.edges[e].from, out_.to(e)), e);
    // Polygons that lie upon each other have the same edges: the first of them has the twin, so
    // that an edge is its twin's twin.
    const auto is_first = [&](InputEdgeId e) {
      return edges.find(key(out_.edges[e].from, out_.to(e)))->second == e;
    };
    for (const InputEdgeId e : out_.edges.ids()) {
      const auto twin = edges.find(key(out_.to(e), out_.edges[e].from));
      if (twin != edges.end() && is_first(e)) out_.edges[e].twin = twin->second;
    }
  }

  const Building& building_;
  const Solid& solid_;
  const Tolerances& tolerances_;
  Work& work_;
  std::vector<SubdivisionId> subdivision_of_source_;
  std::map<std::string, int> hints_;
  std::unordered_map<int, const int*> hint_of_source_;
  std::vector<int> origin_;  ///< of each point, the soup's
  Subdivisions out_;
};

}  // namespace

Subdivisions subdivisions_of(const Building& building, const Solid& solid,
                             const Tolerances& tolerances, Work& work) {
  return SubdivisionMaker(building, solid, tolerances, work).run();
}

}  // namespace oriel::detail
