#include "examples/generator/house/rooftop.h"

#include "examples/generator/house/extrude.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oriel::generator {
namespace {

/// > 0 if p lies on the left of a → b, seen from above.
Um side(Point a, Point b, Point p) { return (b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y); }

/// Where p → q meets the line a → b, seen from above, to the micrometre.
Point meeting(Point a, Point b, Point p, Point q) {
  const long double dp = static_cast<long double>(side(a, b, p));
  const long double dq = static_cast<long double>(side(a, b, q));
  const long double t = dp / (dp - dq);
  return {p.x + std::llround(t * static_cast<long double>(q.x - p.x)),
          p.y + std::llround(t * static_cast<long double>(q.y - p.y)), 0};
}

/// The part of a polygon on the left of a → b, seen from above (Sutherland and Hodgman).
Ring clipped(const Ring& ring, Point a, Point b) {
  Ring result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point p = ring[i], q = ring[(i + 1) % ring.size()];
    const Um dp = side(a, b, p), dq = side(a, b, q);
    if (dp >= 0) result.push_back(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) result.push_back(meeting(a, b, p, q));
  }
  return result;
}

/// The part of the plane inside the convex footprint, seen from above, at z = 0.
Ring part_inside(const RoofPlane& plane, const Ring& footprint) {
  Ring ring;
  for (const Uv p : plane.outline) {
    const Point corner = plane.frame.at(p.u, p.v, 0);
    ring.push_back({corner.x, corner.y, 0});
  }
  for (std::size_t i = 0; i < footprint.size() && !ring.empty(); ++i)
    ring = clipped(ring, footprint[i], footprint[(i + 1) % footprint.size()]);
  return ring.size() < 3 ? Ring{} : ring;
}

Point lifted(const RoofPlane& plane, Point p) {
  const Point local = plane.frame.coordinates_of(p);
  return {p.x, p.y, plane.frame.origin.z + plane.slope.rise(local.y)};
}

Ring corners(const Rect& plan) { return rectangle({}, plan, 0); }

}  // namespace

Rect to_plan(const RoofPlane& plane, const Rect& rect) {
  const Point a = plane.frame.at(rect.u0, rect.v0, 0), b = plane.frame.at(rect.u1, rect.v1, 0);
  return {std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y)};
}

Rect to_plane(const RoofPlane& plane, const Rect& plan) {
  const Point a = plane.frame.coordinates_of({plan.u0, plan.v0, 0});
  const Point b = plane.frame.coordinates_of({plan.u1, plan.v1, 0});
  return {std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y)};
}

bool is_roof_free(const House& house, const Rect& plan, Um distance) {
  return std::none_of(house.roof.begin(), house.roof.end(), [&](const RoofPlane& plane) {
    const Rect rect = to_plane(plane, plan).grown(distance);
    return std::any_of(plane.reserved.begin(), plane.reserved.end(),
                       [&](const Rect& other) { return other.overlaps(rect); });
  });
}

std::vector<FacetId> stand_on_roof(Draft& draft, const House& house, const Ring& footprint, Um z,
                                   Owner owner, FacetId top) {
  std::vector<FacetId> walls;
  for (std::size_t i = 0; i < footprint.size(); ++i) walls.push_back(draft.add_facet(owner));
  const auto wall_of = [&](Point a, Point b) {
    for (std::size_t i = 0; i < footprint.size(); ++i) {
      const Point c = footprint[i], d = footprint[(i + 1) % footprint.size()];
      if (side(c, d, a) == 0 && side(c, d, b) == 0) return walls[i];
    }
    return kNewFacet;
  };
  for (const RoofPlane& plane : house.roof) {
    const Ring part = part_inside(plane, footprint);
    if (part.empty()) continue;
    Ring low, high;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Point a = part[i], b = part[(i + 1) % part.size()];
      low.push_back(lifted(plane, a));
      high.push_back({a.x, a.y, z});
      const FacetId wall = wall_of(a, b);
      if (a == b || wall == kNewFacet) continue;
      draft.add_ring(wall, {lifted(plane, a), lifted(plane, b), {b.x, b.y, z}, {a.x, a.y, z}});
    }
    draft.add_ring(plane.facet, reversed(std::move(low)));
    draft.add_ring(top, high);
  }
  return walls;
}

int host_below(const Draft& draft, const House& house, const Rect& plan) {
  const Um x = plan.middle(), y = (plan.v0 + plan.v1) / 2, d = 1'000;
  const Ring probe{{x - d, y - d, 0}, {x + d, y - d, 0}, {x + d, y + d, 0}, {x - d, y + d, 0}};
  for (const RoofPlane& plane : house.roof)
    if (!part_inside(plane, probe).empty()) return draft.owner(plane.facet).object;
  return -1;
}

void reserve_roof(House& house, const Rect& plan) {
  for (RoofPlane& plane : house.roof) plane.reserved.push_back(to_plane(plane, plan));
}

int add_chimney(Draft& draft, House& house, const Chimney& chimney) {
  const Rect& r = chimney.plan;
  const int object =
      draft.add_object({Class::chimney, "chimney", host_below(draft, house, r), -1, {}, {}});
  FacetId top = draft.add_facet({object});
  const Um cap_height = chimney.cap > 0 ? 80_mm : 0, c = chimney.cap;
  stand_on_roof(draft, house, corners(r), chimney.top - cap_height, {object}, top);
  if (c > 0)
    top = add_block(draft, {},
                    {r.u0 - c, r.u1 + c, r.v0 - c, r.v1 + c, chimney.top - cap_height, chimney.top},
                    {object}, {.back = top})
              .front;
  const Um wall = 100_mm, depth = 300_mm;
  const Um flue = (r.width() - wall * (chimney.flues + 1)) / chimney.flues / 1000 * 1000;
  for (int i = 0; i < chimney.flues; ++i) {
    const Um u = r.u0 + wall + i * (flue + wall);
    carve_block(draft, {},
                {u, u + flue, r.v0 + wall, r.v1 - wall, chimney.top - depth, chimney.top}, {object},
                {.front = top});
  }
  reserve_roof(house, r.grown(c));
  return object;
}

int add_vent(Draft& draft, House& house, const Rect& plan, Um top, bool is_round) {
  const int object = draft.add_object(
      {Class::vent, is_round ? "pipe" : "vent", host_below(draft, house, plan), -1, {}, {}});
  Ring footprint = corners(plan);
  if (is_round) {
    const Um cut = plan.width() * 3 / 10'000 * 1'000;
    const Rect& r = plan;
    footprint = {{r.u0 + cut, r.v0, 0}, {r.u1 - cut, r.v0, 0}, {r.u1, r.v0 + cut, 0},
                 {r.u1, r.v1 - cut, 0}, {r.u1 - cut, r.v1, 0}, {r.u0 + cut, r.v1, 0},
                 {r.u0, r.v1 - cut, 0}, {r.u0, r.v0 + cut, 0}};
  }
  stand_on_roof(draft, house, footprint, top, {object}, draft.add_facet({object}));
  reserve_roof(house, plan);
  return object;
}

Panel add_dormer(Draft& draft, RoofPlane& plane, const Dormer& dormer) {
  const int host = draft.owner(plane.facet).object;
  const bool is_gabled = dormer.eaves > 0;
  const int object = draft.add_object(
      {Class::dormer, is_gabled ? "gabledDormer" : "shedDormer", host, -1, {}, {}});
  const Owner owner{object};
  const auto [u0, u1, v0, v1, eaves, own] = dormer;
  const Um foot = plane.slope.rise(v0), peak = plane.slope.rise(v1);
  const Um top = is_gabled ? plane.slope.rise(eaves) : peak - own.rise(v1 - v0);
  const Um end = is_gabled ? eaves : v1, middle = (u0 + u1) / 2;
  const auto p = [&](Um u, Um v, Um w) { return plane.frame.at(u, v, w); };
  const auto add = [&](const Ring& ring) { return draft.add_ring(kNewFacet, owner, ring); };
  const Um end_height = plane.slope.rise(end);
  add({p(u1, v0, foot), p(u1, end, end_height), p(u1, v0, top)});
  add({p(u0, v0, foot), p(u0, v0, top), p(u0, end, end_height)});
  Ring front{p(u0, v0, foot), p(u1, v0, foot), p(u1, v0, top), p(u0, v0, top)};
  Ring footprint{p(u0, v0, foot), p(u1, v0, foot), p(u1, end, end_height), p(u0, end, end_height)};
  if (is_gabled) {
    const Point near = p(middle, v0, peak), far = p(middle, v1, peak);
    add({p(u1, v0, top), p(u1, end, top), far, near});
    add({p(u0, v0, top), near, far, p(u0, end, top)});
    front.insert(front.end() - 1, near);
    footprint.insert(footprint.end() - 1, far);
  } else {
    add({p(u0, v0, top), p(u1, v0, top), p(u1, v1, peak), p(u0, v1, peak)});
  }
  draft.add_ring(plane.facet, reversed(std::move(footprint)));
  plane.reserved.push_back({u0, u1, v0, v1});
  const Frame frame{plane.frame.at(0, v0, 0), plane.frame.u, plane.frame.w, -plane.frame.v};
  return {add(front), frame,  kNewFacet, {u0 + 80_mm, u1 - 80_mm, foot + 80_mm, top - 60_mm},
          {},         object, false};
}

}  // namespace oriel::generator
