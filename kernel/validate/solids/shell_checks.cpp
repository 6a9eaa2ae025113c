#include "kernel/validate/solids/shell_checks.h"

#include "kernel/base/index.h"
#include "kernel/base/text/counted.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/validate/solids/triangle_pairs.h"
#include "kernel/validate/solids/triangle_plane.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// An edge of a polygon of a shell, between two vertices.
struct ShellEdge {
  int low;
  int high;
  /// From low to high?
  bool is_rising;
  /// Index in JudgedShell::polygons.
  int polygon;
};

/// Edges of a shell between the same two vertices: [from, to) of ShellEdges::edges.
struct CoincidentEdges {
  std::size_t from;
  std::size_t to;
  [[nodiscard]] std::size_t size() const { return to - from; }
};

/// All edges of the polygons of a shell, sorted, and their groups.
struct ShellEdges {
  std::vector<ShellEdge> edges;
  std::vector<CoincidentEdges> groups;
};

int number_of(const JudgedShell& shell, int polygon) {
  return shell.polygons[at(polygon)].polygon->number;
}

Subject subject_of(const JudgedShell& shell, int polygon) {
  return {shell.body, shell.shell, number_of(shell, polygon), -1};
}

/// "3, 4 and 7": at most four, then how many more.
std::string numbers_of(const JudgedShell& shell, const ShellEdges& all,
                       const CoincidentEdges& group) {
  constexpr std::size_t kShown = 4;
  std::string text;
  for (std::size_t i = group.from; i < std::min(group.to, group.from + kShown); ++i)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", number_of(shell, all.edges[i].polygon));
  if (group.size() > kShown) text += fmt::format(" and {} more", group.size() - kShown);
  return text;
}

/// Polygons joined by edges, each known by its least polygon.
DisjointSets pieces_of(const JudgedShell& shell, const ShellEdges& all) {
  DisjointSets pieces(shell.polygons.size());
  for (const CoincidentEdges& group : all.groups)
    for (std::size_t i = group.from + 1; i < group.to; ++i)
      pieces.unite(all.edges[group.from].polygon, all.edges[i].polygon);
  return pieces;
}

/// Polygons in one of two turns: node 2p is polygon p as it is, 2p + 1 turned. Neighbours that run
/// against each other agree as they are.
DisjointSets turns_of(const JudgedShell& shell, const ShellEdges& all) {
  DisjointSets turns(2 * shell.polygons.size());
  for (const CoincidentEdges& group : all.groups) {
    if (group.size() != 2) continue;
    const ShellEdge& p = all.edges[group.from];
    const ShellEdge& q = all.edges[group.from + 1];
    const int is_odd = p.is_rising == q.is_rising ? 1 : 0;
    turns.unite(2 * p.polygon, 2 * q.polygon + is_odd);
    turns.unite(2 * p.polygon + 1, 2 * q.polygon + 1 - is_odd);
  }
  return turns;
}

ShellEdges edges_of(const JudgedShell& shell) {
  ShellEdges all;
  for (std::size_t p = 0; p < shell.polygons.size(); ++p)
    for (const auto& ring : shell.polygons[p].polygon->rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const int from = ring[i];
        const int to = ring[(i + 1) % ring.size()];
        all.edges.push_back(
            {std::min(from, to), std::max(from, to), from < to, static_cast<int>(p)});
      }
  const auto key = [](const ShellEdge& edge) {
    return std::tuple(edge.low, edge.high, edge.polygon, edge.is_rising);
  };
  std::ranges::sort(all.edges, {}, key);
  for (std::size_t i = 0; i < all.edges.size();) {
    std::size_t end = i + 1;
    while (end < all.edges.size() && all.edges[end].low == all.edges[i].low &&
           all.edges[end].high == all.edges[i].high)
      ++end;
    all.groups.push_back({i, end});
    i = end;
  }
  return all;
}

/// val3dity 303: no more than two polygons meet at an edge.
bool are_edges_manifold(const JudgedShell& shell, const ShellEdges& all, FindingList& findings) {
  bool is_good = true;
  for (const CoincidentEdges& group : all.groups) {
    if (group.size() <= 2) continue;
    const ShellEdge& edge = all.edges[group.from];
    findings.add(Defect::many_at_edge, subject_of(shell, edge.polygon),
                 fmt::format("{} polygons ({}) meet; expected two", group.size(),
                             numbers_of(shell, all, group)),
                 {edge.low, edge.high});
    is_good = false;
  }
  return is_good;
}

/// val3dity 303, of a shell whose edges are manifold: no more than two triangles meet at an edge.
/// That of two polygons may be a diagonal of a third one that is not flat, or two have one
/// diagonal.
bool are_diagonals_free(const JudgedShell& shell, FindingList& findings) {
  std::vector<std::tuple<int, int, int>> sides;  // low, high, polygon
  for (int p = 0; p < std::ssize(shell.polygons); ++p)
    for (const auto& corners : shell.polygons[at(p)].triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
        sides.emplace_back(low, high, p);
      }
  std::ranges::sort(sides);
  bool is_good = true;
  for (std::size_t i = 0; i + 2 < sides.size(); ++i) {
    const auto& [low, high, first] = sides[i];
    if (std::get<0>(sides[i + 2]) != low || std::get<1>(sides[i + 2]) != high) continue;
    if (i > 0 && std::get<0>(sides[i - 1]) == low && std::get<1>(sides[i - 1]) == high) continue;
    findings.add(Defect::many_at_edge, subject_of(shell, first),
                 fmt::format("triangles of the polygons {}, {} and {} meet; expected two",
                             number_of(shell, first), number_of(shell, std::get<2>(sides[i + 1])),
                             number_of(shell, std::get<2>(sides[i + 2]))),
                 {low, high});
    is_good = false;
  }
  return is_good;
}

/// val3dity 307, of edges of at most two polygons: neighbours run along their edge in opposite
/// directions. Reported of the polygons that are fewer in their piece, or once if no turning helps.
bool are_turned_alike(const JudgedShell& shell, const ShellEdges& all, FindingList& findings) {
  const auto runs_along = [&](const CoincidentEdges& group) {
    return group.size() == 2 &&
           all.edges[group.from].is_rising == all.edges[group.from + 1].is_rising;
  };
  const auto first = std::ranges::find_if(all.groups, runs_along);
  if (first == all.groups.end()) return true;
  DisjointSets turns = turns_of(shell, all);
  for (int p = 0; p < std::ssize(shell.polygons); ++p)
    if (turns.find(2 * p) == turns.find(2 * p + 1)) {
      const ShellEdge& edge = all.edges[first->from];
      findings.add(
          Defect::one_sided, subject_of(shell, edge.polygon),
          fmt::format("polygons {} run the same way along an edge, and turning some cannot "
                      "mend it: the surface is one-sided",
                      numbers_of(shell, all, *first)),
          {edge.low, edge.high});
      return false;
    }
  // Of each piece, the polygons in its one turn and in the other.
  std::map<int, std::array<std::vector<int>, 2>> sides;
  for (int p = 0; p < std::ssize(shell.polygons); ++p) {
    const int as_is = turns.find(2 * p);
    const int turned = turns.find(2 * p + 1);
    sides[std::min(as_is, turned)][as_is < turned ? 0 : 1].push_back(p);
  }
  for (const auto& [piece, side] : sides)
    for (const int p : side[0].size() < side[1].size() ? side[0] : side[1])
      findings.add(
          Defect::polygon_turned, subject_of(shell, p),
          fmt::format("polygon {} runs the opposite way to its neighbours", number_of(shell, p)),
          {shell.polygons[at(p)].polygon->rings[0][0]});
  return false;
}

/// val3dity 303: around each vertex its triangles follow each other by edges in one cycle or row.
bool are_vertices_manifold(const JudgedShell& shell, FindingList& findings) {
  // A corner is a triangle at a vertex, as a polygon of which several rings come to a vertex is
  // there in as many parts. Corners on both sides of an edge belong together.
  struct Corner {
    int vertex;
    int before;
    int after;
    int polygon;
  };
  std::vector<Corner> corners;
  for (int p = 0; p < std::ssize(shell.polygons); ++p)
    for (const auto& triangle : shell.polygons[at(p)].triangles)
      for (std::size_t i = 0; i < 3; ++i)
        corners.push_back({triangle[i], triangle[(i + 2) % 3], triangle[(i + 1) % 3], p});
  std::vector<std::tuple<int, int, int>> sides;  // vertex, neighbour, corner
  for (int c = 0; c < std::ssize(corners); ++c) {
    sides.emplace_back(corners[at(c)].vertex, corners[at(c)].before, c);
    sides.emplace_back(corners[at(c)].vertex, corners[at(c)].after, c);
  }
  std::ranges::sort(sides);
  DisjointSets fans(corners.size());
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (std::get<0>(sides[i]) == std::get<0>(sides[i - 1]) &&
        std::get<1>(sides[i]) == std::get<1>(sides[i - 1]))
      fans.unite(std::get<2>(sides[i]), std::get<2>(sides[i - 1]));
  bool is_good = true;
  int vertex = -1;
  int fan = -1;
  bool was_told = false;
  for (const auto& [v, neighbour, c] : sides) {
    if (v != vertex) {
      vertex = v;
      fan = fans.find(c);
      was_told = false;
    }
    if (was_told || fans.find(c) == fan) continue;
    findings.add(Defect::many_at_vertex, subject_of(shell, corners[at(c)].polygon),
                 "polygons meet in a point only; expected one fan of polygons joined by edges",
                 {v});
    was_told = true;
    is_good = false;
  }
  return is_good;
}

/// val3dity 305: edges join all polygons to one piece.
bool is_one_piece(const JudgedShell& shell, const ShellEdges& all, FindingList& findings) {
  DisjointSets pieces = pieces_of(shell, all);
  std::map<int, int> sizes;
  for (int p = 0; p < std::ssize(shell.polygons); ++p) ++sizes[pieces.find(p)];
  if (sizes.size() == 1) return true;
  const auto largest = std::ranges::max_element(
      sizes, {}, [](const std::pair<const int, int>& piece) { return piece.second; });
  for (const auto& [first, size] : sizes) {
    if (first == largest->first) continue;
    findings.add(Defect::shell_in_pieces, subject_of(shell, first),
                 size == 1
                     ? fmt::format("polygon {} is not joined to the rest of the shell by edges",
                                   number_of(shell, first))
                     : fmt::format("{} polygons, polygon {} one of them, are not joined to "
                                   "the rest of the shell by edges",
                                   size, number_of(shell, first)),
                 {shell.polygons[at(first)].polygon->rings[0][0]});
  }
  return false;
}

/// val3dity 302: no edge is of one polygon only. Reported once for each group of edges that hang
/// together.
bool is_closed(const JudgedShell& shell, const ShellEdges& all, FindingList& findings) {
  std::vector<const ShellEdge*> open;
  for (const CoincidentEdges& group : all.groups)
    if (group.size() == 1) open.push_back(&all.edges[group.from]);
  if (open.empty()) return true;
  std::map<int, int> first_at;  // the first open edge at a vertex
  DisjointSets holes(open.size());
  for (int i = 0; i < std::ssize(open); ++i)
    for (const int vertex : {open[at(i)]->low, open[at(i)]->high})
      holes.unite(i, first_at.try_emplace(vertex, i).first->second);
  std::map<int, int> sizes;
  for (int i = 0; i < std::ssize(open); ++i) ++sizes[holes.find(i)];
  for (const auto& [first, size] : sizes) {
    const ShellEdge& edge = *open[at(first)];
    findings.add(Defect::open_shell, subject_of(shell, edge.polygon),
                 fmt::format("not closed: {}, the first of polygon {}",
                             counted(size, "open edge", "connected open edges"),
                             number_of(shell, edge.polygon)),
                 {edge.low, edge.high});
  }
  return false;
}

struct ShellTriangle {
  TriangleCorners corners;
  std::size_t polygon;
};

/// All corners of `other` but those of `own`, whose plane this is, are on one side of it for
/// certain: the triangles have no more in common than those corners.
bool is_beside(const SnappedBuilding& building, const TrianglePlane& plane,
               const TriangleCorners& own, const TriangleCorners& other) {
  int side = 0;
  for (const int corner : other) {
    if (std::ranges::find(own, corner) != own.end()) continue;
    const int its = plane.side_of(building.point(corner));
    if (its == 0 || its == -side) return false;
    side = its;
  }
  return side != 0;
}

/// Of more triangles the tree is asked, too, what lies beside their planes.
constexpr std::size_t kFewTriangles = 4096;

/// For each polygon of a shell one that it meets elsewhere than in common vertices and edges, if
/// there is any: the first in the order of pairs of triangles, so that it is named whatever tree
/// finds it.
std::vector<std::optional<std::size_t>> crossing_partners(const SnappedBuilding& building,
                                                          const JudgedShell& shell, Work& work) {
  std::vector<ShellTriangle> triangles;
  std::vector<Box> boxes;
  for (std::size_t p = 0; p < shell.polygons.size(); ++p)
    for (const TriangleCorners& corners : shell.polygons[p].triangles) {
      triangles.push_back({corners, p});
      boxes.push_back(box_of(points_of(building, corners)));
    }
  const BoxTree tree(boxes);
  std::vector<std::optional<std::size_t>> crossed_by(shell.polygons.size());
  std::vector<std::size_t> later;  // whose boxes overlap that of triangle i
  std::vector<TrianglePlane> planes;
  const bool are_many = triangles.size() > kFewTriangles;
  for (const ShellTriangle& triangle : triangles)
    planes.emplace_back(points_of(building, triangle.corners));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    later.clear();
    std::int64_t looked_at = 0;
    const std::size_t p = triangles[i].polygon;
    const TriangleCorners& mine = triangles[i].corners;
    if (are_many)
      tree.search(
          [&](const Box& box) { return overlap(box, boxes[i]) && !planes[i].is_beside(box); },
          [&](int number) {
            looked_at += 1;
            const std::size_t j = at(number);
            if (j > i && triangles[j].polygon != p &&
                !is_beside(building, planes[j], triangles[j].corners, mine))
              later.push_back(j);
          });
    else
      tree.for_each_overlap(boxes[i], [&](int number) {
        if (const std::size_t j = at(number); j > i) later.push_back(j);
      });
    work.add(looked_at + std::ssize(later));
    if (work.is_used_up()) return {};
    std::ranges::sort(later);
    for (const std::size_t j : later) {
      const std::size_t q = triangles[j].polygon;
      if (p == q || (crossed_by[p] && crossed_by[q])) continue;
      const TriangleCorners& other = triangles[j].corners;
      if (is_beside(building, planes[i], mine, other) ||
          is_beside(building, planes[j], other, mine) || !intersect(building, mine, other))
        continue;
      if (!crossed_by[p]) crossed_by[p] = q;
      if (!crossed_by[q]) crossed_by[q] = p;
    }
  }
  return crossed_by;
}

/// val3dity 306: polygons meet in their common vertices and edges only. Reported once for each
/// polygon.
bool is_free_of_crossings(const SnappedBuilding& building, const JudgedShell& shell,
                          FindingList& findings) {
  const auto crossed_by = crossing_partners(building, shell, findings.work());
  if (findings.is_used_up()) return false;
  bool is_good = true;
  for (std::size_t p = 0; p < shell.polygons.size(); ++p) {
    if (!crossed_by[p]) continue;
    const SnappedPolygon& polygon = *shell.polygons[p].polygon;
    const SnappedPolygon& other = *shell.polygons[*crossed_by[p]].polygon;
    findings.add(Defect::shell_crosses_itself, {shell.body, shell.shell, polygon.number, -1},
                 fmt::format("polygon {} meets polygon {} outside a common vertex or edge",
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
    findings.add(Defect::too_few_polygons, {shell.body, shell.shell, -1, -1},
                 fmt::format("the shell has {}; expected at least 4",
                             counted(shell.polygons.size(), "polygon")));
    return false;
  }
  const ShellEdges edges = edges_of(shell);
  const bool is_manifold = are_edges_manifold(shell, edges, findings);
  if (!is_manifold) return false;
  return are_turned_alike(shell, edges, findings) && are_vertices_manifold(shell, findings) &&
         is_one_piece(shell, edges, findings) &&
         (may_be_open || is_closed(shell, edges, findings)) &&
         are_diagonals_free(shell, findings) && is_free_of_crossings(building, shell, findings);
}

}  // namespace oriel::detail
