#pragma once

#include "io/gltf/flat_mesh.h"
#include "kernel/mesh/mesh.h"
#include "model/vec3.h"

#include <set>
#include <string>

namespace oriel {

/// What gives faces their colour. Faces whose feature has none of its own (FlatFeature::colour)
/// have that of their surface if it is by material.
enum class GlbColours { by_label, by_surface, by_material, none };

/// How vertices and indices are stored.
enum class GlbCompression {
  none,
  meshopt  ///< by EXT_meshopt_compression, which loses nothing
};

/// How a GLB is written.
struct GlbOptions {
  GlbColours colours = GlbColours::by_label;
  /// The edges of the polygons come as lines, too.
  bool has_outlines = false;
  GlbCompression compression = GlbCompression::none;
  /// Labels and types of surfaces that the enumerations name besides those of the mesh, so that
  /// several files have the same ones.
  std::set<std::string> labels{};
  std::set<std::string> surfaces{};
};

/// A binary glTF 2.0 file of one mesh, y up as glTF wants it, with a translation of its node by
/// `translation_m` (z up). Every vertex has its feature as `_FEATURE_ID_0` (EXT_mesh_features), a
/// row of a property table (EXT_structural_metadata) with `building`, `id`, `label` and `surface`
/// (enumerations, sorted by name), `score` (-1: none), `rule` and `height`. Transparent triangles
/// are a primitive of their own, behind the others. A mesh without
/// triangles is a file with an empty scene. The same mesh gives the same bytes. Throws
/// std::length_error for a mesh with more than 2^24 features or 4 GB.
std::string write_glb(const FlatMesh& mesh, Vec3 translation_m, const GlbOptions& options = {});

/// The same of polygons in the coordinates of a file: points are taken from the middle of their
/// box, in whole metres, which is the translation of the node.
std::string write_glb(const MeshSource& source, const GlbOptions& options = {});

}  // namespace oriel
