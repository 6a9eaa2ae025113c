#include "kernel/solidify/shells/edge_groups.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"

#include <cmath>
#include <tuple>

namespace oriel::detail {

namespace {

Vec3 difference(const Soup& soup, int to, int from) {
  const auto &p = soup.points[at(to)], &q = soup.points[at(from)];
  return {static_cast<double>(p[0] - q[0]), static_cast<double>(p[1] - q[1]),
          static_cast<double>(p[2] - q[2])};
}

Vec3 area_vector(const Soup& soup, int polygon) {
  Vec3 sum;
  const int base = soup.corners_of(polygon).front();
  for (const int r : soup.rings_of(polygon)) {
    const auto ring = soup.ring(r);
    for (std::size_t i = 0; i < ring.size(); ++i)
      sum = sum + cross(difference(soup, ring[i], base),
                        difference(soup, ring[(i + 1) % ring.size()], base));
  }
  return sum;
}

struct EdgeNeighbour {
  int polygon;
  bool is_against;  ///< they disagree as they are
};

/// By polygon those beyond its edges with two half-edges.
std::vector<std::vector<EdgeNeighbour>> neighbours_of(const Soup& soup, const ShellMesh& mesh,
                                                      const EdgeGroups& groups) {
  std::vector<std::vector<EdgeNeighbour>> neighbours(soup.polygons.size());
  groups.for_each([&](EdgeGroup group) {
    if (group.size() != 2) return;
    const std::size_t g = at(group[0]), h = at(group[1]);
    const bool is_against = soup.corners[g] == soup.corners[h];
    const int p = mesh.polygon_of[g], q = mesh.polygon_of[h];
    neighbours[at(p)].push_back({q, is_against});
    neighbours[at(q)].push_back({p, is_against});
  });
  return neighbours;
}

constexpr char kUnseen = 2;

/// Decides for all polygons connected with `start`; false if there is no choice.
bool turn_patch(std::span<const std::vector<EdgeNeighbour>> neighbours, int start,
                std::vector<char>& turned) {
  turned[at(start)] = 0;
  std::vector<int> patch{start};
  std::ptrdiff_t turns = 0;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const int p = patch[i];
    turns += turned[at(p)];
    for (const auto [q, is_against] : neighbours[at(p)]) {
      const char wanted = static_cast<char>(turned[at(p)] ^ static_cast<char>(is_against));
      if (turned[at(q)] == kUnseen) {
        turned[at(q)] = wanted;
        patch.push_back(q);
      } else if (turned[at(q)] != wanted) {
        return false;
      }
    }
  }
  if (2 * turns > std::ssize(patch))
    for (const int p : patch) turned[at(p)] ^= 1;
  return true;
}

}  // namespace

EdgeGroups::EdgeGroups(const Soup& soup, const ShellMesh& mesh)
    : soup_(&soup),
      mesh_(&mesh),
      has_bodies_(!soup.polygons.empty() &&
                  soup.polygons.front().body != soup.polygons.back().body),
      // Of one edge they ascend, and polygons are sorted by body: the bodies come one by one.
      half_edges_(sort_edges(soup.corners.size(), soup.points.size(),
                             [this](int h) { return ends_of(h); })) {}

std::optional<std::vector<char>> polygons_to_turn(const Soup& soup, const ShellMesh& mesh,
                                                  const EdgeGroups& groups) {
  const std::vector<std::vector<EdgeNeighbour>> neighbours = neighbours_of(soup, mesh, groups);
  std::vector<char> turned(soup.polygons.size(), kUnseen);
  for (int start = 0; start < soup.polygon_count(); ++start)
    if (turned[at(start)] == kUnseen && !turn_patch(neighbours, start, turned)) return std::nullopt;
  return turned;
}

bool pair_around(const Soup& soup, const EdgeGroup& group, ShellMesh& mesh) {
  ORIEL_ASSERT(!group.empty());
  const std::size_t first = at(group[0]);
  const auto [low, high] = EdgeEnds(soup.corners[first], soup.corners[at(mesh.next[first])]);
  const Vec3 axis = normalised(difference(soup, high, low));
  struct Ray {
    double angle;
    bool runs_up;
    int half_edge;
  };
  std::vector<Ray> rays;
  Vec3 u, v;
  for (const int h : group) {
    const bool runs_up = soup.corners[at(h)] == low;
    const Vec3 normal = normalised(area_vector(soup, mesh.polygon_of[at(h)]));
    const Vec3 inward = cross(normal, runs_up ? axis : -axis);
    if (rays.empty()) {
      u = normalised(inward - dot(inward, axis) * axis);
      v = cross(axis, u);
    }
    rays.push_back({std::atan2(dot(inward, v), dot(inward, u)), runs_up, h});
  }
  std::ranges::sort(rays, {}, [](const Ray& r) { return std::tuple(r.angle, r.half_edge); });
  const auto start = std::ranges::find(rays, false, &Ray::runs_up) - rays.begin();
  if (start == std::ssize(rays)) return false;
  std::ranges::rotate(rays, rays.begin() + start);
  for (std::size_t i = 0; i + 1 < rays.size(); i += 2) {
    if (rays[i].runs_up || !rays[i + 1].runs_up) return false;
    mesh.twin[at(rays[i].half_edge)] = rays[i + 1].half_edge;
    mesh.twin[at(rays[i + 1].half_edge)] = rays[i].half_edge;
  }
  return rays.size() % 2 == 0;
}

}  // namespace oriel::detail
