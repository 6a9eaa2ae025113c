#include "kernel/validate/solids/shell_edges.h"

#include "kernel/base/index.h"
#include "kernel/geometry/disjoint_sets.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

int number_of(const JudgedShell& shell, int polygon) {
  return shell.polygons[at(polygon)].polygon->number;
}

Subject subject_of(const JudgedShell& shell, int polygon) {
  return {shell.body, shell.shell, number_of(shell, polygon), -1};
}

/// "3, 4 and 7": at most four, then how many more.
std::string numbers_of(const JudgedShell& shell, const ShellEdges& all, const EdgeGroup& group) {
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
  for (const EdgeGroup& group : all.groups)
    for (std::size_t i = group.from + 1; i < group.to; ++i)
      pieces.unite(all.edges[group.from].polygon, all.edges[i].polygon);
  return pieces;
}

/// Polygons in one of two turns: node 2p is polygon p as it is, 2p + 1 turned. Neighbours that run
/// against each other agree as they are.
DisjointSets turns_of(const JudgedShell& shell, const ShellEdges& all) {
  DisjointSets turns(2 * shell.polygons.size());
  for (const EdgeGroup& group : all.groups) {
    if (group.size() != 2) continue;
    const ShellEdge& p = all.edges[group.from];
    const ShellEdge& q = all.edges[group.from + 1];
    const int is_odd = p.is_rising == q.is_rising ? 1 : 0;
    turns.unite(2 * p.polygon, 2 * q.polygon + is_odd);
    turns.unite(2 * p.polygon + 1, 2 * q.polygon + 1 - is_odd);
  }
  return turns;
}

}  // namespace

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

bool are_edges_manifold(const JudgedShell& shell, const ShellEdges& all, FindingList& findings) {
  bool is_good = true;
  for (const EdgeGroup& group : all.groups) {
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

bool are_turned_alike(const JudgedShell& shell, const ShellEdges& all, FindingList& findings) {
  const auto runs_along = [&](const EdgeGroup& group) {
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
      findings.add(Defect::polygon_turned, subject_of(shell, p),
                   fmt::format("polygon {} runs the other way round than its neighbours",
                               number_of(shell, p)),
                   {shell.polygons[at(p)].polygon->rings[0][0]});
  return false;
}

bool are_vertices_manifold(const JudgedShell& shell, FindingList& findings) {
  // A corner is a polygon at a vertex; a polygon may come to a vertex by several rings, whose
  // corners count by themselves. Corners on both sides of an edge belong together.
  struct Corner {
    int vertex;
    int before;
    int after;
    int polygon;
  };
  std::vector<Corner> corners;
  for (int p = 0; p < std::ssize(shell.polygons); ++p)
    for (const auto& ring : shell.polygons[at(p)].polygon->rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        corners.push_back(
            {ring[i], ring[(i + ring.size() - 1) % ring.size()], ring[(i + 1) % ring.size()], p});
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
                 fmt::format("{} polygons, polygon {} one of them, are not joined to the rest of "
                             "the shell by edges",
                             size, number_of(shell, first)),
                 {shell.polygons[at(first)].polygon->rings[0][0]});
  }
  return false;
}

bool is_closed(const JudgedShell& shell, const ShellEdges& all, FindingList& findings) {
  std::vector<const ShellEdge*> open;
  for (const EdgeGroup& group : all.groups)
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
                 fmt::format("not closed: {} open edges hang together, the first one of polygon {}",
                             size, number_of(shell, edge.polygon)),
                 {edge.low, edge.high});
  }
  return false;
}

}  // namespace oriel::detail
