#include "kernel/solidify/detail/soup.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// Disjoint sets whose representative is the smallest member.
class SmallestFirst {
 public:
  explicit SmallestFirst(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int find(int i) {
    while (parent_[index(i)] != i) i = parent_[index(i)] = parent_[index(parent_[index(i)])];
    return i;
  }
  void unite(int i, int j) {
    i = find(i);
    j = find(j);
    parent_[index(std::max(i, j))] = std::min(i, j);
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  std::vector<int> parent_;
};

struct Bucket {
  std::int64_t x, y, z;
  friend bool operator==(const Bucket&, const Bucket&) = default;
};

struct BucketHash {
  std::size_t operator()(const Bucket& b) const noexcept {
    std::uint64_t h = static_cast<std::uint64_t>(b.x) * 0x9E3779B97F4A7C15ULL;
    h = (h ^ (h >> 31)) + static_cast<std::uint64_t>(b.y) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 29)) + static_cast<std::uint64_t>(b.z) * 0x94D049BB133111EBULL;
    return h ^ (h >> 32);
  }
};

double distance2(const exact::GridPoint& p, const exact::GridPoint& q) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto d = static_cast<double>(p[i] - q[i]);
    sum += d * d;
  }
  return sum;
}

/// For every point of the sorted list the first point of its group; groups are united pairs closer
/// than `reach`.
std::vector<int> group_points(const std::vector<exact::GridPoint>& points, double reach) {
  const auto edge = static_cast<std::int64_t>(std::ceil(reach));
  const auto floor_div = [edge](std::int64_t c) {
    return c >= 0 ? c / edge : -((-c + edge - 1) / edge);
  };
  std::unordered_map<Bucket, std::vector<int>, BucketHash> buckets;
  SmallestFirst groups(points.size());
  for (int i = 0; i < std::ssize(points); ++i) {
    const auto& p = points[static_cast<std::size_t>(i)];
    const Bucket home{floor_div(p[0]), floor_div(p[1]), floor_div(p[2])};
    for (std::int64_t n = 0; n < 27; ++n) {
      const auto found =
          buckets.find({home.x + n % 3 - 1, home.y + n / 3 % 3 - 1, home.z + n / 9 - 1});
      if (found == buckets.end()) continue;
      for (const int j : found->second)
        if (distance2(p, points[static_cast<std::size_t>(j)]) < reach * reach) groups.unite(i, j);
    }
    buckets[home].push_back(i);
  }
  std::vector<int> first(points.size());
  for (int i = 0; i < std::ssize(points); ++i) first[static_cast<std::size_t>(i)] = groups.find(i);
  return first;
}

/// The simple rings that a ring consists of: where it comes back to a vertex (it touches itself, or
/// a bridge ties a hole to its outer ring) it is cut in two, and what has fewer than three vertices
/// goes. Each starts at its smallest vertex.
std::vector<std::vector<int>> simple_rings(const std::vector<int>& ring) {
  std::vector<std::vector<int>> rings;
  const auto keep = [&](std::vector<int> simple) {
    if (simple.size() < 3) return;
    std::ranges::rotate(simple, std::ranges::min_element(simple));
    rings.push_back(std::move(simple));
  };
  std::vector<int> path;
  for (const int v : ring) {
    const auto seen = std::ranges::find(path, v);
    if (seen != path.end()) {
      keep({seen, path.end()});
      path.erase(seen, path.end());
    }
    path.push_back(v);
  }
  keep(std::move(path));
  return rings;
}

/// Replaces every entry by its place among the entries in use, which stay in order.
void drop_unused_points(Soup& soup) {
  std::vector<int> place(soup.points.size(), -1);
  for (const SoupPolygon& polygon : soup.polygons)
    for (const auto& ring : polygon.rings)
      for (const int v : ring) place[static_cast<std::size_t>(v)] = 0;
  std::vector<exact::GridPoint> used;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] < 0) continue;
    place[v] = static_cast<int>(used.size());
    used.push_back(soup.points[v]);
  }
  soup.points = std::move(used);
  for (SoupPolygon& polygon : soup.polygons)
    for (auto& ring : polygon.rings)
      for (int& v : ring) v = place[static_cast<std::size_t>(v)];
}

}  // namespace

double grid_for(double weld_m) { return std::exp2(std::floor(std::log2(weld_m / 1024))); }

Soup weld(const Building& building, const Tolerances& tolerances, std::vector<Issue>& issues) {
  Soup soup;
  soup.grid_m = grid_for(tolerances.weld_m);
  std::vector<exact::GridPoint> rounded;
  rounded.reserve(building.vertices.size());
  for (const Vec3 p : building.vertices) rounded.push_back(exact::round_to_grid(p, soup.grid_m));

  soup.points = rounded;
  std::ranges::sort(soup.points);
  soup.points.erase(std::unique(soup.points.begin(), soup.points.end()), soup.points.end());
  const std::vector<int> first = group_points(soup.points, tolerances.weld_m / soup.grid_m);
  const auto welded = [&](int v) {
    const auto found = std::ranges::lower_bound(soup.points, rounded[static_cast<std::size_t>(v)]);
    return first[static_cast<std::size_t>(found - soup.points.begin())];
  };

  int dropped = 0;
  for (const Polygon& polygon : building.polygons) {
    SoupPolygon out{{}, polygon.source, polygon.body, polygon.shell};
    for (const auto& ring : polygon.rings) {
      std::vector<int> points;
      for (const int v : ring) points.push_back(welded(v));
      auto simple = simple_rings(points);
      if (simple.empty() && out.rings.empty()) break;
      std::ranges::move(simple, std::back_inserter(out.rings));
    }
    if (out.rings.empty()) {
      ++dropped;
      continue;
    }
    std::ranges::sort(out.rings);
    soup.polygons.push_back(std::move(out));
  }
  if (dropped > 0)
    issues.push_back(building_issue(
        Severity::note, "E304", building.id,
        fmt::format("{} polygons are degenerate after welding at {} m and were dropped", dropped,
                    tolerances.weld_m)));
  drop_unused_points(soup);
  std::ranges::sort(soup.polygons, [](const SoupPolygon& p, const SoupPolygon& q) {
    return std::tie(p.body, p.rings, p.source) < std::tie(q.body, q.rings, q.source);
  });
  return soup;
}

}  // namespace oriel::detail
