#pragma once

#include "kernel/validate/solids/shell_checks.h"

#include <vector>

namespace oriel::detail {

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
struct EdgeGroup {
  std::size_t from;
  std::size_t to;
  [[nodiscard]] std::size_t size() const { return to - from; }
};

/// All edges of the polygons of a shell, sorted, and their groups.
struct ShellEdges {
  std::vector<ShellEdge> edges;
  std::vector<EdgeGroup> groups;
};

ShellEdges edges_of(const JudgedShell& shell);

/// val3dity 303: no more than two polygons meet at an edge.
bool are_edges_manifold(const JudgedShell& shell, const ShellEdges& all, FindingList& findings);

/// val3dity 307, of edges of at most two polygons: neighbours run along their edge in opposite
/// directions. Told of the polygons that are fewer in their piece, or once if no turning helps.
bool are_turned_alike(const JudgedShell& shell, const ShellEdges& all, FindingList& findings);

/// val3dity 303: around each vertex its polygons follow each other by edges in one cycle or row.
bool are_vertices_manifold(const JudgedShell& shell, FindingList& findings);

/// val3dity 305: edges join all polygons to one piece.
bool is_one_piece(const JudgedShell& shell, const ShellEdges& all, FindingList& findings);

/// val3dity 302: no edge is of one polygon only. Told once for each group of edges that hang
/// together.
bool is_closed(const JudgedShell& shell, const ShellEdges& all, FindingList& findings);

}  // namespace oriel::detail
