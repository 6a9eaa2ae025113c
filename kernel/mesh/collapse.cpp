#include "kernel/mesh/collapse.h"

#include "kernel/base/index.h"
#include "kernel/mesh/half_edges.h"

#include <algorithm>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

namespace oriel {

namespace {

using TriMesh = OpenMesh::TriMesh_ArrayKernelT<detail::DoubleTraits>;

/// A triangle mesh, and of each face the one of the mesh it was made from.
struct Triangles {
  TriMesh mesh;
  OpenMesh::FPropHandleT<int> source;

  explicit Triangles(const Mesh& from) {
    mesh.add_property(source);
    mesh.request_face_status();
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    mesh.request_vertex_status();
    mesh.request_face_normals();
    for (int v = 0; v < from.vertices(); ++v) mesh.add_vertex(detail::openmesh_of(from.point(v)));
    for (int f = 0; f < from.faces(); ++f) {
      const std::vector<int> corners = from.corners(f);
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const auto face =
            mesh.add_face(OpenMesh::VertexHandle(corners[0]), OpenMesh::VertexHandle(corners[i]),
                          OpenMesh::VertexHandle(corners[i + 1]));
        mesh.property(source, face) = f;
      }
    }
    mesh.update_face_normals();
  }
};

void collapse(TriMesh& mesh, int triangles) {
  using Decimater = OpenMesh::Decimater::DecimaterT<TriMesh>;
  Decimater decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<TriMesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to_faces(0, at(std::max(triangles, 0)));
  mesh.garbage_collection();
  mesh.update_face_normals();
}

}  // namespace

Mesh collapse_edges(const Mesh& mesh, int triangles) {
  Triangles work(mesh);
  collapse(work.mesh, triangles);
  MeshSource source;
  source.features = mesh.features();
  for (const auto vertex : work.mesh.vertices())
    source.points.push_back(detail::vec3_of(work.mesh.point(vertex)));
  for (const auto face : work.mesh.faces()) {
    std::vector<int> ring;
    for (const auto vertex : work.mesh.fv_range(face)) ring.push_back(vertex.idx());
    const int from = work.mesh.property(work.source, face);
    source.polygons.push_back({{std::move(ring)},
                               detail::vec3_of(work.mesh.normal(face)),
                               mesh.feature(from),
                               mesh.surface(from),
                               mesh.facet(from)});
  }
  return Mesh(source);
}

}  // namespace oriel
