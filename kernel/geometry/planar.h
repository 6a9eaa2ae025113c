#pragma once

#include "model/vec3.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

/// Plane figures given as loops of points in space, all in one plane.
namespace oriel {

using Outline = std::vector<Vec3>;
/// The points of an outline that stand elsewhere.
using OutlineView = std::span<const Vec3>;

/// A figure thinner than this (its area below kThin_m times its perimeter) may have an area of
/// either sign by rounding.
inline constexpr double kThin_m = 1e-9;

/// The signed area of a closed outline about a unit normal: positive if counter-clockwise.
double signed_area(const Outline& outline, Vec3 normal);

/// Whether a point comes before another one: by x, then y, then z.
constexpr bool is_lesser(Vec3 p, Vec3 q) {
  // Without a branch, which would be foreseen as often as not.
  return (p.x < q.x) | ((p.x == q.x) & ((p.y < q.y) | ((p.y == q.y) & (p.z < q.z))));
}

/// Turns a closed outline so that it begins at its least point (is_lesser).
void start_at_least(Outline& outline);

/// The length of a closed outline.
double perimeter(const Outline& outline);

/// True if `point` is inside: even-odd over all outlines, seen along the normal's largest axis.
/// Points on an outline may fall on either side.
bool contains(std::span<const Outline> outlines, Vec3 normal, Vec3 point);

/// True if `point` is inside, and not within `margin_m` of an outline.
bool contains_clearly(std::span<const Outline> outlines, Vec3 normal, Vec3 point, double margin_m);

/// How far a point is from a segment.
inline double distance_to_segment(Vec3 point, Vec3 from, Vec3 to) {
  const Vec3 along = to - from;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(point - from, along) / square, 0.0, 1.0) : 0;
  return length(point - (from + t * along));
}

/// True if the segments a b and c d cross, seen along the normal, their ends no nearer to the line
/// of the other one than `slack_m`.
bool do_cross(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 normal, double slack_m = 0);

/// A point inside the figure, as far from its outlines as the longest chord at the middle of the
/// tallest gap between its vertices allows. Outlines may run over each other. Nothing if the figure
/// has no area, or is thinner than kThin_m.
std::optional<Vec3> interior_point(std::span<const Outline> outlines, Vec3 normal);
std::optional<Vec3> interior_point_of(std::span<const OutlineView> outlines, Vec3 normal);

/// The solid angle under which the figure is seen from `eye`, as a part of the full sphere:
/// positive where its outer outline runs clockwise for the eye, that is, from behind its normal.
/// Over all facets of a closed surface the parts add up to its winding number: 1 inside, 0 outside,
/// any value between on the surface.
double winding_part(std::span<const Outline> outlines, Vec3 eye);

/// Something parallel to a plane: how far it lies before it (negative: behind it), and its area.
struct ParallelArea {
  double offset_m = 0;
  double area_m2 = 0;
};

/// The level, seen from before the plane, down to which parallel areas cover half of an outline of
/// `outline_m2`: that of the pane, not of a narrow frame before it or of what stands behind it. If
/// all together cover less, the level of the last of them; nothing if there are none. Sorts them.
std::optional<double> visible_level(std::span<ParallelArea> areas, double outline_m2);

/// The rectangle that points take up in a plane.
struct Reach {
  double u0 = Box::kInfinity, u1 = -Box::kInfinity, v0 = Box::kInfinity, v1 = -Box::kInfinity;

  [[nodiscard]] bool is_empty() const { return u0 > u1 || v0 > v1; }
  [[nodiscard]] double area() const { return (u1 - u0) * (v1 - v0); }
  [[nodiscard]] bool holds(const Reach& r, double slack) const {
    return r.u0 >= u0 - slack && r.u1 <= u1 + slack && r.v0 >= v0 - slack && r.v1 <= v1 + slack;
  }
  [[nodiscard]] Reach common(const Reach& r) const {
    return {std::max(u0, r.u0), std::min(u1, r.u1), std::max(v0, r.v0), std::min(v1, r.v1)};
  }
};

/// Two directions in a plane; `u` is level unless the plane is.
struct ReachAxes {
  Vec3 u, v;

  [[nodiscard]] Reach reach_of(const std::vector<Vec3>& points) const {
    Reach reach;
    for (const Vec3 p : points) grow(reach, p);
    return reach;
  }
  void grow(Reach& reach, Vec3 p) const {
    const double along_u = dot(p, u), along_v = dot(p, v);
    reach.u0 = std::min(reach.u0, along_u);
    reach.u1 = std::max(reach.u1, along_u);
    reach.v0 = std::min(reach.v0, along_v);
    reach.v1 = std::max(reach.v1, along_v);
  }
};

inline ReachAxes axes_in(Vec3 normal) {
  const Vec3 any = std::abs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 u = normalised(cross(any, normal));
  return {u, cross(normal, u)};
}

}  // namespace oriel
