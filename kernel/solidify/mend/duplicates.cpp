#include "kernel/solidify/mend/duplicates.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <map>

namespace oriel::detail {

namespace {

using Rings = std::vector<std::vector<int>>;

/// The rings of a polygon, whichever way round it runs: each from its smallest point towards the
/// smaller neighbour of that, in order.
Rings unoriented_rings(const Soup& soup, int polygon) {
  Rings rings;
  for (const int r : soup.rings_of(polygon)) {
    const auto ring = soup.ring(r);
    auto& out = rings.emplace_back(ring.begin(), ring.end());
    if (out.back() < out[1]) std::reverse(out.begin() + 1, out.end());
  }
  std::ranges::sort(rings);
  return rings;
}

/// True if the outer ring runs from its smallest point towards the larger neighbour.
bool runs_back(const Soup& soup, int polygon) {
  const auto ring = soup.ring(*soup.rings_of(polygon).begin());
  const auto least = std::ranges::min_element(ring) - ring.begin();
  const auto size = std::ssize(ring);
  return ring[at(least + size - 1) % at(size)] < ring[at(least + 1) % at(size)];
}

/// Visits the polygons of every group of equal ones, in their order.
template <class Visit>
void for_each_group(const Soup& soup, Visit visit) {
  // Only polygons that start at one point and have as many corners can be equal.
  std::map<std::tuple<int, int, std::size_t>, Numbers> alike;
  for (int p = 0; p < soup.polygon_count(); ++p) {
    const auto corners = soup.corners_of(p);
    alike[{soup.polygons[at(p)].body, *std::ranges::min_element(corners), corners.size()}]
        .push_back(p);
  }
  for (const auto& [key, polygons] : alike) {
    if (polygons.size() == 1) continue;
    std::map<Rings, Numbers> equal;
    for (const int p : polygons) equal[unoriented_rings(soup, p)].push_back(p);
    for (const auto& [rings, group] : equal) visit(group);
  }
}

}  // namespace

std::vector<char> find_duplicates(const Soup& soup) {
  std::vector<char> is_duplicate(soup.polygons.size(), 0);
  for_each_group(soup, [&](const Numbers& group) {
    for (std::size_t i = 1; i < group.size(); ++i) is_duplicate[at(group[i])] = 1;
  });
  return is_duplicate;
}

Soup without_duplicates(const Soup& soup, std::vector<int>& duplicates) {
  const std::vector<char> is_duplicate = find_duplicates(soup);
  SoupBuilder builder(soup);
  for (int p = 0; p < soup.polygon_count(); ++p) {
    if (is_duplicate[at(p)])
      duplicates.push_back(soup.polygons[at(p)].source);
    else
      builder.add_polygon(soup, p);
  }
  std::ranges::sort(duplicates);
  return builder.finish();
}

std::vector<char> find_opposites(const Soup& soup) {
  std::vector<char> is_opposite(soup.polygons.size(), 0);
  for_each_group(soup, [&](const Numbers& group) {
    Numbers ways[2];
    for (const int p : group) ways[runs_back(soup, p)].push_back(p);
    const std::size_t pairs = std::min(ways[0].size(), ways[1].size());
    for (const Numbers& way : ways)
      for (std::size_t i = 0; i < pairs; ++i) is_opposite[at(way[i])] = 1;
  });
  return is_opposite;
}

}  // namespace oriel::detail
