#include "io/gltf/flat_mesh.h"

#include "kernel/base/index.h"
#include "kernel/mesh/triangulate.h"

#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace oriel {

namespace {

FlatMesh::Point single(Vec3 p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

Vec3 doubled(const FlatMesh::Point& p) { return {p[0], p[1], p[2]}; }

/// Makes triangles of polygons.
class Flattener {
 public:
  Flattener(const MeshSource& source, Vec3 origin_m) : source_(source), origin_m_(origin_m) {}

  FlatMesh flatten() {
    for (const MeshPolygon& polygon : source_.polygons) add(polygon);
    for (std::size_t f = 0; f < mesh_.features.size(); ++f)
      mesh_.features[f].height_m = extents_[f].max.z - extents_[f].min.z;
    return std::move(mesh_);
  }

 private:
  void add(const MeshPolygon& polygon) {
    // Without a normal it has no area.
    if (polygon.normal == Vec3{}) return;
    const auto triangles = triangulate_quickly(source_.points, polygon.rings, polygon.normal);
    if (triangles.empty()) return;
    const std::uint32_t feature = row_of(polygon);
    const FlatMesh::Point normal = single(polygon.normal);
    std::map<int, std::uint32_t> numbers;
    for (const auto& ring : polygon.rings)
      for (const int v : ring) {
        const auto number = static_cast<std::uint32_t>(mesh_.points.size());
        if (!numbers.try_emplace(v, number).second) continue;
        const Vec3 point = source_.points[at(v)] - origin_m_;
        extents_[feature].grow(point);
        mesh_.points.push_back(single(point));
        mesh_.normals.push_back(normal);
        mesh_.feature_of.push_back(feature);
      }
    for (const auto& triangle : triangles)
      mesh_.triangles.push_back(
          {numbers.at(triangle[0]), numbers.at(triangle[1]), numbers.at(triangle[2])});
    for (const auto& ring : polygon.rings) add_edges(ring, numbers);
  }

  void add_edges(const std::vector<int>& ring, const std::map<int, std::uint32_t>& numbers) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int from = ring[i], to = ring[(i + 1) % ring.size()];
      if (drawn_.emplace(std::min(from, to), std::max(from, to)).second)
        mesh_.edges.push_back({numbers.at(from), numbers.at(to)});
    }
  }

  std::uint32_t row_of(const MeshPolygon& polygon) {
    const auto [row, is_new] = rows_.try_emplace({polygon.feature, polygon.surface, polygon.colour},
                                                 static_cast<std::uint32_t>(rows_.size()));
    if (!is_new) return row->second;
    FlatFeature feature;
    if (polygon.feature >= 0) {
      const MeshFeature& named = source_.features[at(polygon.feature)];
      feature = {named.building, named.id, named.label, "", named.score, named.rule};
    }
    feature.surface = polygon.surface;
    feature.colour = polygon.colour;
    mesh_.features.push_back(std::move(feature));
    extents_.emplace_back();
    return row->second;
  }

  const MeshSource& source_;
  Vec3 origin_m_;
  FlatMesh mesh_;
  std::map<std::tuple<int, std::string, std::optional<FaceColour>>, std::uint32_t> rows_;
  std::vector<Box> extents_;
  std::set<std::pair<int, int>> drawn_;
};

}  // namespace

FlatMesh flat_mesh(const MeshSource& source, Vec3 origin_m) {
  return Flattener(source, origin_m).flatten();
}

void append(FlatMesh& mesh, const FlatMesh& part, const Placement& placement) {
  const auto first_point = static_cast<std::uint32_t>(mesh.points.size());
  const auto first_feature = static_cast<std::uint32_t>(mesh.features.size());
  mesh.features.insert(mesh.features.end(), part.features.begin(), part.features.end());
  for (const auto& point : part.points)
    mesh.points.push_back(single(placement.placed(doubled(point))));
  for (const auto& normal : part.normals)
    mesh.normals.push_back(single(normalised(placement.turned(doubled(normal)))));
  for (const std::uint32_t feature : part.feature_of)
    mesh.feature_of.push_back(first_feature + feature);
  for (auto [a, b, c] : part.triangles)
    mesh.triangles.push_back({first_point + a, first_point + b, first_point + c});
  for (auto [a, b] : part.edges) mesh.edges.push_back({first_point + a, first_point + b});
}

Box box_of(const FlatMesh& mesh) {
  Box box;
  for (const auto& point : mesh.points) box.grow(doubled(point));
  return box;
}

}  // namespace oriel
