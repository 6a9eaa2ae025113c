#include "generalise/invariants/party_walls.h"

#include "kernel/base/index.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/outlines.h"
#include "kernel/model/vec3.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oriel {

namespace {

/// How far walls of two buildings may be from each other, and how far one may lean: they come to
/// the millimetre.
constexpr double kNear_m = 0.01;
constexpr double kLean = 0.01;
/// What is smaller is touched along an edge only.
constexpr double kLeast_m2 = 1e-4;

using detail::HalfSpaceM;
using detail::Outline;

/// The area of a facet that lies in an outline, both in one plane: the sum over the triangles that
/// the outline's edges make with its first point, those that run the other way round taken off.
double area_in(const Solid& solid, const Facet& facet, const Outline& outline, Vec3 normal) {
  double sum_m2 = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    Outline triangle{outline[0], outline[i], outline[i + 1]};
    const double area_m2 = detail::signed_area(triangle, normal);
    if (area_m2 == 0) continue;
    if (area_m2 < 0) std::swap(triangle[1], triangle[2]);
    std::vector<HalfSpaceM> limits;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 outwards = cross(triangle[(k + 1) % 3] - triangle[k], normal);
      limits.push_back({outwards, dot(outwards, triangle[k])});
    }
    const Vec3 its = solid.planes[facet.plane.index()].normal;
    const double within_m2 = detail::area_within(solid.vertices, facet, its, limits);
    sum_m2 += area_m2 < 0 ? -within_m2 : within_m2;
  }
  return sum_m2;
}

double shared_m2(const Solid& solid, const PartyWall& wall) {
  double sum_m2 = 0;
  for (const Facet& facet : solid.facets) {
    const Plane& plane = solid.planes[facet.plane.index()];
    if (length(plane.normal + wall.normal) > kLean) continue;
    const auto distance_m = [&](Vec3 p) { return std::abs(dot(plane.normal, p) - plane.offset_m); };
    const bool is_near =
        std::ranges::all_of(wall.outlines[0], [&](Vec3 p) { return distance_m(p) <= kNear_m; });
    if (!is_near) continue;
    // The outer outline runs round its normal, inner ones the other way: their areas are negative.
    for (const Outline& outline : wall.outlines)
      sum_m2 += area_in(solid, facet, outline, wall.normal);
  }
  return sum_m2;
}

PartyWall wall_of(const Building& building, const Polygon& polygon, Vec3 moved_m) {
  PartyWall wall;
  for (const auto& ring : polygon.rings) {
    Outline& outline = wall.outlines.emplace_back();
    for (const int v : ring) outline.push_back(building.vertices[at(v)] + moved_m);
  }
  wall.normal = normalised(area_vector(wall.outlines[0]));
  return wall;
}

bool is_beside(const PartyWall& wall, const Box& box) {
  Box its;
  for (const Vec3 p : wall.outlines[0]) its.grow(p);
  return overlap(its, box);
}

}  // namespace

std::vector<PartyWall> party_walls(const Building& building, const Solid& solid,
                                   std::span<const Building> buildings) {
  const Box near = grown(box_of(solid), kNear_m);
  std::vector<PartyWall> walls;
  for (const Building& other : buildings) {
    if (other.id == building.id) continue;
    const Vec3 moved_m = other.frame.origin_m - building.frame.origin_m;
    for (const Polygon& polygon : other.polygons) {
      PartyWall wall = wall_of(other, polygon, moved_m);
      if (std::abs(wall.normal.z) > kLean || !is_beside(wall, near)) continue;
      if (shared_m2(solid, wall) > kLeast_m2) walls.push_back(std::move(wall));
    }
  }
  return walls;
}

double shared_m2(const Solid& solid, const std::vector<PartyWall>& walls) {
  double sum_m2 = 0;
  for (const PartyWall& wall : walls) sum_m2 += shared_m2(solid, wall);
  return sum_m2;
}

}  // namespace oriel
