#include "kernel/validate/proof/patches.h"

#include "kernel/base/index.h"
#include "kernel/validate/polygons/polygon_checks.h"
#include "kernel/validate/polygons/ring_checks.h"
#include "kernel/validate/solids/predicates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace oriel::detail {

namespace {

using TurnCorners = std::array<int, 3>;

Vec3 in_doubles(const MicrometrePoint& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

class PatchMaker {
 public:
  PatchMaker(const SnappedBuilding& building, const ValidateOptions& options)
      : building_(building),
        options_(options),
        findings_(building, options.budget),
        last_of_(building.points.size(), -1) {}

  std::optional<Patches> run() {
    for (std::size_t p = 0; p < building_.polygons.size(); ++p)
      if (!add(p)) return std::nullopt;
    return std::move(out_);
  }

 private:
  [[nodiscard]] const MicrometrePoint& point(int vertex) const { return building_.point(vertex); }

  bool add(std::size_t number) {
    const SnappedPolygon& polygon = building_.polygons[number];
    if (!comes_once_to_each(polygon, static_cast<int>(number))) return false;
    const auto corners = corners_in_plane(polygon);
    if (!corners) return add_triangles(number);
    const auto turned = turned_as_ring(polygon, *corners);
    if (!turned) return false;
    add_patch(number, polygon.rings, *turned);
    return true;
  }

  /// Every ring has three points or more, and no point is there twice.
  bool comes_once_to_each(const SnappedPolygon& polygon, int number) {
    for (const auto& ring : polygon.rings) {
      if (ring.size() < 3) return false;
      for (const int v : ring)
        if (std::exchange(last_of_[at(v)], number) == number) return false;
    }
    return !polygon.rings.empty();
  }

  /// Three corners that are not on a line and have all others in their plane; nothing if there are
  /// none.
  [[nodiscard]] std::optional<TurnCorners> corners_in_plane(const SnappedPolygon& polygon) const {
    const TurnCorners corners = widest_corners(polygon.rings[0]);
    const MicrometrePoint &a = point(corners[0]), &b = point(corners[1]), &c = point(corners[2]);
    if (are_collinear(a, b, c)) return std::nullopt;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (are_level(polygon, axis)) return corners;
    for (const auto& ring : polygon.rings)
      for (const int v : ring)
        if (side_of(a, b, c, point(v)) != 0) return std::nullopt;
    return corners;
  }

  [[nodiscard]] bool are_level(const SnappedPolygon& polygon, std::size_t axis) const {
    const std::int64_t level = point(polygon.rings[0][0])[axis];
    return std::ranges::all_of(polygon.rings, [&](const std::vector<int>& ring) {
      return std::ranges::all_of(ring, [&](int v) { return point(v)[axis] == level; });
    });
  }

  /// The first corner, the one furthest from it, and the one furthest from the line of both.
  [[nodiscard]] TurnCorners widest_corners(const std::vector<int>& ring) const {
    const Vec3 first = in_doubles(point(ring[0]));
    const auto distance = [&](int v) { return length(in_doubles(point(v)) - first); };
    const int second = *std::ranges::max_element(ring, {}, distance);
    const Vec3 along = in_doubles(point(second)) - first;
    const auto height = [&](int v) { return length(cross(along, in_doubles(point(v)) - first)); };
    return {ring[0], second, *std::ranges::max_element(ring, {}, height)};
  }

  /// The corners of a plane polygon whose rings are good, turned as its outer ring.
  std::optional<TurnCorners> turned_as_ring(const SnappedPolygon& polygon, TurnCorners corners) {
    const Vec3 first = in_doubles(point(corners[0]));
    const Vec3 normal =
        cross(in_doubles(point(corners[1])) - first, in_doubles(point(corners[2])) - first);
    const FlatPolygon flat = flat_polygon(building_, polygon, normal);
    const std::size_t axis = flat.axis.x != 0 ? 0 : flat.axis.y != 0 ? 1 : 2;
    const bool is_positive = flat.axis.x + flat.axis.y + flat.axis.z > 0;
    const auto seen = [&](int v) { return flattened(point(v), axis, is_positive); };
    if (!is_convex(flat.rings) &&
        !(are_simple(polygon, flat, findings_) && are_holes_turned_well(polygon, flat, findings_) &&
          lie_well(polygon, flat, findings_)))
      return std::nullopt;
    if (turn(seen(corners[0]), seen(corners[1]), seen(corners[2])) < 0)
      std::swap(corners[1], corners[2]);
    return corners;
  }

  /// A triangle, or a quadrangle that turns left at each corner: it needs no other check.
  [[nodiscard]] static bool is_convex(const std::vector<std::vector<FlatPoint>>& rings) {
    const auto& ring = rings[0];
    if (rings.size() > 1 || ring.size() > 4) return false;
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (turn(ring[i], ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]) <= 0)
        return false;
    return true;
  }

  bool add_triangles(std::size_t number) {
    const SnappedPolygon& polygon = building_.polygons[number];
    const auto judged = judge(building_, polygon, options_, findings_, FoldsBetween::any_two);
    if (!judged.is_good || judged.triangles.empty()) return false;
    for (const TurnCorners& corners : judged.triangles) {
      if (are_collinear(point(corners[0]), point(corners[1]), point(corners[2]))) return false;
      add_patch(number, {{corners.begin(), corners.end()}}, corners);
    }
    return true;
  }

  void add_patch(std::size_t number, const std::vector<std::vector<int>>& rings,
                 const TurnCorners& turned) {
    const auto next = [&] { return out_.corners.next_id(); };
    PlanePatch patch{number, next(), {}, turned, {}};
    for (const auto& ring : rings) {
      const PatchCornerId first = next();
      for (const int v : ring) {
        patch.box.grow(in_doubles(point(v)));
        out_.corners.push_back({v, out_.patches.next_id(), PatchCornerId{next().value + 1}});
      }
      out_.corners.back().next = first;
    }
    patch.end = next();
    out_.patches.push_back(patch);
  }

  const SnappedBuilding& building_;
  const ValidateOptions& options_;
  FindingList findings_;
  std::vector<int> last_of_;  ///< by vertex the last polygon that came to it
  Patches out_;
};

}  // namespace

std::optional<Patches> patches_of(const SnappedBuilding& building, const ValidateOptions& options) {
  return PatchMaker(building, options).run();
}

}  // namespace oriel::detail
