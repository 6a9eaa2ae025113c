#include "kernel/geometry/near_points.h"

#include "kernel/base/index.h"
#include "kernel/geometry/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace oriel {

namespace {

/// Finds the points that may have another one within reach. Cut wherever the next point along an
/// axis is out of reach, a list falls into pieces that cannot reach each other; cut along all three
/// axes, in most buildings into single points.
template <class Point>
class Candidates {
 public:
  Candidates(std::span<const Point> points, double reach)
      : points_(points), reach_(static_cast<std::int64_t>(std::ceil(reach))) {}

  /// Of sorted points.
  Numbers find() {
    if (points_.empty()) return {};
    Numbers all(points_.size());
    std::iota(all.begin(), all.end(), 0);
    cut(all, 0);
    return std::move(found_);
  }

 private:
  /// `piece` is sorted by the axis and not empty.
  void cut(std::span<int> piece, std::size_t axis) {
    const Point* const points = points_.data();
    std::size_t start = 0;
    std::int64_t before = points[piece[0]][axis];
    for (std::size_t i = 1; i < piece.size(); ++i) {
      const std::int64_t here = points[piece[i]][axis];
      if (here - before >= reach_) {
        if (i - start > 1) keep(piece.subspan(start, i - start), axis);
        start = i;
      }
      before = here;
    }
    if (piece.size() - start > 1) keep(piece.subspan(start), axis);
  }

  /// What was not cut along `axis` is cut along the next one.
  void keep(std::span<int> piece, std::size_t axis) {
    if (axis == 2) {
      found_.insert(found_.end(), piece.begin(), piece.end());
      return;
    }
    if (!is_sorted(piece, axis + 1))
      std::ranges::sort(piece, {}, [&](int i) { return points_[at(i)][axis + 1]; });
    cut(piece, axis + 1);
  }

  [[nodiscard]] bool is_sorted(std::span<const int> piece, std::size_t axis) const {
    const Point* const points = points_.data();
    std::int64_t before = points[piece[0]][axis];
    for (const int i : piece) {
      if (points[i][axis] < before) return false;
      before = points[i][axis];
    }
    return true;
  }

  std::span<const Point> points_;
  std::int64_t reach_;  ///< a whole number is below this one if it is below `reach`
  Numbers found_;
};

struct ReachCube {
  std::int64_t x, y, z;
  friend bool operator==(const ReachCube&, const ReachCube&) = default;
};

struct ReachCubeHash {
  std::size_t operator()(const ReachCube& b) const noexcept {
    std::uint64_t h = static_cast<std::uint64_t>(b.x) * 0x9E3779B97F4A7C15ULL;
    h = (h ^ (h >> 31)) + static_cast<std::uint64_t>(b.y) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 29)) + static_cast<std::uint64_t>(b.z) * 0x94D049BB133111EBULL;
    return h ^ (h >> 32);
  }
};

template <class Point>
double distance2(const Point& p, const Point& q) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto d = static_cast<double>(p[i] - q[i]);
    sum += d * d;
  }
  return sum;
}

/// Unites the pairs among `members` that are closer than `reach`.
template <class Point>
void unite_near(std::span<const Point> points, std::span<const int> members, double reach,
                const std::function<bool(int, int)>& is_pair, DisjointSets& groups) {
  const auto edge = static_cast<std::int64_t>(std::ceil(reach));
  const auto floor_div = [edge](std::int64_t c) {
    return c >= 0 ? c / edge : -((-c + edge - 1) / edge);
  };
  std::unordered_map<ReachCube, Numbers, ReachCubeHash> buckets;
  for (const int i : members) {
    const auto& p = points[at(i)];
    const ReachCube home{floor_div(p[0]), floor_div(p[1]), floor_div(p[2])};
    for (std::int64_t n = 0; n < 27; ++n) {
      const auto found =
          buckets.find({home.x + n % 3 - 1, home.y + n / 3 % 3 - 1, home.z + n / 9 - 1});
      if (found == buckets.end()) continue;
      for (const int j : found->second)
        if (distance2(p, points[at(j)]) < reach * reach && (!is_pair || is_pair(i, j)))
          groups.unite(i, j);
    }
    buckets[home].push_back(i);
  }
}

template <class Point>
Numbers group_near(std::span<const Point> points, double reach,
                   const std::function<bool(int, int)>& is_pair) {
  Numbers first(points.size());
  std::iota(first.begin(), first.end(), 0);
  const Numbers candidates = Candidates(points, reach).find();
  if (candidates.empty()) return first;
  DisjointSets groups(points.size());
  unite_near(points, candidates, reach, is_pair, groups);
  for (const int i : candidates) first[at(i)] = groups.find(i);
  return first;
}

}  // namespace

Numbers group_near_points(std::span<const exact::GridPoint> points, double reach) {
  return group_near(points, reach, {});
}

Numbers group_near_points(std::span<const MicrometrePoint> points, double reach,
                          const std::function<bool(int, int)>& is_pair) {
  return group_near(points, reach, is_pair);
}

}  // namespace oriel
