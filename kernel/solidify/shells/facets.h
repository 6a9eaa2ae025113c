#pragma once

#include "kernel/solidify/planes/plane_clusters.h"
#include "kernel/solidify/shells/shell_mesh.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// The facets of a closed shell mesh: connected polygons of one oriented plane, their loops over
/// mesh vertices. Facets count from 0 in the order of their first polygons.
struct FacetDraft {
  /// The facet of every polygon of the soup.
  Numbers facet_of;
  /// Of every facet its plane and its connected component (shell); components count from 0.
  Numbers plane;
  Numbers component;
  int components = 0;
  /// Of every facet its first loop, of every loop its first vertex; one entry more at the end.
  Numbers first_loop;
  Numbers first_vertex;
  /// The vertices of all loops, loop after loop, facet after facet.
  Numbers vertices;

  [[nodiscard]] std::size_t facet_count() const { return plane.size(); }
  [[nodiscard]] std::size_t loop_count() const { return first_vertex.size() - 1; }
  [[nodiscard]] std::span<int> loop(std::size_t l) {
    return {vertices.data() + first_vertex[l], vertices.data() + first_vertex[l + 1]};
  }
  [[nodiscard]] std::span<const int> loop(std::size_t l) const {
    return {vertices.data() + first_vertex[l], vertices.data() + first_vertex[l + 1]};
  }
};

/// Grows facets over the mesh and walks their loops. Vertices at which only two facets meet lie on
/// a straight edge and are left out, unless a loop would keep fewer than three.
/// Polygons for which `is_apart` is 1 make facets of their own, without the others in their plane;
/// empty: none.
FacetDraft draft_facets(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& mesh,
                        std::span<const char> is_apart = {});

}  // namespace oriel::detail
