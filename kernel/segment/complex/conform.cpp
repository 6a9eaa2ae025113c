#include "kernel/segment/complex/conform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace oriel::detail {

namespace {

/// The vertices in use, along a direction that no wall or roof is perpendicular to: few are within
/// the reach of an edge.
class Vertices {
 public:
  Vertices(const std::vector<Face>& faces, const std::vector<Vertex>& vertices)
      : vertices_(vertices) {
    for (const Face& face : faces)
      for (const Loop& loop : face.loops)
        for (const int v : loop) order_.emplace_back(place_of(at(v)), v);
    std::ranges::sort(order_);
    order_.erase(std::unique(order_.begin(), order_.end()), order_.end());
  }

  /// The vertices on an edge, from a to b.
  [[nodiscard]] std::vector<int> on(int a, int b, double near_m) const {
    const Vec3 from = at(a), along = at(b) - from;
    const double size = length(along);
    const double p = place_of(from), q = place_of(at(b));
    const double low = std::min(p, q) - near_m, high = std::max(p, q) + near_m;
    std::vector<std::pair<double, int>> found;
    for (auto i = std::ranges::lower_bound(order_, std::pair{low, -1});
         i != order_.end() && i->first <= high; ++i) {
      const int v = i->second;
      const Vec3 to = at(v) - from;
      const double position = dot(to, along) / size;
      if (v == a || v == b || position <= 0 || position >= size) continue;
      if (length(to - (position / size) * along) <= near_m) found.emplace_back(position, v);
    }
    std::ranges::sort(found);
    std::vector<int> on;
    on.reserve(found.size());
    for (const auto& [position, v] : found) on.push_back(v);
    return on;
  }

 private:
  [[nodiscard]] Vec3 at(int v) const { return vertices_[static_cast<std::size_t>(v)].point; }
  static double place_of(Vec3 p) { return dot(p, normalised({0.5436, 0.3121, 0.7790})); }

  const std::vector<Vertex>& vertices_;
  std::vector<std::pair<double, int>> order_;
};

}  // namespace

void conform(std::vector<Face>& faces, const std::vector<Vertex>& vertices, double near_m) {
  const Vertices in_use(faces, vertices);
  std::map<std::pair<int, int>, std::vector<int>> on_edge;
  for (Face& face : faces)
    for (Loop& loop : face.loops) {
      Loop whole;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int from = loop[i], to = loop[(i + 1) % loop.size()];
        const auto [entry, is_new] = on_edge.try_emplace(std::minmax(from, to));
        if (is_new) entry->second = in_use.on(entry->first.first, entry->first.second, near_m);
        const std::vector<int>& on = entry->second;
        whole.push_back(from);
        if (from < to)
          whole.insert(whole.end(), on.begin(), on.end());
        else
          whole.insert(whole.end(), on.rbegin(), on.rend());
      }
      loop = std::move(whole);
    }
}

}  // namespace oriel::detail
