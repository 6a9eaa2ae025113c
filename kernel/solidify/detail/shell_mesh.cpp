#include "kernel/solidify/detail/shell_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// One side of an edge: the `i`-th edge of a ring of a polygon.
struct Side {
  int from = -1, to = -1;
  int polygon = -1;
  int next = -1;  ///< the side after it on its ring
};

/// All sides, ring after ring.
std::vector<Side> sides_of(const Soup& soup) {
  std::vector<Side> sides;
  for (int p = 0; p < std::ssize(soup.polygons); ++p)
    for (const auto& ring : soup.polygons[at(p)].rings) {
      const int first = static_cast<int>(sides.size());
      for (std::size_t i = 0; i < ring.size(); ++i)
        sides.push_back({ring[i], ring[(i + 1) % ring.size()], p,
                         first + static_cast<int>((i + 1) % ring.size())});
    }
  return sides;
}

/// The sides grouped by body and undirected edge.
std::vector<std::vector<int>> group_by_edge(const Soup& soup, const std::vector<Side>& sides) {
  const auto key = [&](int s) {
    const auto [low, high] = std::minmax(sides[at(s)].from, sides[at(s)].to);
    return std::tuple(soup.polygons[at(sides[at(s)].polygon)].body, low, high);
  };
  std::vector<int> order(sides.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order,
                    [&](int s, int t) { return std::tuple(key(s), s) < std::tuple(key(t), t); });
  std::vector<std::vector<int>> groups;
  for (const int s : order) {
    if (groups.empty() || key(groups.back().front()) != key(s)) groups.emplace_back();
    groups.back().push_back(s);
  }
  return groups;
}

/// Which polygons must be turned round so that the two sides of every edge with two sides run
/// against each other. Nothing if there is no such choice. Each connected patch keeps the
/// orientation of most of its polygons.
std::optional<std::vector<char>> polygons_to_turn(const Soup& soup, const std::vector<Side>& sides,
                                                  const std::vector<std::vector<int>>& groups) {
  struct Neighbour {
    int polygon;
    bool is_against;  ///< they disagree as they are
  };
  std::vector<std::vector<Neighbour>> neighbours(soup.polygons.size());
  for (const auto& group : groups) {
    if (group.size() != 2) continue;
    const Side &s = sides[at(group[0])], &t = sides[at(group[1])];
    const bool is_against = s.from == t.from;
    neighbours[at(s.polygon)].push_back({t.polygon, is_against});
    neighbours[at(t.polygon)].push_back({s.polygon, is_against});
  }
  std::vector<char> turned(soup.polygons.size(), 2);  // 2: not seen yet
  for (int start = 0; start < std::ssize(soup.polygons); ++start) {
    if (turned[at(start)] != 2) continue;
    turned[at(start)] = 0;
    std::vector<int> patch{start};
    std::ptrdiff_t turns = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const int p = patch[i];
      turns += turned[at(p)];
      for (const auto [q, is_against] : neighbours[at(p)]) {
        const char wanted = static_cast<char>(turned[at(p)] ^ static_cast<char>(is_against));
        if (turned[at(q)] == 2) {
          turned[at(q)] = wanted;
          patch.push_back(q);
        } else if (turned[at(q)] != wanted) {
          return std::nullopt;
        }
      }
    }
    if (2 * turns > std::ssize(patch))
      for (const int p : patch) turned[at(p)] ^= 1;
  }
  return turned;
}

void turn_round(SoupPolygon& polygon) {
  for (auto& ring : polygon.rings) std::reverse(ring.begin() + 1, ring.end());
}

Vec3 difference(const Soup& soup, int to, int from) {
  const auto &p = soup.points[at(to)], &q = soup.points[at(from)];
  return {static_cast<double>(p[0] - q[0]), static_cast<double>(p[1] - q[1]),
          static_cast<double>(p[2] - q[2])};
}

Vec3 area_vector(const Soup& soup, const SoupPolygon& polygon) {
  Vec3 sum;
  const int base = polygon.rings[0][0];
  for (const auto& ring : polygon.rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      sum = sum + cross(difference(soup, ring[i], base),
                        difference(soup, ring[(i + 1) % ring.size()], base));
  return sum;
}

/// Pairs the sides of one edge so that each pair encloses material: going round the edge, material
/// begins at a side that runs down it and ends at the next one, which runs up. False if they do not
/// alternate.
bool pair_around(const Soup& soup, const std::vector<Side>& sides, const std::vector<int>& group,
                 std::vector<int>& twin) {
  const auto [low, high] = std::minmax(sides[at(group[0])].from, sides[at(group[0])].to);
  const Vec3 axis = normalised(difference(soup, high, low));
  struct Ray {
    double angle;
    bool runs_up;
    int side;
  };
  std::vector<Ray> rays;
  Vec3 u, v;
  for (const int s : group) {
    const bool runs_up = sides[at(s)].from == low;
    const Vec3 normal = normalised(area_vector(soup, soup.polygons[at(sides[at(s)].polygon)]));
    const Vec3 inward = cross(normal, runs_up ? axis : -axis);
    if (rays.empty()) {
      u = normalised(inward - dot(inward, axis) * axis);
      v = cross(axis, u);
    }
    rays.push_back({std::atan2(dot(inward, v), dot(inward, u)), runs_up, s});
  }
  std::ranges::sort(rays, {}, [](const Ray& r) { return std::tuple(r.angle, r.side); });
  const auto start = std::ranges::find(rays, false, &Ray::runs_up) - rays.begin();
  if (start == std::ssize(rays)) return false;
  std::ranges::rotate(rays, rays.begin() + start);
  for (std::size_t i = 0; i + 1 < rays.size(); i += 2) {
    if (rays[i].runs_up || !rays[i + 1].runs_up) return false;
    twin[at(rays[i].side)] = rays[i + 1].side;
    twin[at(rays[i + 1].side)] = rays[i].side;
  }
  return rays.size() % 2 == 0;
}

/// The twin of every side, -1 where an edge stays open.
std::vector<int> pair_sides(const Soup& soup, const std::vector<Side>& sides,
                            const std::vector<std::vector<int>>& groups,
                            const std::string& building, std::vector<Issue>& issues) {
  std::vector<int> twin(sides.size(), -1);
  for (const auto& group : groups) {
    if (group.size() == 1) continue;
    if (group.size() == 2 && sides[at(group[0])].from != sides[at(group[1])].from) {
      twin[at(group[0])] = group[1];
      twin[at(group[1])] = group[0];
    } else if (!pair_around(soup, sides, group, twin)) {
      const Side& s = sides[at(group[0])];
      issues.push_back(building_issue(
          Severity::error, "E303", building,
          fmt::format("{} polygons meet at the edge {} – {} and do not pair up (val3dity 303)",
                      group.size(), place_text(soup, s.from), place_text(soup, s.to))));
      return twin;
    }
  }
  return twin;
}

/// For every side the sheet (set of sides around one point that touch) of its start: sheets count
/// from 0.
std::vector<int> sheets_of(const std::vector<Side>& sides, const std::vector<int>& twin,
                           int& count) {
  std::vector<int> sheet(sides.size());
  std::iota(sheet.begin(), sheet.end(), 0);
  const auto find = [&](int s) {
    while (sheet[at(s)] != s) s = sheet[at(s)] = sheet[at(sheet[at(s)])];
    return s;
  };
  for (int s = 0; s < std::ssize(sides); ++s) {
    if (twin[at(s)] < 0) continue;
    const int i = find(s), j = find(sides[at(twin[at(s)])].next);
    sheet[at(std::max(i, j))] = std::min(i, j);
  }
  std::vector<int> number(sides.size(), -1);
  std::vector<int> out(sides.size());
  count = 0;
  for (int s = 0; s < std::ssize(sides); ++s) {
    int& n = number[at(find(s))];
    if (n < 0) n = count++;
    out[at(s)] = n;
  }
  return out;
}

/// Two edges between the same two sheets, each with its own pair of polygons: a half-edge mesh has
/// no two edges between the same two vertices, so all but the first get a point in their middle.
/// False if there are none.
bool part_double_edges(Soup& soup, const std::vector<Side>& sides, const std::vector<int>& twin,
                       const std::vector<int>& sheet) {
  std::set<std::pair<int, int>> seen;
  std::map<int, int> middle_of;  // by side: the point to come after its start
  for (int s = 0; s < std::ssize(sides); ++s) {
    const int t = twin[at(s)];
    if (t < s || seen.insert(std::minmax({sheet[at(s)], sheet[at(t)]})).second) continue;
    const auto &p = soup.points[at(sides[at(s)].from)], &q = soup.points[at(sides[at(s)].to)];
    middle_of[s] = middle_of[t] = static_cast<int>(soup.points.size());
    soup.points.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
  }
  int side = static_cast<int>(sides.size());
  for (int p = static_cast<int>(soup.polygons.size()); p-- > 0;)
    for (std::size_t r = soup.polygons[at(p)].rings.size(); r-- > 0;) {
      auto& ring = soup.polygons[at(p)].rings[r];
      for (std::size_t i = ring.size(); i-- > 0;)
        if (const auto found = middle_of.find(--side); found != middle_of.end())
          ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1, found->second);
    }
  return !middle_of.empty();
}

}  // namespace

std::string place_text(const Soup& soup, int point) {
  const Vec3 p = exact::to_metres(soup.points[at(point)], soup.grid_m);
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x, p.y, p.z);
}

ShellMesh build_shell_mesh(Soup& soup, const std::string& building, std::vector<Issue>& issues) {
  ShellMesh shell;
  std::vector<Side> sides = sides_of(soup);
  auto groups = group_by_edge(soup, sides);
  const auto turned = polygons_to_turn(soup, sides, groups);
  if (!turned) {
    issues.push_back(building_issue(Severity::error, "E307", building,
                                    "the polygons cannot be oriented alike (val3dity 307)"));
    return shell;
  }
  if (const auto turns = std::ranges::count(*turned, 1); turns > 0) {
    for (int p = 0; p < std::ssize(soup.polygons); ++p)
      if ((*turned)[at(p)] == 1) turn_round(soup.polygons[at(p)]);
    issues.push_back(building_issue(
        Severity::warning, "E308", building,
        fmt::format("{} polygons were turned round to agree with their neighbours (val3dity 307)",
                    turns)));
    sides = sides_of(soup);
    groups = group_by_edge(soup, sides);
  }
  std::vector<int> twin = pair_sides(soup, sides, groups, building, issues);
  if (has_errors(issues)) return shell;

  int sheets = 0;
  std::vector<int> sheet = sheets_of(sides, twin, sheets);
  if (std::ranges::find(twin, -1) == twin.end() && part_double_edges(soup, sides, twin, sheet)) {
    sides = sides_of(soup);
    twin = pair_sides(soup, sides, group_by_edge(soup, sides), building, issues);
    sheet = sheets_of(sides, twin, sheets);
  }
  shell.point_of.resize(at(sheets));
  for (int s = 0; s < std::ssize(sides); ++s) shell.point_of[at(sheet[at(s)])] = sides[at(s)].from;
  omerr().disable();  // what it cannot take is told as E303
  shell.mesh.reserve(at(sheets), sides.size() / 2, soup.polygons.size());
  for (const int point : shell.point_of) {
    const Vec3 p = exact::to_metres(soup.points[at(point)], soup.grid_m);
    shell.mesh.add_vertex({p.x, p.y, p.z});
  }
  int side = 0;
  std::vector<OpenMesh::VertexHandle> ring_vertices;
  for (int p = 0; p < std::ssize(soup.polygons); ++p)
    for (const auto& ring : soup.polygons[at(p)].rings) {
      ring_vertices.clear();
      for (std::size_t i = 0; i < ring.size(); ++i, ++side)
        ring_vertices.emplace_back(sheet[at(side)]);
      if (!shell.mesh.add_face(ring_vertices).is_valid())
        issues.push_back(building_issue(
            Severity::error, "E303", building,
            fmt::format("the ring that starts at {} does not fit its neighbours (val3dity 303)",
                        place_text(soup, ring[0]))));
      shell.polygon_of.push_back(p);
    }
  return shell;
}

}  // namespace oriel::detail
