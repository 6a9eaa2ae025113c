#pragma once

#include "kernel/mesh/mesh.h"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

namespace oriel {

namespace detail {

/// OpenMesh's points are floats unless one says so.
struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

inline Vec3 vec3_of(const OpenMesh::Vec3d& p) { return {p[0], p[1], p[2]}; }
inline OpenMesh::Vec3d openmesh_of(Vec3 p) { return {p.x, p.y, p.z}; }

}  // namespace detail

struct Mesh::HalfEdges {
  HalfEdges();

  detail::PolyMesh mesh;
  OpenMesh::FPropHandleT<int> facet, feature;
  /// Numbers in `names`.
  OpenMesh::FPropHandleT<int> label, surface;
  OpenMesh::FPropHandleT<int> shell;
  /// The point of the source at the half-edge's end, as the ring of its face has it.
  OpenMesh::HPropHandleT<int> source;
  OpenMesh::VPropHandleT<int> original;

  int originals = 0;
  std::vector<std::string> names;
  std::vector<MeshFeature> features;
  MeshFindings findings;
};

}  // namespace oriel
