#include "kernel/solidify/shells/shell_mesh.h"

#include "kernel/base/index.h"
#include "kernel/base/text/counted.h"
#include "kernel/solidify/planes/number_table.h"
#include "kernel/solidify/shells/edge_groups.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// Fills `next` and `polygon_of`.
void link_rings(const Soup& soup, ShellMesh& mesh) {
  mesh.next.resize(soup.corners.size());
  mesh.polygon_of.resize(soup.corners.size());
  for (int p = 0; p < soup.polygon_count(); ++p)
    for (const int r : soup.rings_of(p)) {
      const int begin = soup.first_corner[at(r)], end = soup.first_corner[at(r) + 1];
      for (int h = begin; h < end; ++h) {
        mesh.next[at(h)] = h + 1;
        mesh.polygon_of[at(h)] = p;
      }
      mesh.next[at(end) - 1] = begin;
    }
}

/// Fills `twin` if at most two half-edges of all bodies meet at every edge and run against each
/// other; false, with `twin` unfinished, if not. By hashing, several times faster than EdgeGroups.
bool pair_plain(const Soup& soup, ShellMesh& mesh) {
  const auto ends_of = [&](int h) {
    return EdgeEnds(soup.corners[at(h)], soup.corners[at(mesh.next[at(h)])]);
  };
  NumberTable first(soup.corners.size());  // of every edge its first half-edge
  mesh.twin.assign(soup.corners.size(), -1);
  const int count = soup.corner_count();
  for (int h = 0; h < count; ++h) {
    const EdgeEnds ends = ends_of(h);
    const std::uint64_t key =
        static_cast<std::uint64_t>(ends.low) << 32 | static_cast<std::uint32_t>(ends.high);
    int& other = first.at(key, [&](int g) { return ends_of(g) == ends; });
    if (other < 0) {
      other = h;
      continue;
    }
    if (mesh.twin[at(other)] >= 0 || soup.corners[at(other)] == soup.corners[at(h)]) return false;
    mesh.twin[at(other)] = h;
    mesh.twin[at(h)] = other;
  }
  return true;
}

/// The groups that need more than a look.
struct SpecialGroups {
  std::vector<EdgeGroup> against;  ///< two half-edges that run the same way
  std::vector<EdgeGroup> crowded;  ///< more than two half-edges
};

/// Fills `twin` at the edges with two half-edges that run against each other.
SpecialGroups pair_opposite(const Soup& soup, const EdgeGroups& groups, ShellMesh& mesh) {
  mesh.twin.assign(soup.corners.size(), -1);
  SpecialGroups special;
  groups.for_each([&](EdgeGroup group) {
    if (group.size() == 1) return;
    const std::size_t g = at(group[0]), h = at(group[1]);
    if (group.size() > 2) {
      special.crowded.push_back(group);
    } else if (soup.corners[g] == soup.corners[h]) {
      special.against.push_back(group);
    } else {
      mesh.twin[g] = group[1];
      mesh.twin[h] = group[0];
    }
  });
  return special;
}

/// Turns polygons round until neighbours agree; false, with an error, if they cannot.
bool orient_alike(Soup& soup, const ShellMesh& mesh, const EdgeGroups& groups,
                  const std::string& building, std::vector<Issue>& issues) {
  const auto turned = polygons_to_turn(soup, mesh, groups);
  if (!turned) {
    issues.push_back(building_issue(Severity::error, Code::E307, building,
                                    "the polygons cannot be oriented consistently (val3dity 307)"));
    return false;
  }
  for (int p = 0; p < soup.polygon_count(); ++p)
    if ((*turned)[at(p)] == 1)
      for (const int r : soup.rings_of(p)) {
        const auto ring = soup.ring(r);
        std::reverse(ring.begin() + 1, ring.end());
      }
  const auto count = std::ranges::count(*turned, 1);
  issues.push_back(
      building_issue(Severity::warning, Code::E308, building,
                     fmt::format("{} turned round to agree with {} neighbours (val3dity 307)",
                                 counted(count, "polygon was", "polygons were"),
                                 agreeing(count, "its", "their"))));
  return true;
}

/// Fills `twin` at the other edges.
void pair_crowded(const Soup& soup, const EdgeGroups& groups, std::span<const EdgeGroup> crowded,
                  const std::string& building, ShellMesh& mesh, std::vector<Issue>& issues) {
  EdgeGroup unpaired;  // the first one by body
  for (const EdgeGroup& group : crowded) {
    if (pair_around(soup, group, mesh)) continue;
    if (unpaired.empty() || groups.body_of(group[0]) < groups.body_of(unpaired[0]))
      unpaired = group;
  }
  if (unpaired.empty()) return;
  const std::size_t h = at(unpaired[0]);
  issues.push_back(building_issue(
      Severity::error, Code::E303, building,
      fmt::format("{} polygons meet at the edge {} – {} and do not pair up (val3dity 303)",
                  unpaired.size(), place_text(soup, soup.corners[h]),
                  place_text(soup, soup.corners[at(mesh.next[h])]))));
}

/// Fills `vertex_of` and `point_of`: the half-edges that leave a point are one vertex as far as
/// they follow each other round it. Vertices are numbered by their first half-edge.
void tell_vertices_apart(const Soup& soup, ShellMesh& mesh) {
  mesh.vertex_of.assign(mesh.half_edge_count(), -1);
  mesh.point_of.clear();
  mesh.point_of.reserve(soup.points.size());
  Numbers previous;  // the half-edge before each, needed at open edges only
  const int *const twin_of = mesh.twin.data(), *const next = mesh.next.data();
  int* const vertex_of = mesh.vertex_of.data();
  const int count = soup.corner_count();
  for (int start = 0; start < count; ++start) {
    if (vertex_of[start] >= 0) continue;
    const int vertex = static_cast<int>(mesh.point_of.size());
    mesh.point_of.push_back(soup.corners[at(start)]);
    int h = start;
    do {
      vertex_of[h] = vertex;
      const int twin = twin_of[h];
      h = twin < 0 ? -1 : next[twin];
    } while (h >= 0 && h != start);
    if (h == start) continue;
    // The fan ended at an open edge; what is left of it lies the other way round.
    if (previous.empty()) {
      previous.resize(mesh.half_edge_count());
      for (int g = 0; g < std::ssize(previous); ++g) previous[at(mesh.next[at(g)])] = g;
    }
    for (h = start; (h = mesh.twin[at(previous[at(h)])]) >= 0;) mesh.vertex_of[at(h)] = vertex;
  }
}

/// Two edges between the same two vertices, each with its own pair of polygons: an edge is known by
/// its ends, so all but the first get a point in their middle. False if there are none.
bool part_double_edges(Soup& soup, const ShellMesh& mesh, std::span<const EdgeGroup> crowded) {
  Numbers paired;
  for (const EdgeGroup& group : crowded)
    for (const int h : group)
      if (h < mesh.twin[at(h)]) paired.push_back(h);
  std::ranges::sort(paired);
  std::set<std::pair<int, int>> seen;
  std::map<int, int> middle_of;  // by half-edge: the point to come after its start
  for (const int h : paired) {
    const int twin = mesh.twin[at(h)];
    if (seen.insert(std::minmax({mesh.vertex_of[at(h)], mesh.vertex_of[at(twin)]})).second)
      continue;
    const auto &p = soup.points[at(soup.corners[at(h)])],
               &q = soup.points[at(soup.corners[at(twin)])];
    middle_of[h] = middle_of[twin] = static_cast<int>(soup.points.size());
    soup.points.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
  }
  Numbers corners, first_corner{0};
  for (int r = 0; r < soup.ring_count(); ++r) {
    for (int h = soup.first_corner[at(r)]; h < soup.first_corner[at(r) + 1]; ++h) {
      corners.push_back(soup.corners[at(h)]);
      if (const auto middle = middle_of.find(h); middle != middle_of.end())
        corners.push_back(middle->second);
    }
    first_corner.push_back(static_cast<int>(corners.size()));
  }
  soup.corners = std::move(corners);
  soup.first_corner = std::move(first_corner);
  return !middle_of.empty();
}

/// A second half-edge from one vertex to the same other one is an error.
void refuse_double_edges(const Soup& soup, const ShellMesh& mesh, const std::string& building,
                         std::vector<Issue>& issues) {
  std::set<std::pair<int, int>> seen;
  for (int r = 0; r < soup.ring_count(); ++r) {
    std::vector<std::pair<int, int>> edges;
    for (int h = soup.first_corner[at(r)]; h < soup.first_corner[at(r) + 1]; ++h)
      edges.emplace_back(mesh.vertex_of[at(h)], mesh.vertex_of[at(mesh.next[at(h)])]);
    if (std::ranges::none_of(edges, [&](const auto& edge) { return seen.contains(edge); })) {
      seen.insert(edges.begin(), edges.end());
      continue;
    }
    issues.push_back(building_issue(
        Severity::error, Code::E303, building,
        fmt::format("the ring that starts at {} does not fit its neighbours (val3dity 303)",
                    place_text(soup, soup.ring(r).front()))));
  }
}

}  // namespace

std::string place_text(const Soup& soup, int point) {
  const Vec3 p = exact::to_metres(soup.points[at(point)], soup.grid_m);
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x, p.y, p.z);
}

ShellMesh linked_rings(const Soup& soup) {
  ShellMesh mesh;
  link_rings(soup, mesh);
  return mesh;
}

ShellMesh build_shell_mesh(Soup& soup, const std::string& building, std::vector<Issue>& issues) {
  ShellMesh mesh;
  link_rings(soup, mesh);
  if (pair_plain(soup, mesh)) {
    tell_vertices_apart(soup, mesh);
    return mesh;
  }
  EdgeGroups groups(soup, mesh);
  SpecialGroups special = pair_opposite(soup, groups, mesh);
  if (!special.against.empty()) {
    if (!orient_alike(soup, mesh, groups, building, issues)) return mesh;
    groups = EdgeGroups(soup, mesh);
    special = pair_opposite(soup, groups, mesh);
  }
  pair_crowded(soup, groups, special.crowded, building, mesh, issues);
  if (has_errors(issues)) return mesh;
  tell_vertices_apart(soup, mesh);

  const bool is_open = std::ranges::find(mesh.twin, -1) != mesh.twin.end();
  if (!is_open && part_double_edges(soup, mesh, special.crowded)) {
    link_rings(soup, mesh);
    groups = EdgeGroups(soup, mesh);
    special = pair_opposite(soup, groups, mesh);
    pair_crowded(soup, groups, special.crowded, building, mesh, issues);
    tell_vertices_apart(soup, mesh);
  }
  if (!special.crowded.empty()) refuse_double_edges(soup, mesh, building, issues);
  return mesh;
}

}  // namespace oriel::detail
