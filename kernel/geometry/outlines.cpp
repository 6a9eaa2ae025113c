#include "kernel/geometry/outlines.h"

#include "kernel/geometry/exact.h"

namespace oriel {

std::vector<Outline> outlines_of(const Building& building, const Polygon& polygon, double grid_m) {
  std::vector<Outline> outlines = outlines_of(building, polygon);
  for (Outline& outline : outlines)
    for (Vec3& p : outline) p = exact::on_grid(p, grid_m);
  return outlines;
}

std::vector<Outline> outlines_of(const Building& building, const Polygon& polygon) {
  std::vector<Outline> outlines;
  outlines.reserve(polygon.rings.size());
  for (const auto& ring : polygon.rings) {
    Outline& outline = outlines.emplace_back();
    outline.reserve(ring.size());
    for (const int v : ring) outline.push_back(building.vertices[static_cast<std::size_t>(v)]);
  }
  return outlines;
}

std::vector<Outline> outlines_of(std::span<const Vertex> vertices, const std::vector<Loop>& loops) {
  std::vector<Outline> outlines;
  outlines.reserve(loops.size());
  for (const Loop& loop : loops) {
    Outline& outline = outlines.emplace_back();
    outline.reserve(loop.size());
    for (const int v : loop) outline.push_back(vertices[static_cast<std::size_t>(v)].point);
  }
  return outlines;
}

namespace {

/// The part of an outline behind a plane. Of one that is not convex the pieces stay joined by edges
/// that run back on themselves in the plane, which have no area.
Outline clipped(const Outline& outline, const HalfSpaceM& limit) {
  Outline out;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 p = outline[i], q = outline[(i + 1) % outline.size()];
    const double dp = dot(limit.normal, p) - limit.offset_m;
    const double dq = dot(limit.normal, q) - limit.offset_m;
    if (dp <= 0) out.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) out.push_back(p + (dp / (dp - dq)) * (q - p));
  }
  return out;
}

}  // namespace

double area_within(std::span<const Vertex> vertices, const Facet& facet, Vec3 normal,
                   const std::vector<HalfSpaceM>& limits) {
  double area_m2 = 0;
  for (const Loop& loop : facet.loops) {
    Outline outline;
    for (const int v : loop) outline.push_back(vertices[static_cast<std::size_t>(v)].point);
    for (const HalfSpaceM& limit : limits) outline = clipped(outline, limit);
    if (outline.size() > 2) area_m2 += signed_area(outline, normal);
  }
  return area_m2;
}

}  // namespace oriel
