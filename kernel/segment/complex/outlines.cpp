#include "kernel/segment/complex/outlines.h"

#include "kernel/geometry/box_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

/// Two numbers in one, in this order.
std::uint64_t both_of(int first, int second) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(first)) << 32U |
         static_cast<std::uint32_t>(second);
}

/// The line in which two planes meet.
std::uint64_t line_of(PlaneId p, PlaneId q) {
  const auto [low, high] = std::minmax(p, q);
  return both_of(low.value, high.value);
}

class Outlines {
 public:
  Outlines(std::vector<std::vector<Facet>> bodies, std::span<const PlaneId> sheets,
           const VertexPool& pool)
      : sheets_(sheets), pool_(pool), bodies_(std::move(bodies)) {
    for (auto& facets : bodies_)
      for (Facet& facet : facets)
        for (Loop& loop : facet.loops) represent(loop);
    find_incidences();
  }

  std::vector<std::vector<Facet>> whole() {
    std::vector<std::vector<Facet>> whole = bodies_;
    for (std::size_t c = 0; c < bodies_.size(); ++c) {
      const auto across = facets_by_edge(bodies_[c]);
      for (Facet& facet : whole[c])
        for (Loop& loop : facet.loops) loop = whole_loop(loop, sheet_of(facet), across);
    }
    return whole;
  }

 private:
  using SheetByEdge = std::unordered_map<std::uint64_t, PlaneId>;

  [[nodiscard]] PlaneId sheet_of(const Facet& facet) const { return sheets_[facet.plane.index()]; }

  void represent(Loop& loop) const {
    for (int& v : loop) v = pool_.represented_by(v);
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  }

  /// Which vertices lie on which lines.
  void find_incidences() {
    std::vector<std::pair<int, PlaneId>> sheets;  // by vertex
    for (const auto& facets : bodies_)
      for (const Facet& facet : facets)
        for (const Loop& loop : facet.loops)
          for (const int v : loop) sheets.emplace_back(v, sheet_of(facet));
    std::ranges::sort(sheets);
    sheets.erase(std::unique(sheets.begin(), sheets.end()), sheets.end());
    for (auto p = sheets.begin(); p != sheets.end(); ++p)
      for (auto q = std::next(p); q != sheets.end() && q->first == p->first; ++q)
        on_line_[line_of(p->second, q->second)].push_back(p->first);
  }

  [[nodiscard]] SheetByEdge facets_by_edge(const std::vector<Facet>& facets) const {
    SheetByEdge across;
    for (const Facet& facet : facets)
      for (const Loop& loop : facet.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
          across[both_of(loop[i], loop[(i + 1) % loop.size()])] = sheet_of(facet);
    return across;
  }

  [[nodiscard]] Loop whole_loop(const Loop& loop, PlaneId sheet, const SheetByEdge& across) const {
    Loop whole;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int from = loop[i], to = loop[(i + 1) % loop.size()];
      whole.push_back(from);
      const auto other = across.find(both_of(to, from));
      if (other == across.end()) continue;
      const auto on = on_line_.find(line_of(sheet, other->second));
      if (on == on_line_.end()) continue;
      const auto between = vertices_between(from, to, on->second);
      whole.insert(whole.end(), between.begin(), between.end());
    }
    return whole;
  }

  [[nodiscard]] std::vector<int> vertices_between(int a, int b, const std::vector<int>& on) const {
    const Vec3 from = pool_.at(a), to = pool_.at(b);
    const double size = length(to - from);
    std::vector<std::pair<double, int>> between;
    for (const int v : on) {
      const Vec3 at = pool_.at(v);
      if (v == a || v == b || length(at - from) >= size || length(to - at) >= size) continue;
      between.emplace_back(dot(at - from, to - from), v);
    }
    std::ranges::sort(between);
    std::vector<int> vertices;
    vertices.reserve(between.size());
    for (const auto& [position, v] : between) vertices.push_back(v);
    return vertices;
  }

  std::span<const PlaneId> sheets_;
  const VertexPool& pool_;
  std::vector<std::vector<Facet>> bodies_;
  std::unordered_map<std::uint64_t, std::vector<int>> on_line_;
};

}  // namespace

std::vector<PlaneId> sheets_of(std::span<const Plane> planes) {
  std::vector<PlaneId> sheets;
  std::map<std::array<std::int64_t, 4>, PlaneId> first;
  for (int p = 0; p < std::ssize(planes); ++p) {
    const Plane& plane = planes[static_cast<std::size_t>(p)];
    const auto& normal = plane.coefficients;
    const std::array key{normal[0], normal[1], normal[2], plane.offset};
    const std::array opposite{-normal[0], -normal[1], -normal[2], -plane.offset};
    sheets.push_back(first.try_emplace(std::max(key, opposite), PlaneId{p}).first->second);
  }
  return sheets;
}

std::vector<std::vector<Facet>> whole_outlines(std::vector<std::vector<Facet>> bodies,
                                               std::span<const PlaneId> sheets,
                                               const VertexPool& pool) {
  return Outlines(std::move(bodies), sheets, pool).whole();
}

namespace {

/// Up to so many vertices within the reach of an edge are looked at one by one.
constexpr std::ptrdiff_t kFewAlong = 64;

/// The vertices in use, along a direction that no wall or roof is perpendicular to, so that few are
/// within the reach of a short edge; for a long one in a tree.
class Vertices {
 public:
  Vertices(const std::vector<Face>& faces, std::span<const Vertex> vertices) : vertices_(vertices) {
    for (const Face& face : faces)
      for (const Loop& loop : face.loops)
        for (const int v : loop) order_.emplace_back(place_of(at(v)), v);
    std::ranges::sort(order_);
    order_.erase(std::unique(order_.begin(), order_.end()), order_.end());
    if (std::ssize(order_) <= kFewAlong) return;
    std::vector<Box> boxes(order_.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].grow(at(order_[i].second));
    tree_ = BoxTree(std::move(boxes));
  }

  /// The vertices on an edge, from a to b.
  [[nodiscard]] std::vector<int> on(int a, int b, double near_m) const {
    const Vec3 from = at(a), along = at(b) - from;
    const double size = length(along);
    const double p = place_of(from), q = place_of(at(b));
    const double low = std::min(p, q) - near_m, high = std::max(p, q) + near_m;
    std::vector<std::pair<double, int>> found;
    const auto look_at = [&](int v) {
      const Vec3 to = at(v) - from;
      const double position = dot(to, along) / size;
      if (v == a || v == b || position <= 0 || position >= size) return;
      if (length(to - (position / size) * along) <= near_m) found.emplace_back(position, v);
    };
    const auto first = std::ranges::lower_bound(order_, std::pair{low, -1});
    if (order_.end() - first <= kFewAlong || first[kFewAlong].first > high)
      for (auto i = first; i != order_.end() && i->first <= high; ++i) look_at(i->second);
    else
      tree_.search([&](const Box& box) { return comes_near(box, from, at(b), 2 * near_m); },
                   [&](int i) { look_at(order_[static_cast<std::size_t>(i)].second); });
    std::ranges::sort(found);
    std::vector<int> on;
    on.reserve(found.size());
    for (const auto& [position, v] : found) on.push_back(v);
    return on;
  }

 private:
  [[nodiscard]] Vec3 at(int v) const { return vertices_[static_cast<std::size_t>(v)].point; }
  static double place_of(Vec3 p) { return dot(p, normalised({0.5436, 0.3121, 0.7790})); }

  std::span<const Vertex> vertices_;
  std::vector<std::pair<double, int>> order_;
  BoxTree tree_{std::vector<Box>{}};  ///< by place in order_
};

}  // namespace

void conform(std::vector<Face>& faces, std::span<const Vertex> vertices, double near_m) {
  const Vertices in_use(faces, vertices);
  std::unordered_map<std::uint64_t, std::vector<int>> on_edge;
  for (Face& face : faces)
    for (Loop& loop : face.loops) {
      Loop whole;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int from = loop[i], to = loop[(i + 1) % loop.size()];
        const auto [low, high] = std::minmax(from, to);
        const auto [entry, is_new] = on_edge.try_emplace(both_of(low, high));
        if (is_new) entry->second = in_use.on(low, high, near_m);
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
