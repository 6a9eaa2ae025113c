#include "kernel/solidify/missing/rims.h"

#include "kernel/base/index.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

class RimTracer {
 public:
  RimTracer(const Soup& soup, const ShellMesh& mesh, std::span<const PolygonShape> shapes)
      : soup_(soup), mesh_(mesh), shapes_(shapes) {}

  std::optional<std::vector<HoleRim>> run() {
    collect();
    if (!link()) return std::nullopt;
    std::vector<HoleRim> rims;
    std::vector<char> is_seen(edges_.size(), 0);
    for (std::size_t start = 0; start < edges_.size(); ++start) {
      if (is_seen[start]) continue;
      HoleRim rim;
      for (std::size_t e = start; !std::exchange(is_seen[e], 1); e = at(next_[e]))
        rim.push_back(edges_[e]);
      rims.push_back(std::move(rim));
    }
    return rims;
  }

 private:
  void collect() {
    for (int h = 0; h < soup_.corner_count(); ++h) {
      if (mesh_.twin[at(h)] >= 0) continue;
      const int end = mesh_.next[at(h)];
      const int polygon = mesh_.polygon_of[at(h)];
      edges_.push_back({soup_.corners[at(end)], soup_.corners[at(h)], polygon, polygon});
      sheets_.push_back({mesh_.vertex_of[at(end)], mesh_.vertex_of[at(h)]});
    }
  }

  /// Which edge follows each.
  bool link() {
    std::map<int, std::pair<std::vector<int>, std::vector<int>>> at_point;  // that end, that begin
    for (int e = 0; e < std::ssize(edges_); ++e) {
      at_point[edges_[at(e)].to].first.push_back(e);
      at_point[edges_[at(e)].from].second.push_back(e);
    }
    next_ = std::vector<int>(edges_.size(), -1);
    for (const auto& [point, edges] : at_point) {
      if (edges.first.size() != edges.second.size()) return false;
      link_at_point(edges.first, edges.second);
    }
    return true;
  }

  /// The narrowest gaps between sheets first; a sheet alone goes round the hole.
  void link_at_point(std::span<const int> ending, std::span<const int> beginning) {
    Vec3 outward;
    for (const int e : beginning) outward = outward + shapes_[at(edges_[at(e)].polygon)].unit;
    std::vector<std::tuple<bool, double, int, int>> gaps;
    for (const int e : ending)
      for (const int next : beginning) {
        const Vec3 point = place(edges_[at(e)].to);
        const double angle = clockwise(place(edges_[at(e)].from) - point,
                                       place(edges_[at(next)].to) - point, normalised(outward));
        gaps.emplace_back(sheets_[at(e)].to == sheets_[at(next)].from, angle, e, next);
      }
    std::ranges::sort(gaps);
    std::set<int> followed;
    for (const auto& [is_one_sheet, angle, e, next] : gaps)
      if (next_[at(e)] < 0 && followed.insert(next).second) next_[at(e)] = next;
  }

  /// The angle from one direction to another, 0 … 2π, seen against the axis.
  [[nodiscard]] static double clockwise(Vec3 from, Vec3 to, Vec3 axis) {
    const Vec3 u = normalised(from - dot(from, axis) * axis), v = cross(axis, u);
    const double angle = -std::atan2(dot(to, v), dot(to, u));
    return angle > 0 ? angle : angle + 2 * std::numbers::pi;
  }

  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }

  struct Sheets {
    int from, to;
  };

  const Soup& soup_;
  const ShellMesh& mesh_;
  std::span<const PolygonShape> shapes_;
  std::vector<HoleEdge> edges_;
  std::vector<Sheets> sheets_;  ///< the mesh's vertices at which the edges begin and end
  std::vector<int> next_;
};

}  // namespace

std::optional<std::vector<HoleRim>> find_rims(const Soup& soup, const ShellMesh& mesh,
                                              std::span<const PolygonShape> shapes) {
  return RimTracer(soup, mesh, shapes).run();
}

}  // namespace oriel::detail
