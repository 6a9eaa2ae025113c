#include "kernel/mesh/to_solid.h"

#include "kernel/base/index.h"

#include <algorithm>

namespace oriel {

namespace {

/// Of each shell of the mesh the number that its polygons have: 0, or of cavities 1, 2…
std::vector<int> shell_numbers(const Mesh& mesh) {
  std::vector<double> volumes(at(mesh.findings().shells));
  for (int f = 0; f < mesh.faces(); ++f) {
    const std::vector<int> corners = mesh.corners(f);
    const Vec3 first = mesh.point(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      volumes[at(mesh.shell(f))] +=
          dot(first, cross(mesh.point(corners[i]), mesh.point(corners[i + 1])));
  }
  std::vector<int> numbers;
  int cavities = 0;
  for (const double volume : volumes) numbers.push_back(volume < 0 ? ++cavities : 0);
  return numbers;
}

}  // namespace

Solidified to_solid(const Mesh& mesh, const Tolerances& tolerances, const RepairOptions& repair) {
  Building building;
  building.id = "mesh";
  building.is_solid = mesh.findings().open_edges == 0;
  for (int v = 0; v < mesh.originals(); ++v) building.vertices.push_back(mesh.point(v));
  // Facets turned inside out as a whole are no cavity: nothing is around them.
  std::vector<int> shells;
  if (building.is_solid) shells = shell_numbers(mesh);
  const bool has_body = std::ranges::find(shells, 0) != shells.end();
  for (int f = 0; f < mesh.faces(); ++f)
    building.polygons.push_back(
        {{mesh.ring(f)}, f, 0, has_body ? shells[at(mesh.shell(f))] : 0, mesh.surface(f)});
  return solidify(building, tolerances, repair);
}

}  // namespace oriel
