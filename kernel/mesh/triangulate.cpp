#include "kernel/mesh/triangulate.h"

#include "kernel/base/index.h"

#include <cmath>
#include <deque>
#include <map>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace oriel {

namespace {

using TriangulationKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, TriangulationKernel>;
/// The info of a face is how many edges of rings lie between it and the outside, -1 if unknown.
using FaceBase = CGAL::Triangulation_face_base_with_info_2<
    int, TriangulationKernel, CGAL::Constrained_triangulation_face_base_2<TriangulationKernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<
    TriangulationKernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// The point seen along the axis nearest to the normal, against it, so that orientation is kept.
TriangulationKernel::Point_2 projected(Vec3 p, Vec3 normal) {
  const double x = std::abs(normal.x);
  const double y = std::abs(normal.y);
  const double z = std::abs(normal.z);
  if (z >= x && z >= y)
    return normal.z >= 0 ? TriangulationKernel::Point_2(p.x, p.y)
                         : TriangulationKernel::Point_2(p.y, p.x);
  if (x >= y)
    return normal.x >= 0 ? TriangulationKernel::Point_2(p.y, p.z)
                         : TriangulationKernel::Point_2(p.z, p.y);
  return normal.y >= 0 ? TriangulationKernel::Point_2(p.z, p.x)
                       : TriangulationKernel::Point_2(p.x, p.z);
}

/// Inserts the rings; false if two of their edges cross.
bool insert_rings(Cdt& cdt, const std::vector<Vec3>& points,
                  const std::vector<std::vector<int>>& rings, Vec3 normal) {
  std::map<int, Cdt::Vertex_handle> handles;
  for (const auto& ring : rings)
    for (const int v : ring) {
      if (handles.contains(v)) continue;
      const std::size_t before = cdt.number_of_vertices();
      const auto handle = cdt.insert(projected(points[static_cast<std::size_t>(v)], normal));
      if (cdt.number_of_vertices() > before) handle->info() = v;
      handles.emplace(v, handle);
    }
  try {
    for (const auto& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const auto from = handles.at(ring[i]);
        const auto to = handles.at(ring[(i + 1) % ring.size()]);
        if (from != to) cdt.insert_constraint(from, to);
      }
  } catch (const Cdt::Intersection_of_constraints_exception&) {
    return false;
  }
  return true;
}

/// Numbers the faces by how many constraints lie between them and the outside.
void number_faces(Cdt& cdt) {
  for (const auto face : cdt.all_face_handles()) face->info() = -1;
  std::deque<std::pair<Cdt::Face_handle, int>> queue{{cdt.infinite_face(), 0}};
  while (!queue.empty()) {
    const auto [face, number] = queue.front();
    queue.pop_front();
    if (face->info() >= 0) continue;
    face->info() = number;
    for (int i = 0; i < 3; ++i) {
      // Faces of the same number come first: those behind an edge wait.
      if (cdt.is_constrained({face, i}))
        queue.emplace_back(face->neighbor(i), number + 1);
      else
        queue.emplace_front(face->neighbor(i), number);
    }
  }
}

std::vector<std::array<int, 3>> fan(const std::vector<int>& ring) {
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    triangles.push_back({ring[0], ring[i], ring[i + 1]});
  return triangles;
}

/// A quadrangle that turns left at each corner.
bool is_convex_quadrangle(const std::vector<Vec3>& points, const std::vector<int>& ring,
                          Vec3 normal) {
  constexpr std::size_t kCorners = 4;
  if (ring.size() != kCorners) return false;
  for (std::size_t i = 0; i < kCorners; ++i) {
    const Vec3 p = points[at(ring[i])], q = points[at(ring[(i + 1) % kCorners])],
               r = points[at(ring[(i + 2) % kCorners])];
    if (dot(cross(q - p, r - q), normal) <= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<int, 3>> triangulate(const std::vector<Vec3>& points,
                                            const std::vector<std::vector<int>>& rings,
                                            Vec3 normal) {
  if (rings.empty()) return {};
  if (rings.size() == 1 && rings[0].size() == 3) return fan(rings[0]);
  Cdt cdt;
  if (!insert_rings(cdt, points, rings, normal)) return fan(rings[0]);
  if (cdt.dimension() < 2) return {};
  number_faces(cdt);
  std::vector<std::array<int, 3>> triangles;
  for (const auto face : cdt.finite_face_handles())
    if (face->info() % 2 == 1)
      triangles.push_back(
          {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

std::vector<std::array<int, 3>> triangulate_quickly(const std::vector<Vec3>& points,
                                                    const std::vector<std::vector<int>>& rings,
                                                    Vec3 normal) {
  if (rings.size() == 1 && is_convex_quadrangle(points, rings[0], normal)) return fan(rings[0]);
  return triangulate(points, rings, normal);
}

}  // namespace oriel
