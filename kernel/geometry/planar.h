#pragma once

#include "kernel/model/vec3.h"

#include <optional>
#include <span>
#include <vector>

/// Plane figures given as loops of points in space, all in one plane.
namespace oriel::detail {

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
double distance_to_segment(Vec3 point, Vec3 from, Vec3 to);

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

}  // namespace oriel::detail
