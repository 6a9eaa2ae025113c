#pragma once

#include "kernel/model/detail/counting_sort.h"
#include "kernel/solidify/detail/shell_mesh.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// The half-edges of one edge: places are half-edges.
using EdgeGroup = std::span<const SortedEdge>;

/// The half-edges of a soup grouped by body and undirected edge.
class EdgeGroups {
 public:
  /// Needs the mesh's `next` and `polygon_of`.
  EdgeGroups(const Soup& soup, const ShellMesh& mesh);

  /// Visits every group, its half-edges in ascending order, sorted by their points, then by body.
  template <class Visit>
  void for_each(Visit visit) const {
    const EdgeGroup edges = edges_;
    for (std::size_t start = 0; start < edges.size();) {
      std::size_t end = start + 1;
      while (end < edges.size() && are_in_one_group(edges[start], edges[end])) ++end;
      visit(edges.subspan(start, end - start));
      start = end;
    }
  }

  [[nodiscard]] int body_of(const SortedEdge& edge) const {
    const auto polygon =
        static_cast<std::size_t>(mesh_->polygon_of[static_cast<std::size_t>(edge.place)]);
    return soup_->polygons[polygon].body;
  }

 private:
  [[nodiscard]] bool are_in_one_group(const SortedEdge& e, const SortedEdge& f) const {
    return e.has_ends_of(f) && body_of(e) == body_of(f);
  }

  const Soup* soup_;
  const ShellMesh* mesh_;
  std::vector<SortedEdge> edges_;
};

/// Which polygons must be turned round so that the two half-edges of every edge with two run
/// against each other; empty if none need be. Nothing if there is no such choice. Each connected
/// patch keeps the orientation of most of its polygons.
std::optional<std::vector<char>> polygons_to_turn(const Soup& soup, const ShellMesh& mesh,
                                                  const EdgeGroups& groups);

/// Pairs the half-edges of one edge so that each pair encloses material: going round the edge,
/// material begins at one that runs down it and ends at the next one, which runs up. False if they
/// do not alternate.
bool pair_around(const Soup& soup, const EdgeGroup& group, ShellMesh& mesh);

}  // namespace oriel::detail
