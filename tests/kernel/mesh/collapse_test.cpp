#include "kernel/mesh/collapse.h"

#include "kernel/mesh/measures.h"
#include "tests/kernel/mesh/meshes.h"

using namespace oriel;
using namespace oriel::test;

namespace {

Mesh wall_with_windows() {
  BoxBody body;
  body.add({0, 0, 0}, {10, 4, 6});
  for (const double x : {1.0, 3.0, 5.0, 7.0})
    for (const double z : {1.0, 3.5}) body.remove({x, 0, z}, {x + 1, 0.2, z + 1.5});
  return to_mesh(solid_of(body.build()));
}

}  // namespace

TEST_SUITE("kernel/mesh") {
  TEST_CASE("a closed mesh stays closed however far its edges are collapsed") {
    const Mesh mesh = wall_with_windows();
    const int before = mesh.faces();
    for (const int triangles : {before / 2, before / 4, 20, 4, 0}) {
      const Mesh less = collapse_edges(mesh, triangles);
      CHECK(measure(less).is_closed);
      CHECK(less.findings().non_manifold_edges == 0);
      CHECK(measure(less).euler == 2);
      CHECK(less.faces() >= 4);
      if (triangles >= 20) CHECK(less.faces() <= triangles);
    }
  }

  TEST_CASE("nothing is collapsed where there are few triangles enough") {
    const Mesh mesh = wall_with_windows();
    const Mesh same = collapse_edges(mesh, mesh.faces());
    CHECK(same.faces() == mesh.faces());
    CHECK(same.facet(7) == mesh.facet(7));
    CHECK(hausdorff_m(mesh, same) <= 0.001);
  }
}
