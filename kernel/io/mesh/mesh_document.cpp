#include "kernel/io/json/rings.h"
#include "kernel/io/mesh/mesh_reader.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// For each point the first one at the same place.
std::vector<int> welded(const std::vector<Vec3>& points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) {
    const Vec3 p = points[static_cast<std::size_t>(i)];
    return std::tuple(p.x, p.y, p.z);
  };
  std::ranges::sort(order,
                    [&](int a, int b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  std::vector<int> first(points.size());
  int leader = -1;
  for (const int i : order) {
    if (leader < 0 || key(leader) != key(i)) leader = i;
    first[static_cast<std::size_t>(i)] = leader;
  }
  return first;
}

/// True if every edge is met by exactly one opposite edge and the faces hang together by edges.
bool is_one_closed_shell(const std::vector<Vec3>& points,
                         const std::vector<std::vector<int>>& faces) {
  const std::vector<int> first = welded(points);
  std::map<std::pair<int, int>, std::size_t> face_of_edge;
  std::vector<std::size_t> root(faces.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto root_of = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  const auto for_each_edge = [&](std::size_t f, const auto& visit) {
    for (std::size_t i = 0; i < faces[f].size(); ++i) {
      const auto from = static_cast<std::size_t>(faces[f][i]);
      const auto to = static_cast<std::size_t>(faces[f][(i + 1) % faces[f].size()]);
      if (first[from] != first[to] && !visit(first[from], first[to])) return false;
    }
    return true;
  };
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (!for_each_edge(f, [&](int a, int b) { return face_of_edge.try_emplace({a, b}, f).second; }))
      return false;
  std::size_t shells = faces.size();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const bool is_closed = for_each_edge(f, [&](int a, int b) {
      const auto opposite = face_of_edge.find({b, a});
      if (opposite == face_of_edge.end()) return false;
      const std::size_t one = root_of(f);
      const std::size_t other = root_of(opposite->second);
      if (one != other) --shells;
      root[std::max(one, other)] = std::min(one, other);
      return true;
    });
    if (!is_closed) return false;
  }
  return shells == 1;
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
  building.is_solid = is_one_closed_shell(mesh.points, mesh.faces);
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
