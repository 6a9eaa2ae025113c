/// Generalises the buildings of some files to a scale and, for comparison, collapses the edges of
/// their triangle meshes (Garland and Heckbert 1997: CGAL, which places vertices anew, and
/// OpenMesh, which keeps some) to as many triangles. One row a method, as Markdown:
/// docs/results.md. `bench_collapse SCALE INPUT…`; bench/collapse.sh runs it.
#include "kernel/mesh/collapse.h"

#include "bench/timing.h"
#include "generalise/generalise.h"
#include "interpret/plan/plan.h"
#include "io/reader.h"
#include "kernel/base/index.h"
#include "kernel/mesh/measures.h"
#include "kernel/validate/validate.h"
#include "oriel/drawing/targets.h"
#include "oriel/label.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

namespace {

using namespace oriel;
namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr std::size_t kCalls = 3;
/// Angles are right, and facets in one plane, to this.
constexpr double kSameAngle_deg = 0.5;

/// A triangle mesh as a building, to be judged.
Building building_of(const Mesh& mesh) {
  Building building;
  for (int v = 0; v < mesh.originals(); ++v) building.vertices.push_back(mesh.point(v));
  for (int f = 0; f < mesh.faces(); ++f) building.polygons.push_back({{mesh.ring(f)}, f, 0, 0, {}});
  return building;
}

/// How many edges that are no seams in a plane there are, and how many of them at a right angle.
std::pair<int, int> right_angles(const Mesh& mesh) {
  std::pair<int, int> counts{0, 0};
  for (const FeatureEdge& edge : feature_edges(mesh, kSameAngle_deg)) {
    if (edge.is_open) continue;
    ++counts.first;
    if (std::abs(std::abs(edge.dihedral_deg) - 90) < kSameAngle_deg) ++counts.second;
  }
  return counts;
}

/// The mesh for CGAL. Needs one without open edges.
Surface surface_of(const Mesh& mesh) {
  Surface surface;
  for (int v = 0; v < mesh.vertices(); ++v) {
    const Vec3 p = mesh.point(v);
    surface.add_vertex({p.x, p.y, p.z});
  }
  for (int f = 0; f < mesh.faces(); ++f) {
    std::vector<Surface::Vertex_index> corners;
    for (const int v : mesh.corners(f)) corners.emplace_back(static_cast<std::uint32_t>(v));
    surface.add_face(corners);
  }
  return surface;
}

Surface collapsed(Surface surface, std::size_t triangles) {
  const sms::GarlandHeckbert_plane_policies<Surface, Kernel> policies(surface);
  // A closed mesh of T triangles has 3 T / 2 edges.
  const double ratio =
      static_cast<double>(3 * triangles) / (2 * static_cast<double>(surface.number_of_edges()));
  const sms::Count_ratio_stop_predicate<Surface> stop(std::min(ratio, 1.0));
  sms::edge_collapse(
      surface, stop,
      CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  surface.collect_garbage();
  return surface;
}

Mesh mesh_of(const Surface& surface) {
  MeshSource source;
  for (const auto v : surface.vertices()) {
    const auto& p = surface.point(v);
    source.points.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : surface.faces()) {
    std::vector<int> ring;
    for (const auto v : vertices_around_face(surface.halfedge(f), surface))
      ring.push_back(static_cast<int>(v.idx()));
    const auto p = [&](std::size_t i) { return source.points[at(ring[i])]; };
    const Vec3 normal = normalised(cross(p(1) - p(0), p(2) - p(0)));
    source.polygons.push_back({{std::move(ring)}, normal});
  }
  return Mesh(source);
}

/// Sums over the buildings.
struct Row {
  std::string name;
  int buildings = 0, valid = 0, edges = 0, right = 0;
  std::size_t triangles = 0;
  std::vector<double> hausdorff_m{}, ms{};

  void add(const Mesh& before, const Mesh& after, double time_ms) {
    ++buildings;
    triangles += at(after.faces());
    ValidateOptions options;
    options.primitive = ValidateOptions::Primitive::solid;
    valid += validate(building_of(after), options).empty() ? 1 : 0;
    const auto [all, right_ones] = right_angles(after);
    edges += all;
    right += right_ones;
    hausdorff_m.push_back(oriel::hausdorff_m(before, after));
    ms.push_back(time_ms);
  }

  void print() {
    const auto median = [](std::vector<double>& values) {
      std::ranges::sort(values);
      return values[values.size() / 2];
    };
    const double largest_m = *std::ranges::max_element(hausdorff_m);
    fmt::print("| {} | {} | {} of {} | {:.1f} % | {:.2f} | {:.2f} | {:.2f} |\n", name, triangles,
               valid, buildings, 100.0 * right / std::max(edges, 1), median(hausdorff_m), largest_m,
               median(ms));
  }
};

struct Rows {
  Row input{"input"}, ours{"oriel"}, cgal{"edge collapse (CGAL)"},
      openmesh{"edge collapse (OpenMesh)"};
};

void compare(const Building& building, const RuleBase& rules, double scale, Rows& rows) {
  const PipelineResult labelled = label(building, rules);
  if (!labelled.is_done() || labelled.is_open()) return;
  const Solid& solid = *labelled.solid;
  const Mesh before = to_mesh(solid);
  if (before.findings().non_manifold_edges > 0 || before.findings().doubled_vertices > 0) return;
  const Surface surface = surface_of(before);
  const auto& [table, graph, issues] = labelled.description;
  const Plan asked = plan(rules, table, graph, labelled.interpretation, scale);
  Checked<Generalised> made;
  const double ours_ms = bench::cpu_ms_of(kCalls, [&] {
    made = generalise(redraw_context(building, labelled, labelled.output), asked);
  });
  if (!made.value) return;
  const Mesh after = to_mesh(made.value->solid);
  Surface less;
  const double cgal_ms =
      bench::cpu_ms_of(kCalls, [&] { less = collapsed(surface, at(after.faces())); });
  Mesh decimated;
  const double openmesh_ms =
      bench::cpu_ms_of(kCalls, [&] { decimated = collapse_edges(before, after.faces()); });
  rows.input.add(before, before, 0);
  rows.ours.add(before, after, ours_ms);
  rows.cgal.add(before, mesh_of(less), cgal_ms);
  rows.openmesh.add(before, decimated, openmesh_ms);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: bench_collapse SCALE INPUT...\n");
    return 2;
  }
  const auto rules = load_pack_file("residential");
  Rows rows;
  for (int i = 2; i < argc; ++i) {
    Reader reader(argv[i]);
    while (auto record = reader.next()) {
      if (!record->value) continue;
      for (const Building& building : record->value->buildings)
        compare(building, *rules.value, std::stod(argv[1]), rows);
    }
  }
  if (rows.input.buildings == 0) {
    fmt::print(stderr, "bench_collapse: no manifold solid\n");
    return 1;
  }
  fmt::print("| 1:{} | triangles | valid | edges at 90° | Hausdorff m, median | largest | ms |\n",
             argv[1]);
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (Row* row : {&rows.input, &rows.ours, &rows.cgal, &rows.openmesh}) row->print();
}
