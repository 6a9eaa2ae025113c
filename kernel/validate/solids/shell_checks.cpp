#include "kernel/validate/solids/shell_checks.h"

#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/validate/solids/shell_edges.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

using Corners = std::array<int, 3>;

struct ShellTriangle {
  Corners corners;
  std::size_t polygon;
};

MicrometreTriangle points_of(const SnappedBuilding& building, const Corners& corners) {
  return {building.point(corners[0]), building.point(corners[1]), building.point(corners[2])};
}

/// `corners` turned so that those shared with `other` come first; how many there are.
std::size_t shared_first(Corners& corners, const Corners& other) {
  const auto is_shared = [&](int corner) {
    return std::ranges::find(other, corner) != other.end();
  };
  const auto rest = std::ranges::stable_partition(corners, is_shared);
  return static_cast<std::size_t>(rest.begin() - corners.begin());
}

/// True if triangles that share an edge, p and q their other corners, lie on each other.
bool fold_back(const SnappedBuilding& building, const Corners& a, int p, int q) {
  const MicrometreTriangle triangle = points_of(building, a);
  if (side_of(triangle[0], triangle[1], triangle[2], building.point(q)) != 0) return false;
  const std::size_t axis = main_axis(triangle);
  const auto flat = [&](int v) { return flattened(building.point(v), axis, true); };
  return turn(flat(a[0]), flat(a[1]), flat(p)) == turn(flat(a[0]), flat(a[1]), flat(q));
}

/// True if two triangles have more in common than their common corners and edges.
bool intersect(const SnappedBuilding& building, Corners a, Corners b) {
  const std::size_t shared = shared_first(a, b);
  shared_first(b, a);
  if (shared == 3) return true;
  if (shared == 2) return fold_back(building, a, a[2], b[2]);
  const MicrometreTriangle one = points_of(building, a);
  const MicrometreTriangle other = points_of(building, b);
  if (shared == 0) return meet(one, other);
  // Beyond the common corner one of the opposite edges would have to touch the other triangle.
  return meets(one[1], one[2], other) || meets(other[1], other[2], one);
}

/// val3dity 306: polygons meet in their common vertices and edges only. Told once for each polygon.
bool is_free_of_crossings(const SnappedBuilding& building, const JudgedShell& shell,
                          FindingList& findings) {
  std::vector<ShellTriangle> triangles;
  std::vector<Box> boxes;
  for (std::size_t p = 0; p < shell.polygons.size(); ++p)
    for (const Corners& corners : shell.polygons[p].triangles) {
      triangles.push_back({corners, p});
      boxes.push_back(box_of(points_of(building, corners)));
    }
  const BoxTree tree(boxes);
  std::vector<std::optional<std::size_t>> crossed_by(shell.polygons.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    tree.for_each_overlap(boxes[i], [&](int number) {
      const std::size_t j = at(number);
      const std::size_t p = triangles[i].polygon;
      const std::size_t q = triangles[j].polygon;
      if (j <= i || p == q || (crossed_by[p] && crossed_by[q])) return;
      if (!intersect(building, triangles[i].corners, triangles[j].corners)) return;
      if (!crossed_by[p]) crossed_by[p] = q;
      if (!crossed_by[q]) crossed_by[q] = p;
    });
  bool is_good = true;
  for (std::size_t p = 0; p < shell.polygons.size(); ++p) {
    if (!crossed_by[p]) continue;
    const SnappedPolygon& polygon = *shell.polygons[p].polygon;
    const SnappedPolygon& other = *shell.polygons[*crossed_by[p]].polygon;
    findings.add(
        Defect::shell_crosses_itself, {shell.body, shell.shell, polygon.number, -1},
        fmt::format("polygon {} meets polygon {} elsewhere than in a common vertex or edge",
                    polygon.number, other.number),
        {polygon.rings[0][0]});
    is_good = false;
  }
  return is_good;
}

}  // namespace

bool judge(const SnappedBuilding& building, const JudgedShell& shell, bool may_be_open,
           FindingList& findings) {
  constexpr std::size_t kFewest = 4;
  if (!may_be_open && shell.polygons.size() < kFewest) {
    findings.add(
        Defect::too_few_polygons, {shell.body, shell.shell, -1, -1},
        fmt::format("the shell has {} polygons; expected at least 4", shell.polygons.size()));
    return false;
  }
  const ShellEdges edges = edges_of(shell);
  const bool is_manifold = are_edges_manifold(shell, edges, findings);
  if (!is_manifold) return false;
  return are_turned_alike(shell, edges, findings) && are_vertices_manifold(shell, findings) &&
         is_one_piece(shell, edges, findings) &&
         (may_be_open || is_closed(shell, edges, findings)) &&
         is_free_of_crossings(building, shell, findings);
}

}  // namespace oriel::detail
