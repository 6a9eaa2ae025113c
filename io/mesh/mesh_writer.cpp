#include "io/mesh/mesh_writer.h"

#include "kernel/base/index.h"
#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <map>

namespace oriel {

namespace {

/// Appends the coordinates of `p`, separated by blanks.
void append_point(std::string& text, Vec3 p) {
  text += shortest(p.x) + ' ' + shortest(p.y) + ' ' + shortest(p.z);
}

/// The points of the source, one a line. Doubled vertices are none of them.
void append_points(std::string& text, const Mesh& mesh, std::string_view keyword = "") {
  for (int v = 0; v < mesh.originals(); ++v) {
    text += keyword;
    append_point(text, mesh.point(v));
    text += '\n';
  }
}

/// How many corners the face has, and the corners.
void append_ring(std::string& text, const std::vector<int>& ring) {
  text += std::to_string(ring.size());
  for (const int v : ring) text += ' ' + std::to_string(v);
}

/// A name of an OBJ group or STL solid: no white space, so that every reader takes it whole.
std::string name_of(std::string_view label, std::string_view id = "") {
  std::string name(label);
  if (!id.empty()) name.append("_").append(id);
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= 0x20U || c == '#' || c == '\\') c = '_';
  return name;
}

}  // namespace

std::string write_obj(const MeshSource& source) {
  const Mesh mesh(source);
  std::vector<std::vector<int>> faces(mesh.features().size());
  for (int f = 0; f < mesh.faces(); ++f) faces[at(mesh.feature(f))].push_back(f);
  std::string text = "# oriel: metres, z up\n";
  append_points(text, mesh, "v ");
  std::string building;
  for (std::size_t g = 0; g < faces.size(); ++g) {
    const MeshFeature& feature = mesh.features()[g];
    if (g == 0 || feature.building != building) text += "o " + name_of(feature.building) + '\n';
    building = feature.building;
    text += "g " + name_of(feature.label, feature.id) + '\n';
    for (const int f : faces[g]) {
      text += 'f';
      for (const int v : mesh.ring(f)) text += ' ' + std::to_string(v + 1);
      text += '\n';
    }
  }
  return text;
}

std::string write_off(const MeshSource& source) {
  const Mesh mesh(source, MeshFaces::convex);
  std::string text =
      "OFF\n" + std::to_string(mesh.originals()) + ' ' + std::to_string(mesh.faces()) + " 0\n";
  append_points(text, mesh);
  for (int f = 0; f < mesh.faces(); ++f) {
    append_ring(text, mesh.ring(f));
    text += '\n';
  }
  return text;
}

std::string write_ply(const MeshSource& source) {
  const Mesh mesh(source);
  std::string faces;
  std::size_t most_corners = 0;
  for (int f = 0; f < mesh.faces(); ++f) {
    const std::vector<int> ring = mesh.ring(f);
    most_corners = std::max(most_corners, ring.size());
    append_ring(faces, ring);
    faces += ' ' + std::to_string(mesh.feature(f)) + '\n';
  }
  std::string text = "ply\nformat ascii 1.0\ncomment oriel: metres, z up\n";
  for (std::size_t i = 0; i < mesh.features().size(); ++i) {
    const MeshFeature& feature = mesh.features()[i];
    text += "comment feature " + std::to_string(i) + ' ' + name_of(feature.building) + ' ' +
            name_of(feature.label, feature.id) + '\n';
  }
  text += "element vertex " + std::to_string(mesh.originals()) +
          "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
          std::to_string(mesh.faces()) + "\nproperty list " +
          (most_corners <= 255 ? "uchar" : "uint") +
          " int vertex_indices\nproperty int feature\nend_header\n";
  append_points(text, mesh);
  return text + faces;
}

std::string write_stl(const MeshSource& source, StlSolids solids) {
  const Mesh mesh(source, MeshFaces::triangles);
  std::map<std::string, std::string> facets;
  for (int f = 0; f < mesh.faces(); ++f) {
    const std::string surface = mesh.surface(f).empty() ? "Unclassified" : mesh.surface(f);
    std::string& text = facets[name_of(solids == StlSolids::by_class ? surface : mesh.label(f))];
    text += "facet normal ";
    append_point(text, mesh.normal(f));
    text += "\nouter loop\n";
    for (const int v : mesh.corners(f)) {
      text += "vertex ";
      append_point(text, mesh.point(v));
      text += '\n';
    }
    text += "endloop\nendfacet\n";
  }
  std::string text;
  for (const auto& [name, part] : facets)
    text.append("solid ")
        .append(name)
        .append("\n")
        .append(part)
        .append("endsolid ")
        .append(name)
        .append("\n");
  return text;
}

}  // namespace oriel
