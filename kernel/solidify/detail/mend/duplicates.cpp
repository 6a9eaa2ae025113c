#include "kernel/solidify/detail/mend/duplicates.h"

#include "kernel/model/detail/index.h"

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

}  // namespace

std::vector<char> find_duplicates(const Soup& soup) {
  // Only polygons that start at one point and have as many corners can be equal.
  std::map<std::tuple<int, int, std::size_t>, Numbers> alike;
  for (int p = 0; p < soup.polygon_count(); ++p) {
    const auto corners = soup.corners_of(p);
    alike[{soup.polygons[at(p)].body, *std::ranges::min_element(corners), corners.size()}]
        .push_back(p);
  }
  std::vector<char> is_duplicate(soup.polygons.size(), 0);
  for (const auto& [key, polygons] : alike) {
    if (polygons.size() == 1) continue;
    std::map<Rings, int> first;
    for (const int p : polygons)
      is_duplicate[at(p)] = first.try_emplace(unoriented_rings(soup, p), p).second ? 0 : 1;
  }
  return is_duplicate;
}

}  // namespace oriel::detail
