#include "kernel/attach/new_facet.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <utility>

namespace oriel::detail {

namespace {

PlaneId plane_id(Solid& solid, const Plane& plane) {
  for (int p = 0; p < std::ssize(solid.planes); ++p)
    if (solid.planes[at(p)].offset == plane.offset &&
        solid.planes[at(p)].coefficients == plane.coefficients)
      return {p};
  solid.planes.push_back(plane);
  return {static_cast<int>(solid.planes.size()) - 1};
}

}  // namespace

FacetId add_facet(Solid& solid, const Plane& plane, Loop loop, FacetId beside) {
  const FacetId id{static_cast<int>(solid.facets.size())};
  solid.facets.push_back({plane_id(solid, plane), {std::move(loop)}, {}});
  for (Shell& shell : solid.shells)
    if (std::ranges::find(shell.facets, beside) != shell.facets.end()) {
      shell.facets.push_back(id);
      break;
    }
  return id;
}

}  // namespace oriel::detail
