#include "kernel/solidify/planes/coplanar_groups.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/geometry/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// A plane in doubles: enough to compare distances with a tolerance.
struct RoughPlane {
  Vec3 normal, point;
  [[nodiscard]] double distance(Vec3 p) const { return std::abs(dot(normal, p - point)); }
};

/// Sums over points p relative to an origin, to fit a plane to them.
struct PointSums {
  double count = 0;
  Vec3 p, squares, products;  ///< Σ p, Σ (xx, yy, zz), Σ (yz, zx, xy)

  void add(Vec3 q) {
    ++count;
    p = p + q;
    squares = squares + Vec3{q.x * q.x, q.y * q.y, q.z * q.z};
    products = products + Vec3{q.y * q.z, q.z * q.x, q.x * q.y};
  }
  friend PointSums operator+(const PointSums& a, const PointSums& b) {
    return {a.count + b.count, a.p + b.p, a.squares + b.squares, a.products + b.products};
  }
};

/// The plane with the least squared distances along the coordinate axis that is nearest to
/// `normal`, on the side of it; `normal` itself where the points lie on a line.
RoughPlane least_squares(const PointSums& sums, Vec3 normal, Vec3 origin) {
  const Vec3 mean = (1 / sums.count) * sums.p;
  const double n[3] = {normal.x, normal.y, normal.z}, m[3] = {mean.x, mean.y, mean.z},
               squares[3] = {sums.squares.x, sums.squares.y, sums.squares.z},
               products[3] = {sums.products.x, sums.products.y, sums.products.z};
  int w = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(n[i]) > std::abs(n[w])) w = i;
  const int u = (w + 1) % 3, v = (w + 2) % 3;
  const auto spread = [&](int i) { return squares[i] - sums.count * m[i] * m[i]; };
  const auto joint = [&](int i, int j) { return products[3 - i - j] - sums.count * m[i] * m[j]; };
  const double det = spread(u) * spread(v) - joint(u, v) * joint(u, v);
  double fitted[3] = {n[0], n[1], n[2]};
  if (det > 1e-9 * spread(u) * spread(v)) {
    const double sign = n[w] < 0 ? -1 : 1;
    fitted[u] = -sign * (joint(u, w) * spread(v) - joint(v, w) * joint(u, v)) / det;
    fitted[v] = -sign * (joint(v, w) * spread(u) - joint(u, w) * joint(u, v)) / det;
    fitted[w] = sign;
  }
  return {normalised({fitted[0], fitted[1], fitted[2]}), origin + mean};
}

/// What is known of a group, in grid units.
struct PlaneGroup {
  Vec3 area_vector;        ///< the normal times the area, summed over its polygons
  double area = 0;         ///< of its polygons, added up
  Vec3 moment;             ///< area times centre, added up
  double uncertainty = 0;  ///< how far its normal may be off, radians
  PointSums sums;          ///< of its polygons' corners
  RoughPlane plane;
  bool is_fitted = false;  ///< its plane is the one of least squares, not of the area vector
  double residual = 0;     ///< no vertex lies further from its plane
  Box box;
  std::vector<int> points;

  [[nodiscard]] RoughPlane plane_of_areas() const {
    return {normalised(area_vector), (1 / area) * moment};
  }
};

class Grouper {
 public:
  Grouper(const Soup& soup, std::span<const PolygonShape> shapes, const ShellMesh& mesh,
          const Tolerances& tolerances, Work& work)
      : soup_(soup),
        shapes_(shapes),
        mesh_(mesh),
        work_(work),
        reach_(tolerances.plane_offset_m / soup.grid_m),
        angle_(tolerances.coplanar_deg * std::numbers::pi / 180),
        sets_(soup.polygons.size()),
        origin_(soup.points.empty() ? Vec3{} : point(soup.points.front())) {}

  std::optional<CoplanarGroups> run() {
    std::vector<NeighbourPair> pairs = likely_pairs();
    if (pairs.empty()) return std::nullopt;
    for (int p = 0; p < soup_.polygon_count(); ++p) groups_.push_back(group_of(p));
    do {
      unite_all(pairs, Fitting::areas);
      unite_all(pairs, Fitting::corners);
      pairs = take_in_slivers() ? pairs_of_groups() : std::vector<NeighbourPair>{};
    } while (!pairs.empty());
    CoplanarGroups groups = numbered();
    if (groups.count == soup_.polygon_count()) return std::nullopt;
    return groups;
  }

 private:
  /// What stands across a plane, at more than 45°, may be the side of a recess, so it is left alone
  /// however thin it is.
  static constexpr double kMost = std::numbers::pi / 4;
  static constexpr double kCosineOfMost = std::numbers::sqrt2 / 2;
  /// The plane of least squares goes through the middle of whatever it is given, so it is asked
  /// only where the area vectors are nearly right.
  static constexpr double kMostOfCorners = std::numbers::pi / 36;
  /// What is more uncertain than that says nothing of the plane it lies in.
  static constexpr double kSliver = std::numbers::pi / 2;
  /// The longest side of a sliver is half of its outline; so much of it tells it from the others.
  static constexpr double kLongest = 0.45;

  /// What tells the plane of a group: the area vectors of its polygons, or, as a thin frame has
  /// little area for its reach, the corners of all of them by least squares.
  enum class Fitting { areas, corners };

  struct NeighbourPair {
    double smaller_area;
    int first, second;
  };

  static Vec3 point(const exact::GridPoint& p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  }
  [[nodiscard]] Vec3 point(int v) const { return point(soup_.points[at(v)]); }
  [[nodiscard]] double uncertainty_of(int polygon) const {
    return uncertainty_rad(height_of(soup_, polygon, shapes_[at(polygon)].area), reach_);
  }

  static bool has_normal(const PolygonShape& shape) { return shape.normal.has_value(); }

  /// Neighbours with area whose normals may be those of one plane, the largest first. None if all
  /// such normals are equal and no polygon is without area: then there is nothing to fit.
  [[nodiscard]] std::vector<NeighbourPair> likely_pairs() const {
    std::vector<NeighbourPair> pairs;
    bool is_exact = true;
    const int count = soup_.corner_count();
    const int *const twin_of = mesh_.twin.data(), *const polygon_of = mesh_.polygon_of.data();
    for (int h = 0; h < count; ++h) {
      const int twin = twin_of[h];
      if (twin < h) continue;
      const int p = polygon_of[h], q = polygon_of[twin];
      const PolygonShape &a = shapes_[at(p)], &b = shapes_[at(q)];
      // Without area the unit normal is zero.
      if (dot(a.unit, b.unit) < kCosineOfMost || p == q) continue;
      const double of_a = uncertainty_of(p), of_b = uncertainty_of(q);
      if (std::max(of_a, of_b) > kSliver) continue;
      const double allowed = 2 * angle_ + of_a + of_b;
      if (*a.normal != *b.normal && is_angle_above(a.unit, b.unit, allowed)) continue;
      pairs.push_back({std::min(a.area, b.area), std::min(p, q), std::max(p, q)});
      is_exact &= *a.normal == *b.normal;
    }
    if (is_exact && std::ranges::all_of(shapes_, has_normal)) return {};
    sort(pairs);
    return pairs;
  }

  /// Neighbours in different groups that may lie in one plane: a sliver that went to one of them
  /// stood between.
  [[nodiscard]] std::vector<NeighbourPair> pairs_of_groups() {
    std::vector<NeighbourPair> pairs;
    for (int h = 0; h < soup_.corner_count(); ++h) {
      const int twin = mesh_.twin[at(h)];
      if (twin < h) continue;
      const int p = sets_.find(mesh_.polygon_of[at(h)]), q = sets_.find(mesh_.polygon_of[at(twin)]);
      const PlaneGroup &a = groups_[at(p)], &b = groups_[at(q)];
      if (p == q || std::min(a.area, b.area) <= 0) continue;
      if (dot(normalised(a.area_vector), normalised(b.area_vector)) < kCosineOfMost) continue;
      pairs.push_back({std::min(a.area, b.area), std::min(p, q), std::max(p, q)});
    }
    sort(pairs);
    return pairs;
  }

  static void sort(std::vector<NeighbourPair>& pairs) {
    std::ranges::sort(pairs, [](const NeighbourPair& x, const NeighbourPair& y) {
      return std::tuple(-x.smaller_area, x.first, x.second) <
             std::tuple(-y.smaller_area, y.first, y.second);
    });
  }

  [[nodiscard]] PlaneGroup group_of(int polygon) const {
    const PolygonShape& shape = shapes_[at(polygon)];
    PlaneGroup group;
    const auto corners = soup_.corners_of(polygon);
    group.points.assign(corners.begin(), corners.end());
    group.area = shape.area;
    group.area_vector = shape.area * shape.unit;
    group.uncertainty = uncertainty_of(polygon);
    Vec3 sum;
    for (const int v : group.points) {
      sum = sum + point(v);
      group.sums.add(point(v) - origin_);
      group.box.grow(point(v));
    }
    group.moment = (shape.area / static_cast<double>(group.points.size())) * sum;
    if (!shape.normal) return group;
    group.plane = group.plane_of_areas();
    group.residual = residual_of(group, group.plane);
    return group;
  }

  [[nodiscard]] double residual_of(const PlaneGroup& group, const RoughPlane& plane) const {
    double residual = 0;
    work_.add(std::ssize(group.points));
    for (const int v : group.points) residual = std::max(residual, plane.distance(point(v)));
    return residual;
  }

  /// No smaller than the residual: that of the group's own plane, and how far the two planes are
  /// apart in its box.
  [[nodiscard]] static double residual_bound(const PlaneGroup& group, const RoughPlane& plane) {
    const RoughPlane& own = group.plane;
    const Vec3 turn = plane.normal - own.normal, half = 0.5 * (group.box.max - group.box.min),
               middle = group.box.min + half;
    return group.residual +
           std::abs(dot(plane.normal, middle - plane.point) - dot(own.normal, middle - own.point)) +
           std::abs(turn.x) * half.x + std::abs(turn.y) * half.y + std::abs(turn.z) * half.z;
  }

  [[nodiscard]] static bool is_angle_above(Vec3 p, Vec3 q, double limit) {
    return dot(p, q) <= 0 || is_arcsine_above(length(cross(p, q)), limit);
  }

  [[nodiscard]] bool is_tilted_too_far(const PlaneGroup& group, const PlaneGroup& united) const {
    const double most = united.is_fitted ? kMostOfCorners : kMost;
    return is_angle_above(normalised(group.area_vector), united.plane.normal,
                          std::min(angle_ + group.uncertainty, most));
  }

  /// True if both groups fit the plane of what they make together; sets its residual.
  [[nodiscard]] bool fits(const PlaneGroup& large, const PlaneGroup& small,
                          PlaneGroup& united) const {
    const RoughPlane& plane = united.plane;
    if (is_tilted_too_far(large, united) || is_tilted_too_far(small, united)) return false;
    const double of_small = residual_of(small, plane);
    if (of_small > reach_) return false;
    double of_large = residual_bound(large, plane);
    if (of_large > reach_) of_large = residual_of(large, plane);
    united.residual = std::max(of_small, of_large);
    return of_large <= reach_;
  }

  /// Unites what goes together and drops those pairs. What two groups refuse may suit them when
  /// they have grown and their normals are surer.
  void unite_all(std::vector<NeighbourPair>& pairs, Fitting fitting) {
    const auto is_united = [&](const NeighbourPair& pair) {
      return unite(pair.first, pair.second, fitting);
    };
    while (std::erase_if(pairs, is_united) > 0) {
    }
  }

  /// True if they are one group now, or were one before.
  bool unite(int p, int q, Fitting fitting) {
    const int first = sets_.find(p), second = sets_.find(q);
    if (first == second) return true;
    work_.add(1);
    if (work_.is_used_up()) return false;
    PlaneGroup *large = &groups_[at(first)], *small = &groups_[at(second)];
    if (large->points.size() < small->points.size()) std::swap(large, small);

    PlaneGroup united;
    united.area_vector = large->area_vector + small->area_vector;
    if (length(united.area_vector) <= 0) return false;
    united.area = large->area + small->area;
    united.moment = large->moment + small->moment;
    united.sums = large->sums + small->sums;
    united.uncertainty = std::min(large->uncertainty, small->uncertainty);
    united.plane = united.plane_of_areas();
    if (fitting == Fitting::corners) {
      united.plane = least_squares(united.sums, united.plane.normal, origin_);
      united.is_fitted = true;
    }
    if (!fits(*large, *small, united)) return false;
    united.box = large->box;
    united.box.grow(small->box);
    united.points = std::move(large->points);
    united.points.insert(united.points.end(), small->points.begin(), small->points.end());
    *large = std::move(united);
    if (large != &groups_[at(std::min(first, second))]) std::swap(*large, *small);
    sets_.unite(first, second);
    return true;
  }

  /// Slivers that hang together: a fan of them lies along a row of windows, between the wall above
  /// and the piers below.
  using Strip = std::vector<int>;

  /// Polygons without a normal to speak of join the group that they share more than half of their
  /// outline with, if all their vertices lie in its plane. A sliver in a wall does so, even at the
  /// wall's edge: two sides of a triangle are longer than the third. The side of a recess does not:
  /// it shares as much with the wall as with the floor. First each for itself, then strip by strip.
  /// Returns whether any did.
  bool take_in_slivers() {
    std::vector<Strip> strips;
    strip_of_.assign(soup_.polygons.size(), -1);
    for (int p = 0; p < soup_.polygon_count(); ++p)
      if (is_sliver(p) && is_alone(p)) add_strip(strips, {p});
    const bool any = take_in(strips);
    join_along_longest_sides(strips);
    return take_in(strips) || any;
  }

  [[nodiscard]] bool is_sliver(int group) const { return groups_[at(group)].uncertainty > kSliver; }

  [[nodiscard]] bool is_alone(int p) {
    return sets_.find(p) == p && groups_[at(p)].points.size() == soup_.corners_of(p).size();
  }

  void add_strip(std::vector<Strip>& strips, Strip strip) {
    for (const int p : strip) strip_of_[at(p)] = static_cast<int>(strips.size());
    strips.push_back(std::move(strip));
  }

  /// Until none joins a group any more; keeps those that have not.
  bool take_in(std::vector<Strip>& strips) {
    const std::size_t before = strips.size();
    while (std::erase_if(strips, [&](const Strip& strip) { return take_in(strip); }) > 0) {
    }
    return strips.size() < before;
  }

  bool take_in(const Strip& strip) {
    const int group = group_around(strip);
    if (group < 0 || work_.is_used_up()) return false;
    PlaneGroup grown = groups_[at(group)];
    work_.add(std::ssize(grown.points));
    for (const int p : strip) {
      const PlaneGroup& sliver = groups_[at(p)];
      const double residual = residual_of(sliver, grown.plane);
      if (residual > reach_) return false;
      grown.points.insert(grown.points.end(), sliver.points.begin(), sliver.points.end());
      grown.box.grow(sliver.box);
      grown.residual = std::max(grown.residual, residual);
    }
    for (const int p : strip) sets_.unite(p, group);
    groups_[at(sets_.find(group))] = std::move(grown);
    for (const int p : strip) strip_of_[at(p)] = -1;
    return true;
  }

  /// Makes strips of single slivers longer, where they meet along the longest side of one.
  void join_along_longest_sides(std::vector<Strip>& strips) {
    DisjointSets sets(strips.size());
    for (std::size_t s = 0; s < strips.size(); ++s)
      strip_of_[at(strips[s].front())] = static_cast<int>(s);
    for (std::size_t s = 0; s < strips.size(); ++s) {
      double outline = 0;
      for_each_edge(strips[s].front(), [&](int, double length) { outline += length; });
      for_each_edge(strips[s].front(), [&](int twin, double length) {
        const int other = twin < 0 ? -1 : strip_of_[at(mesh_.polygon_of[at(twin)])];
        if (other >= 0 && length > kLongest * outline) sets.unite(static_cast<int>(s), other);
      });
    }
    std::vector<Strip> joined(strips.size());
    for (std::size_t s = 0; s < strips.size(); ++s)
      joined[at(sets.find(static_cast<int>(s)))].push_back(strips[s].front());
    strips.clear();
    for (Strip& strip : joined)
      if (!strip.empty()) add_strip(strips, std::move(strip));
  }

  /// Of each edge of a polygon its twin, or -1, and its length.
  template <typename Visit>
  void for_each_edge(int polygon, Visit visit) const {
    for (const int r : soup_.rings_of(polygon))
      for (int h = soup_.first_corner[at(r)]; h < soup_.first_corner[at(r) + 1]; ++h)
        visit(mesh_.twin[at(h)],
              length(point(soup_.corners[at(mesh_.next[at(h)])]) - point(soup_.corners[at(h)])));
  }

  /// A group that a strip shares so much of its outline with.
  struct SharedOutline {
    int group;
    double length;
  };

  /// The group with area that a strip shares more than half of its outline with, or -1. Two that
  /// together have more than half become one if they fit: the wall above a row of windows has no
  /// more than half of the strip between them, and the piers have the rest.
  [[nodiscard]] int group_around(const Strip& strip) {
    double outline = 0;
    const std::vector<SharedOutline> contacts = contacts_of(strip, outline);
    for (const SharedOutline& contact : contacts)
      if (2 * contact.length > outline) return contact.group;
    for (std::size_t i = 0; i < contacts.size(); ++i)
      for (std::size_t j = i + 1; j < contacts.size(); ++j)
        if (2 * (contacts[i].length + contacts[j].length) > outline &&
            unite_across(strip, contacts[i].group, contacts[j].group))
          return sets_.find(contacts[i].group);
    return -1;
  }

  bool unite_across(const Strip& strip, int first, int second) {
    for (const int group : {first, second}) {
      const RoughPlane& plane = groups_[at(group)].plane;
      if (is_sliver(group) || std::ranges::any_of(strip, [&](int p) {
            return residual_of(groups_[at(p)], plane) > reach_;
          }))
        return false;
    }
    if (dot(groups_[at(first)].plane.normal, groups_[at(second)].plane.normal) < kCosineOfMost)
      return false;
    return unite(first, second, Fitting::areas) || unite(first, second, Fitting::corners);
  }

  /// The groups with area along a strip, and the length of its outline.
  [[nodiscard]] std::vector<SharedOutline> contacts_of(const Strip& strip, double& outline) {
    std::vector<SharedOutline> contacts;
    for (const int p : strip)
      for_each_edge(p, [&](int twin, double length) {
        if (twin >= 0 && strip_of_[at(mesh_.polygon_of[at(twin)])] == strip_of_[at(p)]) return;
        outline += length;
        if (twin < 0) return;
        const int group = sets_.find(mesh_.polygon_of[at(twin)]);
        if (groups_[at(group)].area <= 0) return;
        const auto known = std::ranges::find(contacts, group, &SharedOutline::group);
        if (known != contacts.end())
          known->length += length;
        else
          contacts.push_back({group, length});
      });
    return contacts;
  }

  CoplanarGroups numbered() {
    CoplanarGroups out;
    out.group_of.reserve(soup_.polygons.size());
    std::vector<int> number(soup_.polygons.size(), -1);
    for (int p = 0; p < soup_.polygon_count(); ++p) {
      const int set = sets_.find(p);
      int& n = number[at(set)];
      if (n < 0) {
        n = out.count++;
        out.fitted_normal.emplace_back();
        if (groups_[at(set)].is_fitted) out.fitted_normal.back() = groups_[at(set)].plane.normal;
      }
      out.group_of.push_back(n);
    }
    return out;
  }

  const Soup& soup_;
  std::span<const PolygonShape> shapes_;
  const ShellMesh& mesh_;
  Work& work_;
  double reach_;  ///< grid units
  double angle_;
  DisjointSets sets_;
  Vec3 origin_;                     ///< of the sums over points: near them
  std::vector<PlaneGroup> groups_;  ///< by the set's smallest member
  std::vector<int> strip_of_;       ///< by polygon: the strip of slivers it is in, or -1
};

}  // namespace

std::optional<CoplanarGroups> group_coplanar(const Soup& soup, std::span<const PolygonShape> shapes,
                                             const ShellMesh& mesh, const Tolerances& tolerances,
                                             Work& work) {
  ORIEL_ASSERT(shapes.size() == soup.polygons.size());
  ORIEL_ASSERT(mesh.twin.size() == soup.corners.size(), "the mesh is of another soup");
  return Grouper(soup, shapes, mesh, tolerances, work).run();
}

Soup soup_of_groups(const Soup& soup, const CoplanarGroups& groups) {
  ORIEL_ASSERT(groups.group_of.size() == soup.polygons.size());
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
