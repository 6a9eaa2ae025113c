#include "model/canonical_order.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <tuple>

namespace oriel {

namespace {

/// Where the parts of a list begin that keep their places: the building's own, then that of each
/// installation; and where the last one ends.
std::vector<std::size_t> parts(const Building& building, std::size_t JoinedInstallation::*first,
                               std::size_t size) {
  std::vector<std::size_t> begins{0};
  for (const JoinedInstallation& one : building.installations) begins.push_back(one.*first);
  begins.push_back(size);
  return begins;
}

/// Sorts the numbers from `begins[i]` up to `begins[i + 1]` by `key`, for each i.
template <class Less>
std::vector<int> sorted_in_parts(const std::vector<std::size_t>& begins, Less less) {
  std::vector<int> order(begins.back());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
    const auto part = std::span(order).subspan(begins[i], begins[i + 1] - begins[i]);
    std::ranges::stable_sort(part, less);
  }
  return order;
}

/// Sorts the vertices; returns the new number of each. Those in the same place get one number.
std::vector<int> sort_vertices(const Building& read, std::vector<Vec3>& vertices) {
  const auto key = [&](int v) {
    const Vec3& p = read.vertices[at(v)];
    return std::tie(p.x, p.y, p.z);
  };
  const std::vector<int> order =
      sorted_in_parts(parts(read, &JoinedInstallation::first_vertex, read.vertices.size()),
                      [&](int v, int w) { return key(v) < key(w); });
  std::vector<int> number_of(order.size());
  vertices.reserve(order.size());
  for (const int v : order) {
    const bool is_new = vertices.empty() || vertices.back() != read.vertices[at(v)];
    const auto place = static_cast<int>(vertices.size());
    number_of[at(v)] = is_new ? place : number_of[at(order[at(place - 1)])];
    vertices.push_back(read.vertices[at(v)]);
  }
  return number_of;
}

/// Lets a ring begin where it reads least, corner by corner.
void start_at_least(std::vector<int>& ring) {
  const std::size_t size = ring.size();
  std::size_t least = 0;
  const auto is_less = [&](std::size_t start) {
    for (std::size_t i = 0; i < size; ++i) {
      const int here = ring[(start + i) % size], there = ring[(least + i) % size];
      if (here != there) return here < there;
    }
    return false;
  };
  for (std::size_t start = 1; start < size; ++start)
    if (ring[start] <= ring[least] && is_less(start)) least = start;
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(least), ring.end());
}

}  // namespace

CanonicalOrder::CanonicalOrder(const Building& read) {
  building.id = read.id;
  building.lod = read.lod;
  building.frame = read.frame;
  building.is_solid = read.is_solid;
  building.is_composite = read.is_composite;
  building.installations = read.installations;
  const std::vector<int> number_of = sort_vertices(read, building.vertices);
  std::vector<Polygon> polygons = read.polygons;
  std::vector<int> sources;
  for (Polygon& polygon : polygons) {
    if (polygon.source >= 0) sources.push_back(polygon.source);
    for (auto& ring : polygon.rings) {
      for (int& v : ring) v = number_of[at(v)];
      start_at_least(ring);
    }
    if (polygon.rings.size() > 2) std::sort(polygon.rings.begin() + 1, polygon.rings.end());
  }
  const auto key = [&](int i) {
    const Polygon& p = polygons[at(i)];
    return std::tie(p.body, p.rings, p.shell, p.hint);
  };
  const std::vector<int> order =
      sorted_in_parts(parts(read, &JoinedInstallation::first_polygon, polygons.size()),
                      [&](int i, int j) { return key(i) < key(j); });
  std::ranges::sort(sources);
  to_reading.resize(sources.empty() ? 0 : at(sources.back()) + 1);
  from_reading = to_reading;
  auto next = sources.begin();
  building.polygons.reserve(order.size());
  for (const int i : order) {
    Polygon& polygon = building.polygons.emplace_back(std::move(polygons[at(i)]));
    if (polygon.source < 0) continue;
    to_reading[at(*next)] = polygon.source;
    from_reading[at(polygon.source)] = *next;
    polygon.source = *next++;
  }
}

}  // namespace oriel
