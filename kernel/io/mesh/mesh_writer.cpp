#include "kernel/io/mesh/mesh_writer.h"

#include "kernel/mesh/triangulate.h"
#include "kernel/io/json/json_text.h"

#include <algorithm>
#include <array>
#include <map>

namespace oriel {

namespace {

using Triangle = std::array<int, 3>;

/// Appends the coordinates of `p`, separated by blanks.
void append_point(std::string& text, Vec3 p) {
  text += detail::shortest(p.x) + ' ' + detail::shortest(p.y) + ' ' + detail::shortest(p.z);
}

std::vector<Triangle> triangles_of(const LabelledMesh& mesh, const MeshFace& face) {
  return detail::triangulate(mesh.vertices, face.rings, face.normal);
}

bool is_convex(const LabelledMesh& mesh, const MeshFace& face) {
  const auto& ring = face.rings[0];
  const auto at = [&](std::size_t i) {
    return mesh.vertices[static_cast<std::size_t>(ring[i % ring.size()])];
  };
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (dot(cross(at(i + 1) - at(i), at(i + 2) - at(i + 1)), face.normal) < 0) return false;
  return true;
}

/// A name of an OBJ group or STL solid: no white space, so that every reader takes it whole.
std::string name_of(std::string_view label, std::string_view id = "") {
  std::string name(label);
  if (!id.empty()) name.append("_").append(id);
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= 0x20U || c == '#' || c == '\\') c = '_';
  return name;
}

template <class Corners>
void append_obj_face(std::string& text, const Corners& corners) {
  text += 'f';
  for (const int v : corners) text += ' ' + std::to_string(v + 1);
  text += '\n';
}

}  // namespace

std::string write_obj(const LabelledMesh& mesh) {
  std::vector<std::vector<const MeshFace*>> faces(mesh.groups.size());
  for (const MeshFace& face : mesh.faces)
    faces[static_cast<std::size_t>(face.group)].push_back(&face);
  std::string text = "# oriel: metres, z up\n";
  for (const Vec3 p : mesh.vertices) {
    text += "v ";
    append_point(text, p);
    text += '\n';
  }
  std::string building;
  for (std::size_t g = 0; g < faces.size(); ++g) {
    const MeshGroup& group = mesh.groups[g];
    if (g == 0 || group.building != building) text += "o " + name_of(group.building) + '\n';
    building = group.building;
    text += "g " + name_of(group.label, group.id) + '\n';
    for (const MeshFace* face : faces[g]) {
      if (face->rings.size() == 1)
        append_obj_face(text, face->rings[0]);
      else
        for (const Triangle& triangle : triangles_of(mesh, *face)) append_obj_face(text, triangle);
    }
  }
  return text;
}

std::string write_off(const LabelledMesh& mesh) {
  std::string faces;
  std::size_t count = 0;
  const auto append = [&](const auto& corners) {
    faces += std::to_string(corners.size());
    for (const int v : corners) faces += ' ' + std::to_string(v);
    faces += '\n';
    ++count;
  };
  for (const MeshFace& face : mesh.faces) {
    if (face.rings.size() == 1 && is_convex(mesh, face))
      append(face.rings[0]);
    else
      for (const Triangle& triangle : triangles_of(mesh, face)) append(triangle);
  }
  std::string text =
      "OFF\n" + std::to_string(mesh.vertices.size()) + ' ' + std::to_string(count) + " 0\n";
  for (const Vec3 p : mesh.vertices) {
    append_point(text, p);
    text += '\n';
  }
  return text + faces;
}

std::string write_stl(const LabelledMesh& mesh, StlSolids solids) {
  std::map<std::string, std::string> facets;
  for (const MeshFace& face : mesh.faces) {
    const std::string surface = face.surface_class.empty() ? "Unclassified" : face.surface_class;
    const std::string& label = mesh.groups[static_cast<std::size_t>(face.group)].label;
    std::string& text = facets[name_of(solids == StlSolids::by_class ? surface : label)];
    for (const Triangle& triangle : triangles_of(mesh, face)) {
      text += "facet normal ";
      append_point(text, face.normal);
      text += "\nouter loop\n";
      for (const int v : triangle) {
        text += "vertex ";
        append_point(text, mesh.vertices[static_cast<std::size_t>(v)]);
        text += '\n';
      }
      text += "endloop\nendfacet\n";
    }
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
