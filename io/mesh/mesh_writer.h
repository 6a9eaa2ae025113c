#pragma once

#include "io/document.h"
#include "kernel/mesh/mesh.h"
#include "model/labelled_building.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// Appends the buildings of `document` with their labels, in the input's coordinates:
/// LabelledBuilding::geometry where it is set, else the polygons that were read. Buildings without
/// labels come too. A feature is named by its label: FeatureLabel::label of an installation or a
/// surface, else the surface's type ("WallSurface" is "wall"), else "unlabelled"; and by
/// FeatureLabel::id or the installation's id. Faces without three distinct vertices are left out. A
/// CityJSONSeq is gathered by calling this for each record.
void append_mesh(MeshSource& mesh, const Document& document,
                 const std::vector<LabelledBuilding>& labelled);

/// The same for one building. `colours` are those of its polygons by Polygon::source
/// (material_colours). A facet has the colour that most of its polygons have; one without any, as
/// oriel makes them, the colour that most facets of its semantic surface's type have.
void append_building(MeshSource& mesh, const Building& building, const LabelledBuilding& labels,
                     const FaceColours& colours = {});

/// Wavefront OBJ: an `o` for each building, a `g label_id` for each feature. Faces with holes are
/// triangulated, others stay as they are. Numbers read back to the same doubles.
std::string write_obj(const MeshSource& mesh);

/// OFF, without the labels. Faces with holes and faces that are not convex are triangulated.
/// Numbers read back to the same doubles.
std::string write_off(const MeshSource& mesh);

/// ASCII PLY: faces as for OBJ, each with the number of its feature, whose name stands in a comment
/// of the header: `comment feature 3 house window_w12`. Numbers read back to the same doubles.
std::string write_ply(const MeshSource& mesh);

/// What the solids of an STL are called by: the labels ("window"), or the classes of the semantic
/// surfaces ("WallSurface"; "Unclassified" without one).
enum class StlSolids { by_label, by_class };

/// ASCII STL, all triangles, one `solid` for each label or class. Numbers read back to the same
/// doubles (binary STL has floats, which lose the centimetres of UTM coordinates).
std::string write_stl(const MeshSource& mesh, StlSolids solids = StlSolids::by_label);

}  // namespace oriel
