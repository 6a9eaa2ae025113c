#include "kernel/validate/polygons/ring_checks.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/base/text/counted.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/geometry/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// As triangulate() chooses it: the largest component of the normal, z before x before y.
std::size_t nearest_axis(Vec3 normal) {
  const double x = std::abs(normal.x);
  const double y = std::abs(normal.y);
  const double z = std::abs(normal.z);
  if (z >= x && z >= y) return 2;
  return x >= y ? 0 : 1;
}

Vec3 unit(std::size_t axis, bool is_positive) {
  const double one = is_positive ? 1 : -1;
  return {axis == 0 ? one : 0, axis == 1 ? one : 0, axis == 2 ? one : 0};
}

/// The neighbours of `point` on a ring through it: the ends of the edge that it lies in, or of the
/// two edges that it joins.
std::array<FlatPoint, 2> neighbours(const FlatPoint& point, std::span<const FlatPoint> ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    if (ring[i] == point) return {ring[(i + n - 1) % n], ring[(i + 1) % n]};
  for (std::size_t i = 0; i < n; ++i)
    if (is_on(point, ring[i], ring[(i + 1) % n])) return {ring[i], ring[(i + 1) % n]};
  return {point, point};
}

/// True if the direction to `d` lies strictly between those to `from` and `to`, counter-clockwise
/// about `p`.
bool is_between(const FlatPoint& p, const FlatPoint& from, const FlatPoint& to,
                const FlatPoint& d) {
  const int whole = turn(p, from, to);
  if (whole > 0) return turn(p, from, d) > 0 && turn(p, d, to) > 0;
  if (whole == 0) return turn(p, from, d) > 0;
  return !(turn(p, to, d) >= 0 && turn(p, d, from) >= 0);
}

/// +1 if the ring runs counter-clockwise, -1 if clockwise, 0 if it has no area.
int orientation(std::span<const FlatPoint> ring) {
  exact::Int128 twice_area = 0;
  const FlatPoint& o = ring[0];
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const FlatPoint& a = ring[i];
    const FlatPoint& b = ring[(i + 1) % ring.size()];
    twice_area += exact::Int128{a[0] - o[0]} * (b[1] - o[1]);
    twice_area -= exact::Int128{a[1] - o[1]} * (b[0] - o[0]);
  }
  return twice_area > 0 ? 1 : twice_area < 0 ? -1 : 0;
}

/// +1 if the point is inside the ring, -1 outside, 0 on it. The ring must not cross itself.
int place_in(const FlatPoint& point, std::span<const FlatPoint> ring) {
  bool is_inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const FlatPoint& a = ring[i];
    const FlatPoint& b = ring[(i + 1) % ring.size()];
    if (is_on(point, a, b)) return 0;
    if ((a[1] > point[1]) == (b[1] > point[1])) continue;
    const int side = turn(a, b, point);
    if ((b[1] > a[1]) == (side > 0)) is_inside = !is_inside;
  }
  return is_inside ? 1 : -1;
}

/// True if rings p and q, which touch in `point` and nowhere overlap, run through each other there.
bool cross_at(const FlatPoint& point, std::span<const FlatPoint> p, std::span<const FlatPoint> q) {
  const auto [from, to] = neighbours(point, p);
  const auto [one, other] = neighbours(point, q);
  const auto is_left = [&](const FlatPoint& d) { return is_between(point, from, to, d); };
  const auto is_right = [&](const FlatPoint& d) { return is_between(point, to, from, d); };
  return (is_left(one) && is_right(other)) || (is_right(one) && is_left(other));
}

/// An edge of a ring, from its point `at` to the next.
struct FlatEdge {
  std::size_t ring;
  std::size_t at;
  FlatPoint from;
  FlatPoint to;
};

inline std::vector<FlatEdge> edges_of(std::span<const FlatPoint> ring, std::size_t number) {
  std::vector<FlatEdge> edges;
  edges.reserve(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i)
    edges.push_back({number, i, ring[i], ring[(i + 1) % ring.size()]});
  return edges;
}

/// The box of an edge or ring in the plane.
inline Box flat_box(const std::vector<FlatPoint>& points) {
  Box box;
  for (const FlatPoint& p : points)
    box.grow(Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), 0});
  return box;
}

/// Calls visit(i, j), i < j, for all boxes that overlap, until it returns false.
template <class Visit>
void for_each_pair(const std::vector<Box>& boxes, const Visit& visit) {
  // Below this trying all pairs takes less than making a tree.
  constexpr std::size_t kFew = 24;
  if (boxes.size() <= kFew) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size(); ++j)
        if (overlap(boxes[i], boxes[j]) && !visit(i, j)) return;
    return;
  }
  const BoxTree tree(boxes);
  bool goes_on = true;
  for (std::size_t i = 0; i < boxes.size() && goes_on; ++i)
    tree.for_each_overlap(boxes[i], [&](int j) {
      if (goes_on && static_cast<int>(i) < j) goes_on = visit(i, at(j));
    });
}

Subject subject_of(const SnappedPolygon& polygon, std::size_t ring) {
  return {polygon.body, polygon.shell, polygon.number, static_cast<int>(ring)};
}

/// "polygon 3", "inner ring 2 of polygon 3".
std::string name_of(const SnappedPolygon& polygon, std::size_t ring) {
  if (polygon.rings.size() == 1) return fmt::format("polygon {}", polygon.number);
  if (ring == 0) return fmt::format("the outer ring of polygon {}", polygon.number);
  return fmt::format("inner ring {} of polygon {}", ring, polygon.number);
}

std::vector<int> ends_of(const SnappedPolygon& polygon, const FlatEdge& edge) {
  const auto& ring = polygon.rings[edge.ring];
  return {ring[edge.at], ring[(edge.at + 1) % ring.size()]};
}

std::vector<Box> boxes_of(std::span<const FlatEdge> edges) {
  std::vector<Box> boxes;
  boxes.reserve(edges.size());
  for (const FlatEdge& edge : edges) boxes.push_back(flat_box({edge.from, edge.to}));
  return boxes;
}

bool has_good_points(const SnappedPolygon& polygon, std::size_t number, FindingList& findings) {
  const std::vector<int>& ring = polygon.rings[number];
  const Subject subject = subject_of(polygon, number);
  if (ring.size() < 3) {
    findings.add(Defect::too_few_points, subject,
                 fmt::format("{} has {}; expected at least 3", name_of(polygon, number),
                             counted(ring.size(), "point")),
                 ring.empty() ? std::vector<int>{} : std::vector<int>{ring[0]});
    return false;
  }
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (ring[i] == ring[(i + 1) % ring.size()]) {
      findings.add(Defect::repeated_point, subject,
                   fmt::format("{} has the same point twice in a row", name_of(polygon, number)),
                   {ring[i]});
      return false;
    }
  return true;
}

bool is_simple(const SnappedPolygon& polygon, const FlatPolygon& flat, std::size_t number,
               FindingList& findings) {
  const std::vector<FlatEdge> edges = edges_of(flat.rings[number], number);
  bool is_good = true;
  for_each_pair(boxes_of(edges), [&](std::size_t i, std::size_t j) {
    const FlatEdge& p = edges[i];
    const FlatEdge& q = edges[j];
    findings.count(1);
    if (findings.is_used_up()) return is_good = false;
    const bool are_neighbours = j == i + 1 || (i == 0 && j + 1 == edges.size());
    const Meeting how = meeting(p.from, p.to, q.from, q.to);
    if (how == Meeting::none || (are_neighbours && how == Meeting::touch)) return true;
    findings.add(Defect::ring_crosses_itself, subject_of(polygon, number),
                 fmt::format("{} {} itself", name_of(polygon, number),
                             how == Meeting::cross     ? "crosses"
                             : how == Meeting::overlap ? "runs back over"
                                                       : "touches"),
                 ends_of(polygon, p));
    is_good = false;
    return false;
  });
  return is_good;
}

/// The ring's points from its least one on, in the direction of the lesser neighbour: the same for
/// all rings of the same points.
std::vector<FlatPoint> canonical(std::vector<FlatPoint> ring) {
  std::ranges::rotate(ring, std::ranges::min_element(ring));
  if (ring.back() < ring[1]) std::reverse(ring.begin() + 1, ring.end());
  return ring;
}

bool are_different(const SnappedPolygon& polygon, const FlatPolygon& flat, FindingList& findings) {
  std::map<std::vector<FlatPoint>, std::size_t> first_of;
  bool is_good = true;
  for (std::size_t i = 0; i < flat.rings.size(); ++i) {
    const auto [found, is_new] = first_of.try_emplace(canonical(flat.rings[i]), i);
    if (is_new) continue;
    findings.add(
        Defect::rings_alike, subject_of(polygon, i),
        fmt::format("{} is the same as {}", name_of(polygon, i), name_of(polygon, found->second)),
        {polygon.rings[i][0]});
    is_good = false;
  }
  return is_good;
}

/// Two rings and a point in which they touch.
using Touch = std::tuple<std::size_t, std::size_t, FlatPoint>;

/// Adds the points in which two edges of different rings touch.
void add_touches(const FlatEdge& p, const FlatEdge& q, std::set<Touch>& touches) {
  const auto add = [&](const FlatPoint& point) {
    touches.emplace(std::min(p.ring, q.ring), std::max(p.ring, q.ring), point);
  };
  for (const FlatPoint& point : {p.from, p.to})
    if (is_on(point, q.from, q.to)) add(point);
  for (const FlatPoint& point : {q.from, q.to})
    if (is_on(point, p.from, p.to)) add(point);
}

/// val3dity 201. Where rings touch without crossing goes to `touches`.
bool are_apart(const SnappedPolygon& polygon, const FlatPolygon& flat, std::set<Touch>& touches,
               FindingList& findings) {
  std::vector<FlatEdge> edges;
  for (std::size_t i = 0; i < flat.rings.size(); ++i)
    std::ranges::move(edges_of(flat.rings[i], i), std::back_inserter(edges));
  std::set<std::pair<std::size_t, std::size_t>> crossed;
  const auto tell = [&](std::size_t p, std::size_t q, const std::vector<int>& where) {
    if (!crossed.emplace(std::min(p, q), std::max(p, q)).second) return;
    findings.add(Defect::rings_cross, subject_of(polygon, std::max(p, q)),
                 fmt::format("{} crosses {}", name_of(polygon, std::max(p, q)),
                             name_of(polygon, std::min(p, q))),
                 where);
  };
  for_each_pair(boxes_of(edges), [&](std::size_t i, std::size_t j) {
    findings.count(1);
    if (findings.is_used_up()) return false;
    if (edges[i].ring == edges[j].ring) return true;
    const Meeting how = meeting(edges[i].from, edges[i].to, edges[j].from, edges[j].to);
    if (how == Meeting::touch) add_touches(edges[i], edges[j], touches);
    if (how == Meeting::cross || how == Meeting::overlap)
      tell(edges[i].ring, edges[j].ring, ends_of(polygon, edges[i]));
    return true;
  });
  if (findings.is_used_up()) return false;
  for (const auto& [p, q, point] : touches)
    if (!crossed.contains({p, q}) && cross_at(point, flat.rings[p], flat.rings[q]))
      tell(p, q, {polygon.rings[q][0]});
  return crossed.empty();
}

/// val3dity 205: rings and the points where they touch, as a graph, have no cycle.
bool is_in_one_piece(const SnappedPolygon& polygon, const FlatPolygon& flat,
                     const std::set<Touch>& touches, FindingList& findings) {
  std::map<FlatPoint, std::set<std::size_t>> rings_at;
  for (const auto& [p, q, point] : touches) rings_at[point].insert({p, q});
  DisjointSets groups(flat.rings.size());
  int point_number = static_cast<int>(flat.rings.size());
  for (const auto& [point, rings] : rings_at) {
    groups.add();
    for (const std::size_t ring : rings) {
      const int number = static_cast<int>(ring);
      if (groups.find(number) == groups.find(point_number)) {
        findings.add(Defect::polygon_in_pieces, subject_of(polygon, ring),
                     fmt::format("the rings of polygon {} touch so that its interior is in pieces",
                                 polygon.number),
                     {polygon.rings[ring][0]});
        return false;
      }
      groups.unite(number, point_number);
    }
    ++point_number;
  }
  return true;
}

std::vector<FlatPoint> doubled(std::vector<FlatPoint> ring) {
  for (FlatPoint& p : ring) p = {2 * p[0], 2 * p[1]};
  return ring;
}

/// Where ring p, which does not cross q, lies: +1 inside q, -1 outside. Middles of edges decide, as
/// points may lie on q; no middle of p can if q's points lie on p only in points.
int side_of_ring(std::span<const FlatPoint> p, std::span<const FlatPoint> twice_q) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const FlatPoint& a = p[i];
    const FlatPoint& b = p[(i + 1) % p.size()];
    const int place = place_in({a[0] + b[0], a[1] + b[1]}, twice_q);
    if (place != 0) return place;
    const int at_point = place_in({2 * a[0], 2 * a[1]}, twice_q);
    if (at_point != 0) return at_point;
  }
  return 0;
}

/// val3dity 206 and 207.
bool are_holes_placed_well(const SnappedPolygon& polygon, const FlatPolygon& flat,
                           FindingList& findings) {
  const std::size_t before = findings.size();
  std::vector<std::vector<FlatPoint>> twice;
  std::vector<Box> boxes;
  for (const auto& ring : flat.rings) {
    twice.push_back(doubled(ring));
    boxes.push_back(flat_box(ring));
  }
  for (std::size_t i = 1; i < flat.rings.size(); ++i) {
    findings.count(std::ssize(flat.rings[0]));
    if (findings.is_used_up()) return false;
    if (side_of_ring(flat.rings[i], twice[0]) < 0)
      findings.add(Defect::hole_outside, subject_of(polygon, i),
                   fmt::format("{} lies outside its outer ring", name_of(polygon, i)),
                   {polygon.rings[i][0]});
  }
  if (findings.size() > before) return false;
  for_each_pair(boxes, [&](std::size_t i, std::size_t j) {
    if (i == 0) return true;
    findings.count(std::ssize(flat.rings[i]) + std::ssize(flat.rings[j]));
    if (findings.is_used_up()) return false;
    const bool is_inside = side_of_ring(flat.rings[j], twice[i]) > 0;
    const bool is_around = !is_inside && side_of_ring(flat.rings[i], twice[j]) > 0;
    const std::size_t inner = is_inside ? j : i;
    if (is_inside || is_around)
      findings.add(Defect::holes_nested, subject_of(polygon, inner),
                   fmt::format("{} lies inside {}", name_of(polygon, inner),
                               name_of(polygon, i + j - inner)),
                   {polygon.rings[inner][0]});
    return true;
  });
  return findings.size() == before && !findings.is_used_up();
}

}  // namespace

FlatPolygon flat_polygon(const SnappedBuilding& building, const SnappedPolygon& polygon,
                         Vec3 normal) {
  ORIEL_ASSERT(!polygon.rings.empty() && !polygon.rings[0].empty());
  const std::size_t axis = nearest_axis(normal);
  const auto seen = [&](bool is_positive) {
    FlatPolygon flat;
    flat.axis = unit(axis, is_positive);
    for (const auto& ring : polygon.rings)
      for (auto& points = flat.rings.emplace_back(); const int vertex : ring)
        points.push_back(flattened(building.point(vertex), axis, is_positive));
    return flat;
  };
  FlatPolygon flat = seen(true);
  return orientation(flat.rings[0]) >= 0 ? flat : seen(false);
}

bool have_good_points(const SnappedPolygon& polygon, FindingList& findings) {
  if (polygon.rings.empty()) {
    findings.add(Defect::too_few_points, subject_of(polygon, 0),
                 fmt::format("polygon {} has no ring", polygon.number));
    return false;
  }
  bool is_good = true;
  for (std::size_t i = 0; i < polygon.rings.size(); ++i)
    is_good = has_good_points(polygon, i, findings) && is_good;
  return is_good;
}

bool are_simple(const SnappedPolygon& polygon, const FlatPolygon& flat, FindingList& findings) {
  bool is_good = true;
  for (std::size_t i = 0; i < flat.rings.size(); ++i)
    is_good = is_simple(polygon, flat, i, findings) && is_good;
  return is_good;
}

bool are_holes_turned_well(const SnappedPolygon& polygon, const FlatPolygon& flat,
                           FindingList& findings) {
  bool is_good = true;
  for (std::size_t i = 1; i < flat.rings.size(); ++i) {
    if (orientation(flat.rings[i]) < 0) continue;
    findings.add(Defect::holes_turned, subject_of(polygon, i),
                 fmt::format("{} runs the same way round as the outer ring; expected the other way",
                             name_of(polygon, i)),
                 {polygon.rings[i][0]});
    is_good = false;
  }
  return is_good;
}

bool lie_well(const SnappedPolygon& polygon, const FlatPolygon& flat, FindingList& findings) {
  if (flat.rings.size() == 1) return true;
  std::set<Touch> touches;
  return are_different(polygon, flat, findings) && are_apart(polygon, flat, touches, findings) &&
         is_in_one_piece(polygon, flat, touches, findings) &&
         are_holes_placed_well(polygon, flat, findings);
}

}  // namespace oriel::detail
