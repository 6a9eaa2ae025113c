#pragma once

#include "kernel/io/document.h"
#include "kernel/model/labelled_building.h"
#include "kernel/model/vec3.h"

#include <string>
#include <vector>

namespace oriel {

/// The faces of one feature, or of one class where the labels name no feature.
struct MeshGroup {
  std::string building;
  /// "window", "wall"…: `oriel_label` of an installation or a surface, else the surface's type
  /// ("WallSurface" is "wall"), else "unlabelled".
  std::string label;
  /// `oriel_id`, or the installation's id, or empty.
  std::string id;
};

/// A planar face, ring 0 the outer one.
struct MeshFace {
  std::vector<std::vector<int>> rings;
  Vec3 normal;
  /// Index into LabelledMesh::groups.
  int group = 0;
  /// The type of its semantic surface, "WallSurface"; empty: none.
  std::string surface_class{};
};

/// Labelled buildings as mesh formats have them: points in the input's coordinates, in metres.
struct LabelledMesh {
  std::vector<Vec3> vertices;
  std::vector<MeshFace> faces;
  std::vector<MeshGroup> groups;
};

/// Appends the buildings of `document` with their labels: LabelledBuilding::geometry where it is
/// set, else the polygons that were read. Buildings without labels come too. Faces without three
/// distinct vertices are left out. A CityJSONSeq is gathered by calling this for each record.
void append_mesh(LabelledMesh& mesh, const Document& document,
                 const std::vector<LabelledBuilding>& labelled);

/// Wavefront OBJ: an `o` for each building, a `g label_id` for each group. Faces with holes are
/// triangulated, others stay as they are. Numbers read back to the same doubles.
std::string write_obj(const LabelledMesh& mesh);

/// OFF, without the labels. Faces with holes and faces that are not convex are triangulated.
/// Numbers read back to the same doubles.
std::string write_off(const LabelledMesh& mesh);

/// What the solids of an STL are called by: the labels ("window"), or the classes of the semantic
/// surfaces ("WallSurface"; "Unclassified" without one).
enum class StlSolids { by_label, by_class };

/// ASCII STL, all triangles, one `solid` for each label or class. Numbers read back to the same
/// doubles (binary STL has floats, which lose the centimetres of UTM coordinates).
std::string write_stl(const LabelledMesh& mesh, StlSolids solids = StlSolids::by_label);

}  // namespace oriel
