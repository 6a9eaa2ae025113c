#pragma once

#include "io/document.h"
#include "io/json/text.h"
#include "kernel/base/issue.h"
#include "model/vec3.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// Points and faces as a mesh file lists them, in the input's coordinates.
struct RawMesh {
  std::vector<Vec3> points;
  /// Numbers of points, from 0, all in range.
  std::vector<std::vector<int>> faces;
  /// Parallel to `faces`.
  std::vector<std::string> hints;
};

/// Reads an OBJ file: v, f (v, v/vt, v//vn, v/vt/vn, negative numbers), g, o and usemtl as hints;
/// vt, vn, vp, l, p, s and mtllib are passed over. E109 for anything else, E203 for a vertex that
/// is not there, E311 for a face of fewer than three points, E506 for a coordinate that is not
/// finite, each with its line and column. Reading stops after 20 findings.
Checked<Document> read_obj(std::string_view text, const TextName& name);

/// Reads an OFF file: "OFF", the counts, then one vertex and one face a line; numbers after a
/// face's vertices are its colour. E110 if a line is anything else, if the counts do not hold or
/// something follows; E203, E311 and E506 as for OBJ. Reading stops at the first finding.
Checked<Document> read_off(std::string_view text, const TextName& name);

/// Reads a PLY file, ASCII or binary of either byte order: elements `vertex` with x, y, z and
/// `face` with the list vertex_indices (or vertex_index); further properties and elements are
/// passed over. A face's hint is what a comment of the header calls its `feature`, as write_ply
/// writes it. E110 for a header or an element that is anything else, E105 for a binary file that
/// ends too soon; E203, E311 and E506 as for OBJ. Reading stops at the first finding.
Checked<Document> read_ply(std::string_view text, const TextName& name);

/// Reads an STL file, ASCII or binary (little-endian; the size of the file, not its first word,
/// says which). Corners at the same place, to the last bit, become one point; normals and attribute
/// bytes are passed over. The name of a `solid` is the hint of its triangles. E167 where ASCII is
/// anything else or a binary file is longer than its header says; E105 for a file that ends too
/// soon, E506 as for OBJ. Reading stops at the first finding.
Checked<Document> read_stl(std::string_view text, const TextName& name);

/// The document of a mesh: one building named by the file's stem. It is a solid if its faces form
/// one closed connected shell (points at the same place count as one). E313 without faces; E501 and
/// E506 leave the building out, E311 is a warning.
Checked<Document> document_of(RawMesh mesh, const TextName& name, Format format);

}  // namespace oriel::detail
