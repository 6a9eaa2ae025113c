#include "kernel/solidify/detail/mend/t_vertices.h"

#include "kernel/solidify/detail/edge_groups.h"
#include "kernel/solidify/detail/mend/box_tree.h"
#include "kernel/solidify/detail/mend/soup_builder.h"

#include <algorithm>
#include <map>
#include <utility>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vec3 place(const Soup& soup, int point) { return exact::to_metres(soup.points[at(point)], 1); }

/// The edges with an odd number of polygons, each once, and their ends.
struct OddEdges {
  std::vector<std::pair<int, int>> edges;
  std::vector<int> ends;
};

OddEdges odd_edges(const Soup& soup) {
  OddEdges odd;
  const ShellMesh mesh = linked_rings(soup);
  EdgeGroups(soup, mesh).for_each([&](EdgeGroup group) {
    if (group.size() % 2 == 0) return;
    const auto h = at(group[0]);
    const auto [low, high] = std::minmax({soup.corners[h], soup.corners[at(mesh.next[h])]});
    odd.edges.emplace_back(low, high);
    odd.ends.insert(odd.ends.end(), {low, high});
  });
  std::ranges::sort(odd.ends);
  odd.ends.erase(std::unique(odd.ends.begin(), odd.ends.end()), odd.ends.end());
  return odd;
}

/// By edge (the smaller point first) the points between its ends, in order.
using Between = std::map<std::pair<int, int>, std::vector<int>>;

Between find_between(const Soup& soup, const OddEdges& odd, double reach) {
  std::vector<Box> boxes(odd.ends.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].grow(place(soup, odd.ends[i]));
  const BoxTree tree(std::move(boxes));
  Between between;
  for (const auto& [low, high] : odd.edges) {
    const Vec3 from = place(soup, low), to = place(soup, high);
    const Vec3 axis = normalised(to - from);
    std::vector<std::pair<double, int>> found;
    tree.search([&](const Box& box) { return comes_near(box, from, to, reach); },
                [&](int i) {
                  const int v = odd.ends[at(i)];
                  const Vec3 way = place(soup, v) - from;
                  const double along = dot(way, axis);
                  if (v == low || v == high || along <= 0 || along >= length(to - from)) return;
                  if (length(way - along * axis) <= reach) found.emplace_back(along, v);
                });
    if (found.empty()) continue;
    std::ranges::sort(found);
    for (const auto& [along, v] : found) between[{low, high}].push_back(v);
  }
  return between;
}

}  // namespace

SoupWithTVertices insert_t_vertices(const Soup& soup, double reach) {
  const Between between = find_between(soup, odd_edges(soup), reach);
  SoupBuilder builder(soup);
  int inserted = 0;
  for (const auto& [edge, points] : between) inserted += static_cast<int>(points.size());
  Numbers ring;
  const auto append_edge = [&](int v, int next) {
    ring.push_back(v);
    const auto found = between.find(std::minmax(v, next));
    if (found == between.end()) return;
    if (v < next)
      ring.insert(ring.end(), found->second.begin(), found->second.end());
    else
      ring.insert(ring.end(), found->second.rbegin(), found->second.rend());
  };
  for (int p = 0; p < soup.polygon_count(); ++p) {
    builder.begin_polygon(soup.polygons[at(p)]);
    for (const int r : soup.rings_of(p)) {
      const auto corners = soup.ring(r);
      ring.clear();
      for (std::size_t i = 0; i < corners.size(); ++i)
        append_edge(corners[i], corners[(i + 1) % corners.size()]);
      builder.add_ring(ring);
    }
  }
  return {builder.finish(), inserted};
}

}  // namespace oriel::detail
