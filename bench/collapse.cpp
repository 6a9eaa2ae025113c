/// Generalises the buildings of some files to a scale and, beside it, collapses the edges of their
/// triangle meshes (CGAL, Garland and Heckbert 1997) to as many triangles. One row a method, as
/// Markdown: docs/results.md. `bench_collapse SCALE INPUT…`; bench/collapse.sh runs it.
#include "bench/timing.h"
#include "generalise/generalise.h"
#include "interpret/plan/plan.h"
#include "kernel/base/index.h"
#include "kernel/io/reader.h"
#include "kernel/mesh/hausdorff.h"
#include "kernel/mesh/triangulate.h"
#include "kernel/validate/validate.h"
#include "oriel/label.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
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
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr std::size_t kCalls = 3;
/// Angles are right, and facets in one plane, to this.
constexpr double kSameAngle_deg = 0.5;

/// Triangles with shared vertices.
struct Triangles {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> corners;
};

Vec3 normal_of(const Triangles& mesh, const std::array<int, 3>& t) {
  const Vec3 p = mesh.points[at(t[0])];
  return normalised(cross(mesh.points[at(t[1])] - p, mesh.points[at(t[2])] - p));
}

Triangles triangles_of(const Solid& solid) {
  Triangles mesh;
  for (const Vertex& vertex : solid.vertices) mesh.points.push_back(vertex.point);
  for (const Facet& facet : solid.facets)
    for (const auto& t :
         detail::triangulate(mesh.points, facet.loops, solid.planes[facet.plane.index()].normal))
      mesh.corners.push_back(t);
  return mesh;
}

Building building_of(const Triangles& mesh) {
  Building building;
  building.vertices = mesh.points;
  for (const auto& t : mesh.corners)
    building.polygons.push_back(
        {{{t[0], t[1], t[2]}}, static_cast<int>(building.polygons.size()), 0, 0, {}});
  return building;
}

/// For distances only.
Solid solid_of(const Triangles& mesh) {
  Solid solid;
  for (const Vec3 p : mesh.points) solid.vertices.push_back({p, false});
  for (const auto& t : mesh.corners) {
    solid.facets.push_back(
        {PlaneId{static_cast<int>(solid.planes.size())}, {{t[0], t[1], t[2]}}, {}});
    Plane plane;
    plane.normal = normal_of(mesh, t);
    solid.planes.push_back(plane);
  }
  return solid;
}

/// How many edges that are no seams in a plane there are, and how many of them at a right angle.
std::pair<int, int> right_angles(const Triangles& mesh) {
  std::map<std::pair<int, int>, std::size_t> triangle_at;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      triangle_at[{mesh.corners[i][k], mesh.corners[i][(k + 1) % 3]}] = i;
  const double tolerance = std::sin(kSameAngle_deg * 3.14159265358979323846 / 180);
  std::pair<int, int> counts{0, 0};
  for (const auto& [edge, triangle] : triangle_at) {
    const auto other = triangle_at.find({edge.second, edge.first});
    if (edge.first > edge.second || other == triangle_at.end()) continue;
    const Vec3 n = normal_of(mesh, mesh.corners[triangle]);
    const Vec3 m = normal_of(mesh, mesh.corners[other->second]);
    if (length(cross(n, m)) < tolerance && dot(n, m) > 0) continue;
    ++counts.first;
    if (std::abs(dot(n, m)) < tolerance) ++counts.second;
  }
  return counts;
}

/// The mesh of a solid; empty if it is no manifold.
Mesh manifold_of(const Triangles& triangles) {
  Mesh mesh;
  for (const Vec3 p : triangles.points) mesh.add_vertex({p.x, p.y, p.z});
  for (const auto& t : triangles.corners) {
    const auto v = [&](std::size_t i) {
      return Mesh::Vertex_index(static_cast<std::uint32_t>(t[i]));
    };
    if (mesh.add_face(v(0), v(1), v(2)) == Mesh::null_face()) return {};
  }
  return mesh;
}

Mesh collapsed(Mesh mesh, std::size_t triangles) {
  const sms::GarlandHeckbert_plane_policies<Mesh, Kernel> policies(mesh);
  // A closed mesh of T triangles has 3 T / 2 edges.
  const double ratio =
      static_cast<double>(3 * triangles) / (2 * static_cast<double>(mesh.number_of_edges()));
  const sms::Count_ratio_stop_predicate<Mesh> stop(std::min(ratio, 1.0));
  sms::edge_collapse(
      mesh, stop,
      CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  mesh.collect_garbage();
  return mesh;
}

Triangles triangles_of(const Mesh& mesh) {
  Triangles out;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    out.points.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : mesh.faces()) {
    std::array<int, 3> t{};
    std::size_t i = 0;
    for (const auto v : vertices_around_face(mesh.halfedge(f), mesh))
      t[i++] = static_cast<int>(v.idx());
    out.corners.push_back(t);
  }
  return out;
}

/// Sums over the buildings.
struct Row {
  std::string name;
  int buildings = 0, valid = 0, edges = 0, right = 0;
  std::size_t triangles = 0;
  std::vector<double> hausdorff_m{}, ms{};

  void add(const Solid& before, const Triangles& after, double time_ms) {
    ++buildings;
    triangles += after.corners.size();
    ValidateOptions options;
    options.primitive = ValidateOptions::Primitive::solid;
    valid += validate(building_of(after), options).empty() ? 1 : 0;
    const auto [all, right_ones] = right_angles(after);
    edges += all;
    right += right_ones;
    hausdorff_m.push_back(oriel::hausdorff_m(before, solid_of(after)));
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

void compare(const Building& building, const RuleBase& rules, double scale, Row& input, Row& ours,
             Row& theirs) {
  const PipelineResult labelled = label(building, rules);
  if (!labelled.is_done() || labelled.is_open) return;
  const Solid& solid = *labelled.solid;
  const Triangles before = triangles_of(solid);
  const Mesh mesh = manifold_of(before);
  if (mesh.number_of_faces() == 0) return;
  const auto& [table, graph] = labelled.description;
  const Plan asked = plan(rules, table, graph, labelled.interpretation, scale);
  Checked<Generalised> made;
  const double ours_ms = bench::cpu_ms_of(kCalls, [&] {
    made = generalise(solid, *labelled.segmentation, table, labelled.interpretation, asked);
  });
  if (!made.value) return;
  const Triangles after = triangles_of(made.value->solid);
  Mesh less;
  const double theirs_ms =
      bench::cpu_ms_of(kCalls, [&] { less = collapsed(mesh, after.corners.size()); });
  input.add(solid, before, 0);
  ours.add(solid, after, ours_ms);
  theirs.add(solid, triangles_of(less), theirs_ms);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: bench_collapse SCALE INPUT...\n");
    return 2;
  }
  const auto rules = load_pack_file("residential");
  Row input{"input"}, ours{"oriel"}, theirs{"edge collapse"};
  for (int i = 2; i < argc; ++i) {
    Reader reader(argv[i]);
    while (auto record = reader.next()) {
      if (!record->value) continue;
      for (const Building& building : record->value->buildings)
        compare(building, *rules.value, std::stod(argv[1]), input, ours, theirs);
    }
  }
  if (input.buildings == 0) {
    fmt::print(stderr, "bench_collapse: no manifold solid\n");
    return 1;
  }
  fmt::print("| 1:{} | triangles | valid | edges at 90° | Hausdorff m, median | largest | ms |\n",
             argv[1]);
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (Row* row : {&input, &ours, &theirs}) row->print();
}
