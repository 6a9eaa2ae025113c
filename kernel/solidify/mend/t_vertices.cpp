#include "kernel/solidify/mend/t_vertices.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/solidify/shells/edge_groups.h"
#include "kernel/solidify/soup/soup.h"

#include <algorithm>
#include <map>
#include <utility>

namespace oriel::detail {

namespace {

Vec3 place(const Soup& soup, int point) { return exact::to_metres(soup.points[at(point)], 1); }

/// What sorting the edges, making their tree and looking up an end in it takes.
constexpr std::int64_t kStepsPerEdge = 16;

/// Every edge once, and the ends that are asked for.
struct Edges {
  std::vector<std::pair<int, int>> all;
  std::vector<int> ends;
};

Edges edges_of(const Soup& soup, Inserted inserted) {
  Edges edges;
  const ShellMesh mesh = linked_rings(soup);
  EdgeGroups(soup, mesh).for_each([&](EdgeGroup group) {
    const auto h = at(group[0]);
    const auto edge = std::minmax({soup.corners[h], soup.corners[at(mesh.next[h])]});
    if (edges.all.empty() || edges.all.back() != edge) edges.all.push_back(edge);
    if (inserted == Inserted::all || group.size() % 2 == 1)
      edges.ends.insert(edges.ends.end(), {edge.first, edge.second});
  });
  std::ranges::sort(edges.ends);
  edges.ends.erase(std::unique(edges.ends.begin(), edges.ends.end()), edges.ends.end());
  return edges;
}

/// By edge (the smaller point first) the points between its ends, in order.
using Between = std::map<std::pair<int, int>, std::vector<int>>;

Between find_between(const Soup& soup, double reach, Inserted inserted, Work& work) {
  const Edges edges = edges_of(soup, inserted);
  work.add(kStepsPerEdge * std::ssize(edges.all));
  std::map<std::pair<int, int>, std::vector<std::pair<double, int>>> found;
  if (!edges.ends.empty()) {
    std::vector<Box> boxes(edges.all.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      boxes[i].grow(place(soup, edges.all[i].first));
      boxes[i].grow(place(soup, edges.all[i].second));
    }
    const BoxTree tree(std::move(boxes));
    for (const int v : edges.ends) {
      if (work.is_used_up()) return {};
      const Vec3 point = place(soup, v);
      tree.search([&](const Box& box) { return comes_near(box, point, point, reach); },
                  [&](int i) {
                    work.add(1);
                    const auto& edge = edges.all[at(i)];
                    if (v == edge.first || v == edge.second) return;
                    const Vec3 from = place(soup, edge.first), to = place(soup, edge.second);
                    const Vec3 axis = normalised(to - from), way = point - from;
                    const double along = dot(way, axis);
                    if (along <= 0 || along >= length(to - from)) return;
                    if (length(way - along * axis) <= reach) found[edge].emplace_back(along, v);
                  });
    }
  }
  Between between;
  for (auto& [edge, points] : found) {
    std::ranges::sort(points);
    for (const auto& [along, v] : points) between[edge].push_back(v);
  }
  return between;
}

}  // namespace

SoupWithTVertices insert_t_vertices(const Soup& soup, double reach, Inserted which, Work* work) {
  ORIEL_ASSERT(reach >= 0);
  Work uncounted;
  const Between between = find_between(soup, reach, which, work != nullptr ? *work : uncounted);
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
