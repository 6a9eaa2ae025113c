#include "kernel/perturb/ear_clipping.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <utility>

namespace oriel::detail {

namespace {

__extension__ using Wide = __int128;

Wide turn_of(const std::vector<FlatCorner>& corners, int a, int b, int c) {
  const FlatCorner p = corners[at(a)], q = corners[at(b)], r = corners[at(c)];
  return Wide{q.u - p.u} * (r.v - p.v) - Wide{r.u - p.u} * (q.v - p.v);
}

class EarClipper {
 public:
  EarClipper(const std::vector<FlatCorner>& corners, const std::vector<std::vector<int>>& rings)
      : corners_(corners), rings_(rings) {}

  std::vector<std::array<int, 3>> run(Random& random) {
    std::vector<int> loop = without_holes();
    std::vector<std::array<int, 3>> triangles;
    while (loop.size() > 3) {
      const std::size_t ear = find_ear(loop, random);
      if (ear == loop.size()) return {};
      triangles.push_back(corners_at(loop, ear));
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({loop[0], loop[1], loop[2]});
    return triangles;
  }

 private:
  /// > 0 if the corners turn left.
  [[nodiscard]] Wide turn(int a, int b, int c) const { return turn_of(corners_, a, b, c); }
  /// (q − p) · (r − p).
  [[nodiscard]] Wide along(int p, int q, int r) const {
    const FlatCorner from = corners_[at(p)], to = corners_[at(q)], point = corners_[at(r)];
    return Wide{to.u - from.u} * (point.u - from.u) + Wide{to.v - from.v} * (point.v - from.v);
  }
  [[nodiscard]] static std::array<int, 3> corners_at(const std::vector<int>& loop, std::size_t i) {
    return {loop[(i + loop.size() - 1) % loop.size()], loop[i], loop[(i + 1) % loop.size()]};
  }

  [[nodiscard]] std::size_t find_ear(const std::vector<int>& loop, Random& random) const;
  [[nodiscard]] bool is_ear(const std::vector<int>& loop, std::size_t i) const;
  [[nodiscard]] std::vector<int> without_holes() const;
  void splice(std::vector<int>& loop, std::vector<int> hole,
              const std::vector<std::vector<int>>& other_holes) const;
  [[nodiscard]] bool is_crossed(int a, int b, const std::vector<int>& loop) const;
  [[nodiscard]] bool opens_towards(const std::vector<int>& loop, std::size_t i, int target) const;

  const std::vector<FlatCorner>& corners_;
  const std::vector<std::vector<int>>& rings_;
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
  const std::array<int, 3> t = corners_at(loop, i);
  if (turn(t[0], t[1], t[2]) <= 0) return false;
  return std::none_of(loop.begin(), loop.end(), [&](int p) {
    if (p == t[0] || p == t[1] || p == t[2]) return false;
    return turn(t[0], t[1], p) >= 0 && turn(t[1], t[2], p) >= 0 && turn(t[2], t[0], p) >= 0;
  });
}

/// The outer ring with every hole spliced in along a bridge to a corner it sees, the hole that
/// reaches farthest right first.
std::vector<int> EarClipper::without_holes() const {
  std::vector<std::vector<int>> holes(rings_.begin() + 1, rings_.end());
  const auto right = [&](int a, int b) {
    const FlatCorner p = corners_[at(a)], q = corners_[at(b)];
    return p.u != q.u ? p.u < q.u : p.v < q.v;
  };
  for (std::vector<int>& hole : holes)
    std::rotate(hole.begin(), std::max_element(hole.begin(), hole.end(), right), hole.end());
  std::sort(holes.begin(), holes.end(),
            [&](const auto& a, const auto& b) { return right(a[0], b[0]); });
  std::vector<int> loop = rings_[0];
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
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair{along(from, loop[a], loop[a]), a} <
           std::pair{along(from, loop[b], loop[b]), b};
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
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const int c = loop[i], d = loop[(i + 1) % loop.size()];
    const Wide side_c = turn(a, b, c), side_d = turn(a, b, d);
    if (c != a && c != b && side_c == 0 && along(a, b, c) > 0 && along(a, b, c) < along(a, b, b))
      return true;
    if ((side_c > 0 && side_d < 0) || (side_c < 0 && side_d > 0)) {
      const Wide side_a = turn(c, d, a), side_b = turn(c, d, b);
      if ((side_a > 0 && side_b < 0) || (side_a < 0 && side_b > 0)) return true;
    }
  }
  return false;
}

/// True if the segment from corner i to the target starts into the loop's inside.
bool EarClipper::opens_towards(const std::vector<int>& loop, std::size_t i, int target) const {
  const std::array<int, 3> t = corners_at(loop, i);
  const bool is_left_of_in = turn(t[0], t[1], target) > 0;
  const bool is_left_of_out = turn(t[1], t[2], target) > 0;
  return turn(t[0], t[1], t[2]) > 0 ? is_left_of_in && is_left_of_out
                                    : is_left_of_in || is_left_of_out;
}

}  // namespace

std::vector<std::array<int, 3>> clip_ears(const std::vector<FlatCorner>& corners,
                                          const std::vector<std::vector<int>>& rings,
                                          Random& random) {
  if (rings.empty() || rings[0].size() < 3) return {};
  return EarClipper(corners, rings).run(random);
}

bool is_counter_clockwise(const std::vector<FlatCorner>& corners,
                          const std::array<int, 3>& triangle) {
  return turn_of(corners, triangle[0], triangle[1], triangle[2]) > 0;
}

}  // namespace oriel::detail
