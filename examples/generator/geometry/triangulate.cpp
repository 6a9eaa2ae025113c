#include "examples/generator/geometry/triangulate.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace oriel::generator {
namespace {

/// One polygon, seen in two coordinates against its normal.
class EarClipper {
 public:
  EarClipper(const Body& body, const Polygon& polygon)
      : body_(body), polygon_(polygon), normal_(doubled_area(body, polygon)) {}

  std::vector<std::vector<int>> run(Random& random) {
    std::vector<int> loop = without_holes();
    std::vector<std::vector<int>> triangles;
    while (loop.size() > 3) {
      const std::size_t ear = find_ear(loop, random);
      if (ear == loop.size()) return {};
      triangles.push_back(corners(loop, ear));
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back(loop);
    return triangles;
  }

 private:
  /// Coordinates in the plane; counter-clockwise stays counter-clockwise.
  [[nodiscard]] Uv flat(int vertex) const {
    const Point p = body_.vertices[at(vertex)];
    const double x = std::abs(normal_.x), y = std::abs(normal_.y), z = std::abs(normal_.z);
    Uv q;
    bool is_mirrored = false;
    if (x >= y && x >= z) {
      q = {p.y, p.z};
      is_mirrored = normal_.x < 0;
    } else if (y >= z) {
      q = {p.z, p.x};
      is_mirrored = normal_.y < 0;
    } else {
      q = {p.x, p.y};
      is_mirrored = normal_.z < 0;
    }
    return is_mirrored ? Uv{q.v, q.u} : q;
  }
  /// > 0 if the corners turn left.
  [[nodiscard]] Um turn(int a, int b, int c) const {
    const Uv p = flat(a), q = flat(b), r = flat(c);
    return (q.u - p.u) * (r.v - p.v) - (r.u - p.u) * (q.v - p.v);
  }
  [[nodiscard]] static std::vector<int> corners(const std::vector<int>& loop, std::size_t i) {
    return {loop[(i + loop.size() - 1) % loop.size()], loop[i], loop[(i + 1) % loop.size()]};
  }

  [[nodiscard]] std::size_t find_ear(const std::vector<int>& loop, Random& random) const;
  [[nodiscard]] bool is_ear(const std::vector<int>& loop, std::size_t i) const;
  [[nodiscard]] std::vector<int> without_holes() const;
  void splice(std::vector<int>& loop, std::vector<int> hole,
              const std::vector<std::vector<int>>& other_holes) const;
  [[nodiscard]] bool is_crossed(int a, int b, const std::vector<int>& loop) const;
  [[nodiscard]] bool opens_towards(const std::vector<int>& loop, std::size_t i, int target) const;

  const Body& body_;
  const Polygon& polygon_;
  Vec3 normal_;
};

std::size_t EarClipper::find_ear(const std::vector<int>& loop, Random& random) const {
  const auto start = at(random.below(static_cast<int>(loop.size())));
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t candidate = (start + i) % loop.size();
    if (is_ear(loop, candidate)) return candidate;
  }
  return loop.size();
}

bool EarClipper::is_ear(const std::vector<int>& loop, std::size_t i) const {
  const std::vector<int> t = corners(loop, i);
  if (turn(t[0], t[1], t[2]) <= 0) return false;
  return std::none_of(loop.begin(), loop.end(), [&](int p) {
    if (p == t[0] || p == t[1] || p == t[2]) return false;
    return turn(t[0], t[1], p) >= 0 && turn(t[1], t[2], p) >= 0 && turn(t[2], t[0], p) >= 0;
  });
}

/// The outer ring with every hole spliced in along a bridge to a corner it sees, the hole that
/// reaches farthest right first (Eberly, Triangulation by Ear Clipping).
std::vector<int> EarClipper::without_holes() const {
  std::vector<std::vector<int>> holes(polygon_.rings.begin() + 1, polygon_.rings.end());
  const auto right = [&](int a, int b) {
    const Uv p = flat(a), q = flat(b);
    return p.u != q.u ? p.u < q.u : p.v < q.v;
  };
  for (std::vector<int>& hole : holes)
    std::rotate(hole.begin(), std::max_element(hole.begin(), hole.end(), right), hole.end());
  std::sort(holes.begin(), holes.end(),
            [&](const auto& a, const auto& b) { return right(a[0], b[0]); });
  std::vector<int> loop = polygon_.rings[0];
  while (!holes.empty()) {
    std::vector<int> hole = std::move(holes.back());
    holes.pop_back();
    splice(loop, std::move(hole), holes);
  }
  return loop;
}

void EarClipper::splice(std::vector<int>& loop, std::vector<int> hole,
                        const std::vector<std::vector<int>>& other_holes) const {
  const int from = hole[0];
  std::vector<std::size_t> order(loop.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto distance = [&](std::size_t i) {
    const Uv p = flat(loop[i]), q = flat(from);
    return (p.u - q.u) * (p.u - q.u) + (p.v - q.v) * (p.v - q.v);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair{distance(a), a} < std::pair{distance(b), b};
  });
  for (const std::size_t i : order) {
    if (!opens_towards(loop, i, from) || is_crossed(from, loop[i], loop) ||
        is_crossed(from, loop[i], hole))
      continue;
    if (std::any_of(other_holes.begin(), other_holes.end(),
                    [&](const auto& other) { return is_crossed(from, loop[i], other); }))
      continue;
    hole.push_back(from);
    hole.push_back(loop[i]);
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, hole.begin(), hole.end());
    return;
  }
}

/// True if the loop crosses or touches the segment between its ends.
bool EarClipper::is_crossed(int a, int b, const std::vector<int>& loop) const {
  const Uv p = flat(a), q = flat(b);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const int c = loop[i], d = loop[(i + 1) % loop.size()];
    const Um side_c = turn(a, b, c), side_d = turn(a, b, d);
    if (c != a && c != b && side_c == 0) {
      const Uv r = flat(c);
      const Um along = (q.u - p.u) * (r.u - p.u) + (q.v - p.v) * (r.v - p.v);
      const Um whole = (q.u - p.u) * (q.u - p.u) + (q.v - p.v) * (q.v - p.v);
      if (along > 0 && along < whole) return true;
    }
    if ((side_c > 0 && side_d < 0) || (side_c < 0 && side_d > 0)) {
      const Um side_a = turn(c, d, a), side_b = turn(c, d, b);
      if ((side_a > 0 && side_b < 0) || (side_a < 0 && side_b > 0)) return true;
    }
  }
  return false;
}

/// True if the segment from corner i to the target starts into the loop's inside.
bool EarClipper::opens_towards(const std::vector<int>& loop, std::size_t i, int target) const {
  const std::vector<int> t = corners(loop, i);
  const bool is_left_of_in = turn(t[0], t[1], target) > 0;
  const bool is_left_of_out = turn(t[1], t[2], target) > 0;
  return turn(t[0], t[1], t[2]) > 0 ? is_left_of_in && is_left_of_out
                                    : is_left_of_in || is_left_of_out;
}

}  // namespace
Body triangulated(const Body& body, Random& random) {
  Body result = body;
  result.polygons.clear();
  for (const Polygon& polygon : body.polygons)
    for (std::vector<int>& triangle : EarClipper(body, polygon).run(random))
      result.polygons.push_back({polygon.owner, {std::move(triangle)}});
  return result;
}

}  // namespace oriel::generator
