#include "examples/generator/geometry/rings.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>

namespace oriel::generator {
namespace {

/// Two coordinates in which the plane with this normal is seen undistorted enough to ask for sides.
Uv flat(Vec3 normal, Point p) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  if (x >= y && x >= z) return {p.y, p.z};
  return y >= z ? Uv{p.z, p.x} : Uv{p.x, p.y};
}

/// True if the loop winds around the point (even-odd).
bool surrounds(const std::vector<Point>& points, Vec3 normal, const Loop& loop, Point point) {
  const Uv p = flat(normal, point);
  bool is_inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Uv a = flat(normal, points[at(loop[i])]);
    const Uv b = flat(normal, points[at(loop[(i + 1) % loop.size()])]);
    if ((a.v > p.v) == (b.v > p.v)) continue;
    const Um side = (b.u - a.u) * (p.v - a.v) - (p.u - a.u) * (b.v - a.v);
    if ((side > 0) == (b.v > a.v)) is_inside = !is_inside;
  }
  return is_inside;
}

/// The edges of one facet while loops are taken from them.
class Tracer {
 public:
  Tracer(const std::vector<Point>& points, Vec3 normal, const std::vector<Edge>& edges)
      : points_(points), normal_(normal), edges_(edges), is_used_(edges.size(), false) {}

  /// The loop that starts with the edge, or an empty one if it does not close.
  Loop loop_from(std::size_t edge) {
    const int start = edges_[edge].first;
    Loop loop;
    while (true) {
      is_used_[edge] = true;
      loop.push_back(edges_[edge].first);
      if (edges_[edge].second == start) return loop;
      const std::size_t next = after(edge);
      if (next == edges_.size()) return {};
      edge = next;
    }
  }
  [[nodiscard]] bool is_used(std::size_t edge) const { return is_used_[edge]; }

 private:
  /// The unused edge that continues `edge` with the leftmost turn, or edges_.size().
  [[nodiscard]] std::size_t after(std::size_t edge) const {
    const int corner = edges_[edge].second;
    const auto first = std::lower_bound(edges_.begin(), edges_.end(), Edge{corner, -1});
    std::size_t best = edges_.size();
    double best_turn = 0;
    for (auto i = at(static_cast<int>(first - edges_.begin()));
         i < edges_.size() && edges_[i].first == corner; ++i) {
      if (is_used_[i]) continue;
      const double t = turn(edges_[edge], edges_[i]);
      if (best != edges_.size() && t <= best_turn) continue;
      best = i;
      best_turn = t;
    }
    return best;
  }
  [[nodiscard]] double turn(Edge from, Edge to) const {
    const Vec3 d = direction(from), e = direction(to);
    return std::atan2(dot(normal_, cross(d, e)), length(normal_) * dot(d, e));
  }
  [[nodiscard]] Vec3 direction(Edge edge) const {
    return metres(points_[at(edge.second)] - points_[at(edge.first)]);
  }

  const std::vector<Point>& points_;
  Vec3 normal_;
  const std::vector<Edge>& edges_;
  std::vector<bool> is_used_;
};

}  // namespace

Loop split(const Loop& loop, const PointsOnEdges& points) {
  Loop result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    result.push_back(loop[i]);
    points.append(loop[i], loop[(i + 1) % loop.size()], result);
  }
  return result;
}

std::vector<Edge> boundary(const std::vector<Loop>& loops) {
  std::vector<Edge> edges;
  for (const Loop& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i)
      edges.emplace_back(loop[i], loop[(i + 1) % loop.size()]);
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> left;
  for (auto run = edges.begin(); run != edges.end();) {
    const auto end = std::upper_bound(run, edges.end(), *run);
    const auto [low, high] =
        std::equal_range(edges.begin(), edges.end(), Edge{run->second, run->first});
    for (auto n = (end - run) - (high - low); n > 0; --n) left.push_back(*run);
    run = end;
  }
  return left;
}

std::vector<Loop> trace(const std::vector<Point>& points, Vec3 normal,
                        const std::vector<Edge>& edges) {
  Tracer tracer(points, normal, edges);
  std::vector<Loop> loops;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (tracer.is_used(i)) continue;
    Loop loop = tracer.loop_from(i);
    if (!loop.empty()) loops.push_back(std::move(loop));
  }
  return loops;
}

Vec3 doubled_area(const std::vector<Point>& points, const Loop& loop) {
  Vec3 sum;
  const Point origin = points[at(loop[0])];
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum =
        sum + cross(metres(points[at(loop[i])] - origin), metres(points[at(loop[i + 1])] - origin));
  return sum;
}

std::vector<std::vector<Loop>> nest(const std::vector<Point>& points, Vec3 normal,
                                    std::vector<Loop> loops) {
  std::vector<std::vector<Loop>> polygons;
  std::vector<Loop> holes;
  for (Loop& loop : loops) {
    const bool is_outer = dot(doubled_area(points, loop), normal) > 0;
    if (is_outer)
      polygons.push_back({std::move(loop)});
    else
      holes.push_back(std::move(loop));
  }
  for (Loop& hole : holes)
    for (std::vector<Loop>& polygon : polygons) {
      const bool is_home =
          polygons.size() == 1 || surrounds(points, normal, polygon[0], points[at(hole[0])]);
      if (!is_home) continue;
      polygon.push_back(std::move(hole));
      break;
    }
  return polygons;
}

}  // namespace oriel::generator
