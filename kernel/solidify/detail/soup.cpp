#include "kernel/solidify/detail/soup.h"

#include "kernel/model/detail/counting_sort.h"
#include "kernel/solidify/detail/near_points.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// One number for a point, ordered as its coordinates: |coordinate| ≤ 2^32, so 34 bits hold each.
exact::Int128 sort_key(const exact::GridPoint& point) {
  exact::Int128 key = 0;
  for (const std::int64_t c : point) key = (key << 34) | (c + (std::int64_t{1} << 33));
  return key;
}

/// Fills Soup::points with the rounded vertices, sorted; returns the point of every vertex, united
/// with those within reach.
std::vector<int> weld_points(const Building& building, double reach, Soup& soup) {
  struct Rounded {
    exact::Int128 key;
    int vertex;
  };
  std::vector<exact::GridPoint> grid_points;
  std::vector<Rounded> rounded;
  grid_points.reserve(building.vertices.size());
  rounded.reserve(building.vertices.size());
  for (const Vec3 p : building.vertices) {
    grid_points.push_back(exact::round_to_grid(p, soup.grid_m));
    rounded.push_back({sort_key(grid_points.back()), static_cast<int>(rounded.size())});
  }
  std::ranges::sort(rounded, {}, &Rounded::key);

  std::vector<int> point_of(building.vertices.size());
  soup.points.reserve(building.vertices.size());
  for (std::size_t i = 0; i < rounded.size(); ++i) {
    if (i == 0 || rounded[i].key != rounded[i - 1].key)
      soup.points.push_back(grid_points[at(rounded[i].vertex)]);
    point_of[at(rounded[i].vertex)] = static_cast<int>(soup.points.size()) - 1;
  }
  const std::vector<int> first = group_near_points(soup.points, reach);
  for (int& point : point_of) point = first[at(point)];
  return point_of;
}

/// Cuts rings into the simple rings they consist of and appends these to a soup.
class RingCutter {
 public:
  explicit RingCutter(Soup& soup) : soup_(soup), place_in_path_(soup.points.size(), -1) {}

  /// Where the ring comes back to a point (it touches itself, or a bridge ties a hole to its outer
  /// ring) it is cut in two, and what has fewer than three vertices goes.
  void append(std::span<const int> ring, std::span<const int> point_of) {
    for (const int vertex : ring) {
      const int v = point_of[at(vertex)];
      if (place_in_path_[at(v)] >= 0) close_at(at(place_in_path_[at(v)]));
      place_in_path_[at(v)] = static_cast<int>(path_.size());
      path_.push_back(v);
    }
    close_at(0);
  }

 private:
  /// Appends the end of the path from place `start` as a ring, from its smallest vertex, and takes
  /// it off the path.
  void close_at(std::size_t start) {
    const auto begin = path_.begin() + static_cast<std::ptrdiff_t>(start);
    if (path_.end() - begin >= 3) {
      const auto smallest = std::min_element(begin, path_.end());
      soup_.corners.insert(soup_.corners.end(), smallest, path_.end());
      soup_.corners.insert(soup_.corners.end(), begin, smallest);
      soup_.first_corner.push_back(soup_.corner_count());
    }
    for (auto v = begin; v != path_.end(); ++v) place_in_path_[at(*v)] = -1;
    path_.erase(begin, path_.end());
  }

  Soup& soup_;
  std::vector<int> path_;
  std::vector<int> place_in_path_;  ///< of each point, -1 off the path
};

std::strong_ordering compare_rings(const Soup& soup, int r, int s) {
  const auto p = soup.ring(r), q = soup.ring(s);
  return std::lexicographical_compare_three_way(p.begin(), p.end(), q.begin(), q.end());
}

/// Sorts the rings from `first` on.
void sort_rings(Soup& soup, int first) {
  std::vector<int> order(at(soup.ring_count() - first));
  std::iota(order.begin(), order.end(), first);
  const auto comes_first = [&](int r, int s) { return compare_rings(soup, r, s) < 0; };
  if (std::ranges::is_sorted(order, comes_first)) return;
  std::ranges::sort(order, comes_first);
  std::vector<int> corners, first_corner;
  const int begin = soup.first_corner[at(first)];
  for (const int r : order) {
    first_corner.push_back(begin + static_cast<int>(corners.size()));
    corners.insert(corners.end(), soup.ring(r).begin(), soup.ring(r).end());
  }
  std::ranges::copy(corners, soup.corners.begin() + begin);
  std::ranges::copy(first_corner, soup.first_corner.begin() + first);
}

/// Appends the building's polygons in its order. Returns how many have nothing left of their outer
/// ring and were dropped.
int append_polygons(const Building& building, std::span<const int> point_of, Soup& soup) {
  int dropped = 0;
  RingCutter cutter(soup);
  for (const Polygon& polygon : building.polygons) {
    const int first = soup.ring_count();
    for (const auto& ring : polygon.rings) {
      cutter.append(ring, point_of);
      if (soup.ring_count() == first) break;
    }
    if (soup.ring_count() == first) {
      ++dropped;
      continue;
    }
    if (soup.ring_count() > first + 1) sort_rings(soup, first);
    soup.polygons.push_back({polygon.source, polygon.body, polygon.shell});
    soup.first_ring.push_back(soup.ring_count());
  }
  return dropped;
}

/// Leaves only the points in use, in their order.
void drop_unused_points(Soup& soup) {
  std::vector<int> place(soup.points.size(), -1);
  for (const int v : soup.corners) place[at(v)] = 0;
  int used = 0;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] < 0) continue;
    soup.points[at(used)] = soup.points[v];
    place[v] = used++;
  }
  soup.points.resize(at(used));
  for (int& v : soup.corners) v = place[at(v)];
}

/// The polygons by body, then rings, then source.
std::vector<int> canonical_order(const Soup& soup) {
  std::vector<int> smallest_point;
  for (int p = 0; p < soup.polygon_count(); ++p)
    smallest_point.push_back(soup.corners_of(p).front());
  Buckets buckets = sort_into_buckets(smallest_point, soup.points.size());
  const auto comes_first = [&](int p, int q) {
    const auto rings = soup.rings_of(p), others = soup.rings_of(q);
    const auto order = std::lexicographical_compare_three_way(
        rings.begin(), rings.end(), others.begin(), others.end(),
        [&](int r, int s) { return compare_rings(soup, r, s); });
    return order != 0 ? order < 0 : soup.polygons[at(p)].source < soup.polygons[at(q)].source;
  };
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    std::sort(buckets.items.begin() + buckets.first[v],
              buckets.items.begin() + buckets.first[v + 1], comes_first);
  const auto body = [&](int p) { return soup.polygons[at(p)].body; };
  if (!std::ranges::is_sorted(buckets.items, {}, body))
    std::ranges::stable_sort(buckets.items, {}, body);
  return std::move(buckets.items);
}

void arrange_polygons(Soup& soup, const std::vector<int>& order) {
  std::vector<SoupPolygon> polygons;
  std::vector<int> first_ring{0}, first_corner{0}, corners;
  polygons.reserve(soup.polygons.size());
  first_ring.reserve(soup.first_ring.size());
  first_corner.reserve(soup.first_corner.size());
  corners.reserve(soup.corners.size());
  for (const int p : order) {
    polygons.push_back(soup.polygons[at(p)]);
    for (const int r : soup.rings_of(p)) {
      const auto ring = soup.ring(r);
      corners.insert(corners.end(), ring.begin(), ring.end());
      first_corner.push_back(static_cast<int>(corners.size()));
    }
    first_ring.push_back(static_cast<int>(first_corner.size()) - 1);
  }
  soup.polygons = std::move(polygons);
  soup.first_ring = std::move(first_ring);
  soup.first_corner = std::move(first_corner);
  soup.corners = std::move(corners);
}

}  // namespace

double grid_for(double weld_m) { return std::exp2(std::floor(std::log2(weld_m / 1024))); }

Soup weld(const Building& building, const Tolerances& tolerances, std::vector<Issue>& issues) {
  Soup soup;
  soup.grid_m = grid_for(tolerances.weld_m);
  const std::vector<int> point_of = weld_points(building, tolerances.weld_m / soup.grid_m, soup);
  const int dropped = append_polygons(building, point_of, soup);
  if (dropped > 0)
    issues.push_back(building_issue(
        Severity::note, "E304", building.id,
        fmt::format("{} polygons are degenerate after welding at {} m and were dropped", dropped,
                    tolerances.weld_m)));
  drop_unused_points(soup);
  arrange_polygons(soup, canonical_order(soup));
  return soup;
}

}  // namespace oriel::detail
