#include "generalise/operators/follow.h"

#include "generalise/operators/facade.h"
#include "kernel/attach/move_facet.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/exact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace oriel::detail {

namespace {

/// The edge of an opening that something lies along.
enum class EdgeSide { below, above, before, after };

/// Nothing if it lies at a corner of the opening, or over it.
std::optional<EdgeSide> side_of(const Extents& decor, const Extents& opening) {
  if (decor.u0 < opening.u1 && decor.u1 > opening.u0) {
    if (decor.v1 <= opening.v0 + kOnEdge_m) return EdgeSide::below;
    if (decor.v0 >= opening.v1 - kOnEdge_m) return EdgeSide::above;
  }
  if (decor.v0 < opening.v1 && decor.v1 > opening.v0) {
    if (decor.u1 <= opening.u0 + kOnEdge_m) return EdgeSide::before;
    if (decor.u0 >= opening.u1 - kOnEdge_m) return EdgeSide::after;
  }
  return std::nullopt;
}

/// Moves a range across the edge by `across`, and along it with the ends of the edge, from `was` to
/// `now`, or with its middle.
struct EdgeMove {
  double across, first, second;

  EdgeMove(double across_m, double first_m, double second_m, bool is_growing)
      : across(across_m),
        first(is_growing ? first_m : (first_m + second_m) / 2),
        second(is_growing ? second_m : (first_m + second_m) / 2) {}
};

/// Where it is to be drawn.
Extents moved_along(Extents decor, EdgeSide side, const Extents& was, const Extents& now,
                    bool is_growing) {
  const double u0 = now.u0 - was.u0, u1 = now.u1 - was.u1;
  const double v0 = now.v0 - was.v0, v1 = now.v1 - was.v1;
  const bool is_level = side == EdgeSide::below || side == EdgeSide::above;
  const EdgeMove move = is_level ? EdgeMove(side == EdgeSide::below ? v0 : v1, u0, u1, is_growing)
                                 : EdgeMove(side == EdgeSide::before ? u0 : u1, v0, v1, is_growing);
  decor.u0 += is_level ? move.first : move.across;
  decor.u1 += is_level ? move.second : move.across;
  decor.v0 += is_level ? move.across : move.first;
  decor.v1 += is_level ? move.across : move.second;
  return decor;
}

/// A side of a rectangle on a host: the way it looks, and how far along that it is.
struct BoxSide {
  Vec3 out;
  double at;
};

/// Across the edge of the host that the side ends at, if there is one: what stands upright on the
/// host, such as the reveal of an opening.
std::optional<FacetId> facet_across(const Solid& solid, const Host& host, const Extents& where,
                                    const BoxSide& side) {
  const Vec3 along = cross(host.n, side.out);
  const std::array<double, 4> us{where.u0, where.u1, where.u1, where.u0};
  const std::array<double, 4> vs{where.v0, where.v0, where.v1, where.v1};
  double first = Box::kInfinity, last = -Box::kInfinity;
  for (std::size_t i = 0; i < us.size(); ++i) {
    const double s = dot(us.at(i) * host.u + vs.at(i) * host.v, along);
    first = std::min(first, s);
    last = std::max(last, s);
  }
  for (const Loop& loop : solid.facets[host.facet.index()].loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      const Vec3 p = solid.vertices[at(a)].point, q = solid.vertices[at(b)].point;
      // The host lies on the inner side of the edge.
      const bool is_there = std::abs(dot(p, side.out) - side.at) < kOnEdge_m &&
                            std::abs(dot(q, side.out) - side.at) < kOnEdge_m &&
                            dot(q - p, along) > 0 && dot(p, along) < last && dot(q, along) > first;
      if (is_there) return facet_with_edge(solid, b, a);
    }
  return std::nullopt;
}

/// Puts a box onto a wall; it may end at what stands upright on that at one of its sides.
Placed raise_box(const Solid& solid, const Host& host, const Extents& where,
                 const Clearance& clearance, const std::vector<int>& polygons) {
  const std::array<BoxSide, 4> sides{BoxSide{-host.u, -where.u0}, BoxSide{host.u, where.u1},
                                     BoxSide{-host.v, -where.v0}, BoxSide{host.v, where.v1}};
  std::vector<FacetId> contacts{host.facet};
  std::vector<Plane> planes{plane_in_front(host.plane, where.out1, solid.grid_m)};
  for (const BoxSide& side : sides) {
    const auto across = facet_across(solid, host, where, side);
    const bool is_upright =
        across && std::abs(dot(solid.planes[solid.facets[across->index()].plane.index()].normal,
                               side.out)) > 1 - kOnEdge_m;
    if (is_upright && contacts.size() == 1)
      contacts.push_back(*across);
    else
      planes.push_back(plane_through(solid, side.out, side.at * side.out, kSameDirection_deg));
  }
  return place(solid, contacts, planes, Attach::raise, clearance, polygons);
}

/// All facets that have the polygons of one of the features.
std::vector<FacetId> facets_of(const Solid& solid, const Segmentation& segmentation,
                               const std::vector<FeatureId>& features) {
  std::vector<FacetId> found;
  for (const FacetId f : ids_below<FacetId>(solid.facets.size()))
    if (std::ranges::any_of(features, [&](FeatureId id) {
          const auto& its = segmentation.features[id.index()].source_polygons;
          return !its.empty() && its == solid.facets[f.index()].polygons;
        }))
      found.push_back(f);
  return found;
}

Followed refused(const char* reason) { return {{std::nullopt, reason}}; }

/// Openings before and after, along the axes of their wall.
struct OpeningChange {
  std::optional<Extents> was{}, now{};

  static void add(std::optional<Extents>& to, const Extents& one) {
    to = to ? united(*to, one) : one;
  }
};

OpeningChange change_of(const Host& host, const Segmentation& segmentation,
                        const std::vector<FeatureId>& openings, const DrawnCorners& drawn) {
  OpeningChange out;
  for (const FeatureId id : openings) {
    const Feature& opening = segmentation.features[id.index()];
    if (opening.planes.empty() ||
        segmentation.planes[opening.planes[0].index()].coefficients != host.plane.coefficients)
      continue;
    OpeningChange::add(out.was, extents_of(host, segmentation, opening));
    if (const auto found = drawn.find(id); found != drawn.end())
      OpeningChange::add(out.now, extents_of(host, found->second));
  }
  return out;
}

Box box_of(const Host& host, const Extents& e) {
  Box box;
  for (const double u : {e.u0, e.u1})
    for (const double v : {e.v0, e.v1})
      for (const double out : {0.0, e.out1})
        box.grow(u * host.u + v * host.v + (host.plane.offset_m + out) * host.n);
  return box;
}

}  // namespace

DrawnCorners drawn_corners(const Solid& solid, const Segmentation& segmentation,
                           const std::vector<FeatureId>& features) {
  std::map<std::vector<int>, FeatureId> by_polygons;
  for (const FeatureId id : features)
    if (const auto& its = segmentation.features[id.index()].source_polygons; !its.empty())
      by_polygons.emplace(its, id);
  DrawnCorners drawn;
  for (const Facet& facet : solid.facets)
    if (const auto found = by_polygons.find(facet.polygons); found != by_polygons.end())
      for (const Loop& loop : facet.loops)
        for (const int v : loop) drawn[found->second].push_back(solid.vertices[at(v)].point);
  return drawn;
}

Followed follow(const Solid& solid, const Segmentation& segmentation, const Follower& follower,
                const DrawnCorners& drawn, const std::vector<FeatureId>& own) {
  const Feature& feature = segmentation.features[follower.feature.index()];
  // Its facet is looked for where it goes.
  auto host = feature.planes.empty() ? std::nullopt
                                     : wall_axes(segmentation.planes[feature.planes[0].index()]);
  if (!host) return refused("it does not stand on a wall");
  const Extents before = extents_of(*host, segmentation, feature);
  if (feature.sense != Sense::protrusion || !is_box(feature, before))
    return refused("only blocks that are boxes move or grow with what they belong to");
  const OpeningChange opening = change_of(*host, segmentation, follower.openings, drawn);
  if (!opening.was) return refused("it looks another way than what it belongs to");
  if (!opening.now) return refused("what it belongs to is gone");
  if (follower.is_of_strip && follower.belonging != Belonging::grows)
    return refused("the strip is no longer what it belongs to");
  const auto side = side_of(before, *opening.was);
  if (!side) return refused("it lies along none of the edges of what it belongs to");
  const Extents where = moved_along(before, *side, *opening.was, *opening.now,
                                    follower.belonging == Belonging::grows);
  if (where.width() < kNoShift_m || where.height() < kNoShift_m)
    return refused("there would be nothing left of it");
  const Vec3 middle = (where.u0 + where.u1) / 2 * host->u + (where.v0 + where.v1) / 2 * host->v +
                      host->plane.offset_m * host->n;
  const auto found = host_at(solid, host->plane, middle);
  if (!found) return refused("its wall is no longer found there");
  Clearance clearance = clearance_after(*found, follower.gap_m, {before});
  clearance.own = facets_of(solid, segmentation, own);
  Followed out{raise_box(solid, *found, where, clearance, feature.source_polygons),
               box_of(*found, where)};
  if (!out.placed.solid)
    out.beside = FacadeRoom(solid, segmentation, *found).beside(where, follower.gap_m);
  return out;
}

}  // namespace oriel::detail
