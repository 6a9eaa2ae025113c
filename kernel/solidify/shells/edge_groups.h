#pragma once

#include "kernel/solidify/shells/shell_mesh.h"
#include "model/description/counting_sort.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// The half-edges of one edge, in ascending order.
using EdgeGroup = std::span<const int>;

/// The half-edges of a soup grouped by body and undirected edge.
class EdgeGroups {
 public:
  /// Needs the mesh's `next` and `polygon_of`.
  EdgeGroups(const Soup& soup, const ShellMesh& mesh);

  /// Visits every group, sorted by their points, then by body.
  template <class Visit>
  void for_each(Visit visit) const {
    const EdgeGroup all = half_edges_;
    if (all.empty()) return;
    EdgeEnds ends = ends_of(all[0]), following = ends;
    for (std::size_t start = 0; start < all.size(); ends = following) {
      std::size_t end = start + 1;
      while (end < all.size() && (following = ends_of(all[end])) == ends &&
             (!has_bodies_ || body_of(all[end]) == body_of(all[start])))
        ++end;
      visit(all.subspan(start, end - start));
      start = end;
    }
  }

  /// The points of a half-edge.
  [[nodiscard]] EdgeEnds ends_of(int half_edge) const {
    const auto h = static_cast<std::size_t>(half_edge);
    return {soup_->corners[h], soup_->corners[static_cast<std::size_t>(mesh_->next[h])]};
  }
  [[nodiscard]] int body_of(int half_edge) const {
    const int polygon = mesh_->polygon_of[static_cast<std::size_t>(half_edge)];
    return soup_->polygons[static_cast<std::size_t>(polygon)].body;
  }

 private:
  const Soup* soup_;
  const ShellMesh* mesh_;
  bool has_bodies_;  ///< more than one
  Numbers half_edges_;
};

/// Which polygons must be turned round so that the two half-edges of every edge with two run
/// against each other. Nothing if there is no such choice. Each connected patch keeps the
/// orientation of most of its polygons.
std::optional<std::vector<char>> polygons_to_turn(const Soup& soup, const ShellMesh& mesh,
                                                  const EdgeGroups& groups);

/// Pairs the half-edges of one edge so that each pair encloses material: going round the edge,
/// material begins at one that runs down it and ends at the next one, which runs up. False if they
/// do not alternate.
bool pair_around(const Soup& soup, const EdgeGroup& group, ShellMesh& mesh);

}  // namespace oriel::detail
