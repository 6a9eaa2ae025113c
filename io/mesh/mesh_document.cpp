#include "io/json/rings.h"
#include "io/mesh/mesh_reader.h"
#include "kernel/mesh/mesh.h"

#include <filesystem>
#include <utility>

namespace oriel::detail {

namespace {

/// True if every edge is met by exactly one opposite edge and the faces hang together by edges.
bool is_one_closed_shell(const RawMesh& raw) {
  MeshSource source;
  source.points = raw.points;
  for (const std::vector<int>& face : raw.faces) source.polygons.push_back({{face}, {}});
  const MeshFindings found = Mesh(source).findings();
  return found.shells == 1 && found.open_edges == 0 && found.non_manifold_edges == 0 &&
         found.empty_polygons == 0;
}

/// Keeps the points that faces use, in the order of their first use.
void drop_unused(RawMesh& mesh) {
  std::vector<int> place(mesh.points.size(), -1);
  std::vector<Vec3> points;
  for (std::vector<int>& face : mesh.faces)
    for (int& vertex : face) {
      int& index = place[static_cast<std::size_t>(vertex)];
      if (index < 0) {
        index = static_cast<int>(points.size());
        points.push_back(mesh.points[static_cast<std::size_t>(vertex)]);
      }
      vertex = index;
    }
  mesh.points = std::move(points);
}

Building building_of(RawMesh mesh, std::string id) {
  Building building;
  building.id = std::move(id);
  building.is_solid = is_one_closed_shell(mesh);
  building.frame = frame_of(mesh.points, "");
  for (const Vec3 p : mesh.points) building.vertices.push_back(p - building.frame.origin_m);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    building.polygons.push_back(
        {{std::move(mesh.faces[f])}, static_cast<int>(f), 0, 0, std::move(mesh.hints[f])});
  return building;
}

}  // namespace

Checked<Document> document_of(RawMesh mesh, const TextName& name, Format format) {
  Checked<Document> result;
  if (mesh.faces.empty()) {
    result.issues.push_back(
        error_in(name, {Code::E313, "the file has no face (val3dity 902 EMPTY_PRIMITIVE)"}));
    return result;
  }
  result.value.emplace();
  result.value->name = name.file;
  result.value->format = format;
  const std::string id = std::filesystem::path(name.file).stem().string();
  drop_unused(mesh);
  std::vector<RepeatedVertex> repeats;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    mesh.faces[f] = without_repeats(mesh.faces[f], static_cast<int>(f), 0, repeats);
  if (const auto fault = find_beyond_limits(mesh.points)) {
    result.issues.push_back(finding_of(name, Severity::error, id, *fault));
    return result;
  }
  Building building = building_of(std::move(mesh), id);
  building.repeats = std::move(repeats);
  if (const auto fault = find_degenerate(building.polygons, building.vertices))
    result.issues.push_back(finding_of(name, Severity::warning, id, *fault));
  result.value->buildings.push_back(std::move(building));
  return result;
}

}  // namespace oriel::detail
