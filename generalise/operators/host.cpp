#include "generalise/operators/host.h"

#include "kernel/attach/clearance.h"
#include "kernel/attach/move_facet.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/directions.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/flush/draw_imprints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace oriel::detail {

namespace {

constexpr Vec3 kUp{0, 0, 1};

/// Of a facet that lies flat: along the first wall.
Vec3 along_a_wall(const Solid& solid) {
  for (const Plane& plane : solid.planes)
    if (plane.coefficients[2] == 0) return normalised(cross(kUp, plane.normal));
  return {1, 0, 0};
}

/// The level facet at the lower edge of a wall at the middle of `where`, if that is where the edge
/// lies: the ground behind it, or a floor before it.
std::optional<FacetId> level_at_foot(const Solid& solid, const Host& host, const Extents& where) {
  const double middle = (where.u0 + where.u1) / 2;
  for (const Loop& loop : solid.facets[host.facet.index()].loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      const Vec3 p = solid.vertices[at(a)].point, q = solid.vertices[at(b)].point;
      const bool is_low = std::abs(dot(p, host.v) - where.v0) < kOnEdge_m &&
                          std::abs(dot(q, host.v) - where.v0) < kOnEdge_m;
      if (!is_low || dot(p, host.u) > middle || dot(q, host.u) < middle) continue;
      if (const auto level = facet_with_edge(solid, b, a, 0.9)) return level;
    }
  return std::nullopt;
}

/// The corners of a rectangle on a host, counter-clockwise.
std::array<Vec3, 4> corners_of(const Host& host, const Extents& e) {
  const auto point = [&](double u, double v) {
    return u * host.u + v * host.v + host.plane.offset_m * host.n;
  };
  return {point(e.u0, e.v0), point(e.u1, e.v0), point(e.u1, e.v1), point(e.u0, e.v1)};
}

/// How far two rectangles are from each other, in the direction in which that is more.
double apart(const Extents& one, const Extents& other) {
  return std::max({one.u0 - other.u1, other.u0 - one.u1, one.v0 - other.v1, other.v0 - one.v1});
}

/// Imprints that stay are drawn last: the facet still names their polygons.
bool meets_imprints(const Solid& solid, const Segmentation& segmentation, const Host& host,
                    const Extents& where, const Clearance& clearance) {
  const std::vector<int>& its = solid.facets[host.facet.index()].polygons;  // sorted
  return std::ranges::any_of(segmentation.features, [&](const Feature& other) {
    if (other.sense != Sense::imprint || other.source_polygons.empty() ||
        !std::ranges::includes(its, other.source_polygons))
      return false;
    const Extents its_extents = extents_of(host, segmentation, other);
    double needed = clearance.least_m;
    for (const Outline& outline : clearance.before)
      needed = std::min(needed, apart(extents_of(host, outline), its_extents) - kOnEdge_m);
    return apart(its_extents, where) < std::max(needed, 0.0);
  });
}

/// A rectangle lies in its facet, off its edges, but for a lower edge that it stands on.
bool lies_clear(const Solid& solid, const Host& host, const Extents& where,
                const Clearance& clearance) {
  const Facet& facet = solid.facets[host.facet.index()];
  const auto outlines = outlines_of(solid.vertices, facet.loops);
  const auto corners = corners_of(host, where);
  const Vec3 middle = 0.5 * (corners[0] + corners[2]);
  if (!contains(outlines, host.n, middle)) return false;
  for (const Outline& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const std::pair edge{outline[i], outline[(i + 1) % outline.size()]};
      const bool is_foot = std::abs(dot(edge.first, host.v) - where.v0) < kOnEdge_m &&
                           std::abs(dot(edge.second, host.v) - where.v0) < kOnEdge_m;
      if (is_foot) continue;
      if (is_too_near(clearance, nearness(corners, edge), edge)) return false;
    }
  return true;
}

Placed with_polygons(Attached made, const std::vector<int>& polygons) {
  if (!made.solid) return {std::nullopt, std::move(made.reason)};
  for (const FacetId facet : made.facets) made.solid->facets[facet.index()].polygons = polygons;
  return {std::move(made.solid), {}};
}

/// The way in which the upper side of a box in a roof looks: as planes of the building along the
/// eaves, one of which looks back, the nearest to up the slope; up the slope if there are none.
Vec3 up_the_roof(const Solid& solid, const Host& host) {
  constexpr double kAcross = 0.01, kSteepest = 0.5;
  double best = kSteepest;
  Vec3 up = host.v;
  for (const Plane& plane : solid.planes) {
    const double along = dot(plane.normal, host.v);
    if (std::abs(dot(plane.normal, host.u)) > kAcross || std::abs(along) <= best) continue;
    const auto back = exact::opposite(plane).coefficients;
    if (std::ranges::find(solid.planes, back, &Plane::coefficients) == solid.planes.end()) continue;
    best = std::abs(along);
    up = along > 0 ? plane.normal : -plane.normal;
  }
  return up;
}

/// A plane parallel to the host's, `out_m` in front of it, that looks out (+1) or in (-1).
Plane parallel(const Solid& solid, const Plane& plane, double out_m, int sign) {
  const Plane moved = plane_in_front(plane, out_m, solid.grid_m);
  return sign > 0 ? moved : exact::opposite(moved);
}

}  // namespace

std::optional<Host> host_at(const Solid& solid, const Plane& plane, Vec3 point) {
  for (const FacetId f : ids_below<FacetId>(solid.facets.size())) {
    const Facet& facet = solid.facets[f.index()];
    const Plane& its = solid.planes[facet.plane.index()];
    if (its.coefficients != plane.coefficients || its.offset != plane.offset) continue;
    if (!contains(outlines_of(solid.vertices, facet.loops), its.normal, point)) continue;
    Host host{f, its, {}, {}, its.normal};
    const Vec3 across = cross(kUp, its.normal);
    host.u = length(across) > 0.01 ? normalised(across) : along_a_wall(solid);
    host.v = cross(host.n, host.u);
    return host;
  }
  return std::nullopt;
}

std::optional<FacetId> facet_with_edge(const Solid& solid, int from, int to, double steeper_than) {
  for (const FacetId f : ids_below<FacetId>(solid.facets.size()))
    for (const Loop& loop : solid.facets[f.index()].loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        if (loop[i] == from && loop[(i + 1) % loop.size()] == to &&
            std::abs(solid.planes[solid.facets[f.index()].plane.index()].normal.z) > steeper_than)
          return f;
  return std::nullopt;
}

std::optional<Host> wall_axes(const Plane& plane) {
  if (!looks_aside(plane.normal)) return std::nullopt;
  Host host{{}, plane, normalised(cross(kUp, plane.normal)), {}, plane.normal};
  host.v = cross(host.n, host.u);
  return host;
}

Extents grown(Extents box, double more_u, double more_v, bool is_on_sill) {
  box.u0 -= more_u / 2;
  box.u1 += more_u / 2;
  box.v0 -= is_on_sill ? 0 : more_v / 2;
  box.v1 += is_on_sill ? more_v : more_v / 2;
  return box;
}

Extents united(const Extents& one, const Extents& other) {
  return {std::min(one.u0, other.u0),     std::max(one.u1, other.u1),
          std::min(one.v0, other.v0),     std::max(one.v1, other.v1),
          std::min(one.out0, other.out0), std::max(one.out1, other.out1)};
}

Extents extents_of(const Host& host, std::span<const Vec3> points) {
  constexpr double kInf = Box::kInfinity;
  Extents e{kInf, -kInf, kInf, -kInf, kInf, -kInf};
  for (const Vec3 p : points) {
    e.u0 = std::min(e.u0, dot(p, host.u));
    e.u1 = std::max(e.u1, dot(p, host.u));
    e.v0 = std::min(e.v0, dot(p, host.v));
    e.v1 = std::max(e.v1, dot(p, host.v));
    const double out = dot(p, host.n) - host.plane.offset_m;
    e.out0 = std::min(e.out0, out);
    e.out1 = std::max(e.out1, out);
  }
  return e;
}

Extents extents_of(const Host& host, const Segmentation& segmentation, const Feature& feature) {
  std::vector<Vec3> points;
  for (const int v : feature.vertices) points.push_back(segmentation.vertices[at(v)].point);
  return extents_of(host, points);
}

Placed place(const Solid& solid, const std::vector<FacetId>& contacts,
             const std::vector<Plane>& planes, Attach kind, const Clearance& clearance,
             const std::vector<int>& polygons, Solid* spare) {
  return with_polygons(attach(solid, contacts, planes, kind, clearance, spare), polygons);
}

Placed place_across(const Solid& solid, const BlockAcross& block, const Clearance& clearance,
                    const std::vector<int>& polygons) {
  return with_polygons(raise_across(solid, block, clearance), polygons);
}

Placed place_box(const Solid& solid, const Host& host, Extents where, double depth_m, Attach kind,
                 const Clearance& clearance, const std::vector<int>& polygons, Solid* spare) {
  const bool is_wall = looks_aside(host.n);
  const Vec3 up = is_wall ? kUp : up_the_roof(solid, host);
  const auto point = [&](double u, double v) {
    return u * host.u + v * host.v + host.plane.offset_m * host.n;
  };
  const auto plane = [&](Vec3 direction, double u, double v) {
    return plane_through(solid, direction, point(u, v), kSameDirection_deg);
  };
  std::vector<Plane> planes{plane(-host.u, where.u0, where.v0), plane(host.u, where.u1, where.v0),
                            plane(up, where.u0, where.v1)};
  planes.push_back(kind == Attach::sink ? parallel(solid, host.plane, -depth_m, -1)
                                        : parallel(solid, host.plane, depth_m, 1));
  const auto foot = is_wall ? level_at_foot(solid, host, where) : std::nullopt;
  if (foot) return place(solid, {host.facet, *foot}, planes, kind, clearance, polygons, spare);
  planes.push_back(plane(-up, where.u0, where.v0));
  return place(solid, {host.facet}, planes, kind, clearance, polygons, spare);
}

Placed draw_outline(const Solid& solid, const Host& host, const Extents& where,
                    const Feature& like) {
  // An imprint is what the segmentation calls one: a facet's polygons with an outline.
  Segmentation drawn;
  drawn.planes = {host.plane};
  Feature imprint = like;
  imprint.sense = Sense::imprint;
  imprint.planes = {PlaneId{0}};
  imprint.outline.clear();
  for (const Vec3 corner : corners_of(host, where)) {
    imprint.outline.push_back(static_cast<int>(drawn.vertices.size()));
    drawn.vertices.push_back({corner, false});
  }
  drawn.features = {imprint};
  Solid out = solid;
  auto& polygons = out.facets[host.facet.index()].polygons;
  polygons.insert(polygons.end(), imprint.source_polygons.begin(), imprint.source_polygons.end());
  std::ranges::sort(polygons);
  polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
  const std::size_t before = out.facets.size();
  out = draw_imprints(std::move(out), drawn, {FeatureId{0}});
  if (out.facets.size() == before || !is_closed(out))
    return {std::nullopt, "its outline does not fit into the facet"};
  return {std::move(out), {}, false};
}

Placed place_like(const Solid& solid, const Segmentation& segmentation, const Host& host,
                  const Extents& where, double depth_m, Sense sense, const Clearance& clearance,
                  const Feature& like, Solid* spare) {
  if (meets_imprints(solid, segmentation, host, where, clearance))
    return {std::nullopt, "it would come too near to another part"};
  if (sense != Sense::imprint)
    return place_box(solid, host, where, depth_m,
                     sense == Sense::hole ? Attach::sink : Attach::raise, clearance,
                     like.source_polygons, spare);
  if (!lies_clear(solid, host, where, clearance))
    return {std::nullopt, "its outline does not fit into the facet"};
  return draw_outline(solid, host, where, like);
}

Clearance clearance_after(const Host& host, double least_m, const std::vector<Extents>& features) {
  Clearance clearance(least_m);
  for (const Extents& feature : features) {
    const auto corners = corners_of(host, feature);
    clearance.before.emplace_back(corners.begin(), corners.end());
  }
  return clearance;
}

std::optional<double> box_depth(const Host& host, const Feature& feature, const Extents& extents) {
  const double area_m2 = extents.width() * extents.height();
  if (feature.sense == Sense::imprint)
    return feature.new_area_m2 >= kBoxShare * area_m2 ? std::optional(0.0) : std::nullopt;
  if (is_box(feature, extents)) return extents.depth();
  if (feature.sense != Sense::hole || feature.volume_m3 <= 0 || area_m2 <= 0 ||
      !looks_aside(host.n))
    return std::nullopt;
  return feature.volume_m3 / area_m2;
}

bool is_box(const Feature& feature, const Extents& extents) {
  return feature.volume_m3 >= kBoxShare * extents.width() * extents.height() * extents.depth();
}

}  // namespace oriel::detail
