#pragma once

#include "kernel/model/solid.h"
#include "kernel/solidify/detail/plane_clusters.h"
#include "kernel/solidify/detail/shell_mesh.h"

#include <vector>

namespace oriel::detail {

/// The facets of a closed shell mesh: connected polygons of one oriented plane, their loops over
/// mesh vertices.
struct FacetDraft {
  std::vector<Facet> facets;
  /// The connected component (shell) of each facet; components count from 0.
  std::vector<int> component;
  int components = 0;
};

/// Grows facets over the mesh and walks their loops. Vertices at which only two facets meet lie on
/// a straight edge and are left out, unless a loop would keep fewer than three. Facet::polygons
/// holds source numbers.
FacetDraft draft_facets(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& shell);

}  // namespace oriel::detail
