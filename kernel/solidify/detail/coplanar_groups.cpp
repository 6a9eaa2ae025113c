#include "kernel/solidify/detail/coplanar_groups.h"

#include "kernel/solidify/detail/disjoint_sets.h"
#include "kernel/solidify/detail/polygon_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A plane in doubles: enough to compare distances with a tolerance.
struct RoughPlane {
  Vec3 normal, point;
  [[nodiscard]] double distance(Vec3 p) const { return std::abs(dot(normal, p - point)); }
};

/// What is known of a group, in grid units.
struct Group {
  Vec3 area_vector;        ///< the normal times the area, summed over its polygons
  double area = 0;         ///< of its polygons, added up
  Vec3 moment;             ///< area times centre, added up
  double uncertainty = 0;  ///< how far its normal may be off, radians
  double residual = 0;     ///< no vertex lies further from its plane
  Box box;
  std::vector<int> points;

  [[nodiscard]] RoughPlane plane() const { return {normalised(area_vector), (1 / area) * moment}; }
};

class Grouper {
 public:
  Grouper(const Soup& soup, const ShellMesh& mesh, const Tolerances& tolerances)
      : soup_(soup),
        mesh_(mesh),
        reach_(tolerances.plane_offset_m / soup.grid_m),
        angle_(tolerances.coplanar_deg * std::numbers::pi / 180),
        sets_(soup.polygons.size()) {}

  CoplanarGroups run() {
    for (int p = 0; p < soup_.polygon_count(); ++p) shapes_.push_back(shape_of(soup_, p));
    std::vector<Pair> pairs = likely_pairs();
    if (!pairs.empty()) {
      for (int p = 0; p < soup_.polygon_count(); ++p) groups_.push_back(group_of(p));
      // What two groups refuse may suit them when they have grown and their normals are surer.
      while (std::erase_if(pairs, [&](const Pair& pair) { return unite(pair.first, pair.second); }))
        ;
      take_in_slivers();
    }
    return numbered();
  }

 private:
  struct Pair {
    double smaller_area;
    int first, second;
  };

  [[nodiscard]] Vec3 point(int v) const {
    const exact::GridPoint& p = soup_.points[at(v)];
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }

  /// Neighbours with area whose normals may be those of one plane, the largest first.
  [[nodiscard]] std::vector<Pair> likely_pairs() const {
    std::vector<Pair> pairs;
    for (std::size_t h = 0; h < mesh_.half_edge_count(); ++h) {
      const int twin = mesh_.twin[h];
      if (twin < static_cast<int>(h)) continue;
      const int p = mesh_.polygon_of[h], q = mesh_.polygon_of[at(twin)];
      const PolygonShape &a = shapes_[at(p)], &b = shapes_[at(q)];
      if (p == q || !a.normal || !b.normal) continue;
      const double allowed = 2 * angle_ + a.uncertainty_rad(reach_) + b.uncertainty_rad(reach_);
      if (is_angle_above(a.unit, b.unit, allowed)) continue;
      pairs.push_back({std::min(a.area, b.area), std::min(p, q), std::max(p, q)});
    }
    std::ranges::sort(pairs, [](const Pair& x, const Pair& y) {
      return std::tuple(-x.smaller_area, x.first, x.second) <
             std::tuple(-y.smaller_area, y.first, y.second);
    });
    return pairs;
  }

  [[nodiscard]] Group group_of(int polygon) const {
    const PolygonShape& shape = shapes_[at(polygon)];
    Group group;
    const auto corners = soup_.corners_of(polygon);
    group.points.assign(corners.begin(), corners.end());
    group.area = shape.area;
    group.area_vector = shape.area * shape.unit;
    group.uncertainty = shape.uncertainty_rad(reach_);
    Vec3 sum;
    for (const int v : group.points) {
      sum = sum + point(v);
      group.box.grow(point(v));
    }
    group.moment = (shape.area / static_cast<double>(group.points.size())) * sum;
    if (shape.normal) group.residual = residual_of(group, group.plane());
    return group;
  }

  [[nodiscard]] double residual_of(const Group& group, const RoughPlane& plane) const {
    double residual = 0;
    for (const int v : group.points) residual = std::max(residual, plane.distance(point(v)));
    return residual;
  }

  /// No smaller than the residual: that of the group's own plane, and how far the two planes are
  /// apart in its box.
  [[nodiscard]] static double residual_bound(const Group& group, const RoughPlane& plane) {
    const RoughPlane own = group.plane();
    const Vec3 turn = plane.normal - own.normal, half = 0.5 * (group.box.max - group.box.min),
               middle = group.box.min + half;
    return group.residual +
           std::abs(dot(plane.normal, middle - plane.point) - dot(own.normal, middle - own.point)) +
           std::abs(turn.x) * half.x + std::abs(turn.y) * half.y + std::abs(turn.z) * half.z;
  }

  /// What stands across a plane, at more than 45°, may be the side of a recess, so it is left alone
  /// however thin it is.
  [[nodiscard]] static bool is_angle_above(Vec3 p, Vec3 q, double limit) {
    return dot(p, q) <= 0 ||
           is_arcsine_above(length(cross(p, q)), std::min(limit, std::numbers::pi / 4));
  }

  [[nodiscard]] bool is_tilted_too_far(const Group& group, const RoughPlane& plane) const {
    return is_angle_above(normalised(group.area_vector), plane.normal, angle_ + group.uncertainty);
  }

  /// True if they are one group now, or were one before.
  bool unite(int p, int q) {
    const int first = sets_.find(p), second = sets_.find(q);
    if (first == second) return true;
    Group *large = &groups_[at(first)], *small = &groups_[at(second)];
    if (large->points.size() < small->points.size()) std::swap(large, small);

    const Vec3 area_vector = large->area_vector + small->area_vector;
    if (length(area_vector) <= 0) return false;
    const double area = large->area + small->area;
    const Vec3 moment = large->moment + small->moment;
    const RoughPlane plane{normalised(area_vector), (1 / area) * moment};
    if (is_tilted_too_far(*large, plane) || is_tilted_too_far(*small, plane)) return false;
    const double residual_small = residual_of(*small, plane);
    if (residual_small > reach_) return false;
    double residual_large = residual_bound(*large, plane);
    if (residual_large > reach_) residual_large = residual_of(*large, plane);
    if (residual_large > reach_) return false;

    large->points.insert(large->points.end(), small->points.begin(), small->points.end());
    large->box.grow(small->box);
    large->area_vector = area_vector;
    large->area = area;
    large->moment = moment;
    large->residual = std::max(residual_small, residual_large);
    large->uncertainty = std::min(large->uncertainty, small->uncertainty);
    if (large != &groups_[at(std::min(first, second))]) std::swap(*large, *small);
    sets_.unite(first, second);
    return true;
  }

  /// Polygons without a normal to speak of join the group that they share more than half of their
  /// outline with, if all their vertices lie in its plane. A sliver in a wall does so, even at the
  /// wall's edge: two sides of a triangle are longer than the third. The side of a recess does not:
  /// it shares as much with the wall as with the floor.
  void take_in_slivers() {
    std::vector<int> slivers;
    for (int p = 0; p < soup_.polygon_count(); ++p)
      if (groups_[at(p)].uncertainty > std::numbers::pi / 2 && is_alone(p)) slivers.push_back(p);
    while (std::erase_if(slivers, [&](int p) { return take_in(p); }))
      ;
  }

  [[nodiscard]] bool is_alone(int p) {
    return sets_.find(p) == p && groups_[at(p)].points.size() == soup_.corners_of(p).size();
  }

  bool take_in(int p) {
    const int group = group_around(p);
    if (group < 0) return false;
    const Group& sliver = groups_[at(p)];
    Group grown = groups_[at(group)];
    const double residual = residual_of(sliver, grown.plane());
    if (residual > reach_) return false;
    grown.points.insert(grown.points.end(), sliver.points.begin(), sliver.points.end());
    grown.box.grow(sliver.box);
    grown.residual = std::max(grown.residual, residual);
    sets_.unite(p, group);
    groups_[at(sets_.find(p))] = std::move(grown);
    return true;
  }

  /// The group with area that a polygon shares more than half of its outline with, or -1.
  [[nodiscard]] int group_around(int p) {
    std::vector<std::pair<int, double>> shared;  // groups and lengths
    double outline = 0;
    for (const int r : soup_.rings_of(p))
      for (int h = soup_.first_corner[at(r)]; h < soup_.first_corner[at(r) + 1]; ++h) {
        const double edge =
            length(point(soup_.corners[at(mesh_.next[at(h)])]) - point(soup_.corners[at(h)]));
        outline += edge;
        if (mesh_.twin[at(h)] < 0) continue;
        const int group = sets_.find(mesh_.polygon_of[at(mesh_.twin[at(h)])]);
        const auto known = std::ranges::find(shared, group, &std::pair<int, double>::first);
        if (known != shared.end())
          known->second += edge;
        else
          shared.emplace_back(group, edge);
      }
    for (const auto& [group, edges] : shared)
      if (group != sets_.find(p) && 2 * edges > outline && groups_[at(group)].area > 0)
        return group;
    return -1;
  }

  CoplanarGroups numbered() {
    CoplanarGroups out;
    std::vector<int> number(soup_.polygons.size(), -1);
    for (int p = 0; p < soup_.polygon_count(); ++p) {
      int& n = number[at(sets_.find(p))];
      if (n < 0) n = out.count++;
      out.group_of.push_back(n);
    }
    return out;
  }

  const Soup& soup_;
  const ShellMesh& mesh_;
  double reach_;  ///< grid units
  double angle_;
  DisjointSets sets_;
  std::vector<PolygonShape> shapes_;
  std::vector<Group> groups_;  ///< by the set's smallest member
};

}  // namespace

CoplanarGroups group_coplanar(const Soup& soup, const ShellMesh& mesh,
                              const Tolerances& tolerances) {
  return Grouper(soup, mesh, tolerances).run();
}

Soup soup_of_groups(const Soup& soup, const CoplanarGroups& groups) {
  std::vector<std::vector<int>> members(at(groups.count));
  for (int p = 0; p < soup.polygon_count(); ++p) members[at(groups.group_of[at(p)])].push_back(p);
  Soup out;
  out.grid_m = soup.grid_m;
  out.points = soup.points;
  out.polygons.resize(members.size());
  for (const auto& polygons : members) {
    for (const int p : polygons)
      for (const int r : soup.rings_of(p)) {
        const auto ring = soup.ring(r);
        out.corners.insert(out.corners.end(), ring.begin(), ring.end());
        out.first_corner.push_back(out.corner_count());
      }
    out.first_ring.push_back(out.ring_count());
  }
  return out;
}

}  // namespace oriel::detail
