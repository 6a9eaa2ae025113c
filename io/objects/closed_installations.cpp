#include "io/objects/closed_installations.h"

#include "kernel/base/index.h"
#include "model/tolerances.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace oriel::detail {

namespace {

using VertexRing = std::vector<int>;
using RingList = std::vector<VertexRing>;

/// The loops along which some polygons of a closed shell meet the rest of it, each as these
/// polygons run round; nothing if a corner has two ways on.
std::optional<RingList> contact_loops(const std::vector<const CityPolygon*>& polygons) {
  std::set<std::pair<int, int>> edges;
  for (const CityPolygon* polygon : polygons)
    for (const VertexRing& ring : polygon->rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (!edges.insert({ring[i], ring[(i + 1) % ring.size()]}).second) return std::nullopt;
  std::map<int, int> next;
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from}) && !next.try_emplace(from, to).second) return std::nullopt;
  RingList loops;
  while (!next.empty()) {
    VertexRing& loop = loops.emplace_back();
    for (auto at = next.begin(); at != next.end();) {
      loop.push_back(at->first);
      const int to = at->second;
      next.erase(at);
      at = next.find(to);
      if (at == next.end() && to != loop.front()) return std::nullopt;
    }
    if (loop.size() < 3) return std::nullopt;
  }
  return loops;
}

struct LoopPlane {
  Vec3 normal;
  double offset_m = 0;
};

/// The plane that a loop lies in, or nothing.
std::optional<LoopPlane> plane_of_loop(const VertexRing& loop, const std::vector<Vec3>& vertices) {
  const Vec3 area = area_vector(vertices, loop);
  if (length(area) == 0) return std::nullopt;
  const Vec3 normal = normalised(area), base = vertices[at(loop.front())];
  const double most_m = Tolerances{}.plane_offset_m;
  for (const int v : loop)
    if (std::abs(dot(normal, vertices[at(v)] - base)) > most_m) return std::nullopt;
  return LoopPlane{normal, dot(normal, base)};
}

/// The loop itself if it lies in a plane, or the two that a chord parts it into if each of these
/// does, as where a chimney stands on both sides of a ridge; of several chords the shortest.
/// Nothing if there is no such chord.
RingList plane_parts(const VertexRing& loop, const std::vector<Vec3>& vertices) {
  constexpr std::size_t kMostCorners = 100;
  if (plane_of_loop(loop, vertices)) return {loop};
  RingList parts;
  double shortest_m = Box::kInfinity;
  for (std::size_t i = 0; i < loop.size() && loop.size() <= kMostCorners; ++i)
    for (std::size_t j = i + 2; j < loop.size() && j - i + 2 <= loop.size(); ++j) {
      const double chord_m = length(vertices[at(loop[j])] - vertices[at(loop[i])]);
      if (chord_m >= shortest_m) continue;
      const auto place = [&](std::size_t k) {
        return loop.begin() + static_cast<std::ptrdiff_t>(k);
      };
      VertexRing one(place(i), place(j + 1)), other(place(j), loop.end());
      other.insert(other.end(), loop.begin(), place(i + 1));
      if (!plane_of_loop(one, vertices) || !plane_of_loop(other, vertices)) continue;
      parts = {std::move(one), std::move(other)};
      shortest_m = chord_m;
    }
  return parts;
}

/// True if each loop lies in a plane, and of those in one plane none can be the hole of another.
bool are_faces(const RingList& loops, const std::vector<Vec3>& vertices) {
  std::vector<LoopPlane> planes;
  for (const VertexRing& loop : loops) {
    const auto plane = plane_of_loop(loop, vertices);
    if (!plane) return false;
    const bool is_turned = std::ranges::any_of(planes, [&](const LoopPlane& other) {
      return dot(other.normal, plane->normal) < 0 &&
             std::abs(other.offset_m + plane->offset_m) <= Tolerances{}.plane_offset_m;
    });
    if (is_turned) return false;
    planes.push_back(*plane);
  }
  return !planes.empty();
}

/// True if a face would lie on the back of a polygon that goes on from one of its edges: the body
/// reaches under the installation there, as the ground does under stairs.
bool are_folded(const RingList& faces, const std::vector<const CityPolygon*>& rest,
                const std::vector<Vec3>& vertices) {
  constexpr double kOpposite = -0.999;
  std::map<std::pair<int, int>, Vec3> normal_at;
  for (const VertexRing& face : faces)
    for (std::size_t i = 0; i < face.size(); ++i)
      normal_at[{face[(i + 1) % face.size()], face[i]}] = normalised(area_vector(vertices, face));
  for (const CityPolygon* polygon : rest)
    for (const VertexRing& ring : polygon->rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (const auto found = normal_at.find({ring[i], ring[(i + 1) % ring.size()]});
            found != normal_at.end() &&
            dot(found->second, normalised(area_vector(vertices, polygon->rings[0]))) < kOpposite)
          return true;
  return false;
}

/// Gives a geometry one more ClosureSurface; its number.
int add_closure_surface(CityGeometry& geometry) {
  geometry.surfaces.push_back({"ClosureSurface", -1, {}});
  return static_cast<int>(geometry.surfaces.size()) - 1;
}

class InstallationCloser {
 public:
  explicit InstallationCloser(CityRecord& record) : record_(record) {
    for (std::size_t i = 0; i < record.objects.size(); ++i)
      number_of_.try_emplace(record.objects[i].id, i);
  }

  std::vector<Issue> close() {
    for (CityObject& building : record_.objects) {
      if (building.type != "Building" && building.type != "BuildingPart") continue;
      for (const std::string& child : building.children) {
        CityObject& installation = record_.objects[number_of_.at(child)];
        if (installation.type != "BuildingInstallation") continue;
        for (CityGeometry& shared : installation.geometries)
          if (CityGeometry* solid = solid_with(building, shared))
            close(installation, shared, *solid);
      }
    }
    return std::move(issues_);
  }

 private:
  /// The solid of the building that has a polygon of the installation's geometry; null: none.
  static CityGeometry* solid_with(CityObject& building, const CityGeometry& shared) {
    if (shared.is_solid() || shared.bodies.empty()) return nullptr;
    const std::set<RingList> rings = rings_of(shared);
    for (CityGeometry& geometry : building.geometries) {
      if (!geometry.is_solid() || geometry.lod != shared.lod) continue;
      bool is_shared = false;
      for_each_city_polygon(
          geometry, [&](const CityPolygon& one) { is_shared |= rings.contains(one.rings); });
      if (is_shared) return &geometry;
    }
    return nullptr;
  }

  static std::set<RingList> rings_of(const CityGeometry& geometry) {
    std::set<RingList> rings;
    for_each_city_polygon(geometry, [&](const CityPolygon& one) { rings.insert(one.rings); });
    return rings;
  }

  void close(CityObject& installation, CityGeometry& shared, CityGeometry& solid) {
    const std::set<RingList> rings = rings_of(shared);
    for (auto& shells : solid.bodies) {
      if (shells.empty()) continue;
      std::vector<const CityPolygon*> common, rest;
      for (const CityPolygon& polygon : shells[0])
        (rings.contains(polygon.rings) ? common : rest).push_back(&polygon);
      if (common.size() != rings.size()) continue;
      const RingList faces = contact_faces(common);
      if (faces.empty() || are_folded(faces, rest, record_.vertices)) break;
      put_apart(faces, rings, shells[0], solid, shared);
      for (auto& [name, value] : installation.attributes)
        if (name == "oriel_geometry") value = {std::string("closed")};
      return;
    }
    issues_.push_back(
        building_issue(Severity::warning, Code::E166, installation.id,
                       "is written open: no plane faces close it where it meets its building"));
  }

  /// What closes polygons of a shell where they meet the rest of it; nothing if no plane faces do.
  [[nodiscard]] RingList contact_faces(const std::vector<const CityPolygon*>& common) const {
    RingList faces;
    const auto loops = contact_loops(common);
    if (!loops) return {};
    for (const VertexRing& loop : *loops) {
      const RingList parts = plane_parts(loop, record_.vertices);
      if (parts.empty()) return {};
      faces.insert(faces.end(), parts.begin(), parts.end());
    }
    return are_faces(faces, record_.vertices) ? faces : RingList{};
  }

  static void put_apart(const RingList& loops, const std::set<RingList>& rings,
                        std::vector<CityPolygon>& shell, CityGeometry& solid,
                        CityGeometry& shared) {
    std::erase_if(shell, [&](const CityPolygon& one) { return rings.contains(one.rings); });
    const int of_solid = add_closure_surface(solid), of_shared = add_closure_surface(shared);
    shared.type = "Solid";
    for (const VertexRing& loop : loops) {
      shell.push_back({{loop}, of_solid});
      shared.bodies[0][0].push_back({{VertexRing(loop.rbegin(), loop.rend())}, of_shared});
    }
  }

  CityRecord& record_;
  std::map<std::string, std::size_t> number_of_;
  std::vector<Issue> issues_;
};

}  // namespace

std::vector<Issue> close_installations(CityRecord& record) {
  return InstallationCloser(record).close();
}

}  // namespace oriel::detail
