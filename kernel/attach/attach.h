#pragma once

#include "kernel/model/solid.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// Whether a body is put onto a facet or taken out from behind it.
enum class Attach { raise, sink };

/// A solid with a body put onto it or sunk into it, or why that cannot be.
struct Attached {
  std::optional<Solid> solid;
  /// The facets that are new, the last ones of the solid.
  std::vector<FacetId> facets;
  /// If there is no solid.
  std::string reason;
};

/// Puts a convex body onto a planar facet, or sinks it into the solid behind that facet.
///
/// The body is what lies behind all `planes`, whose normals point out of it, and in front of the
/// first contact's plane (raise) or behind it (sink). `contacts` is one facet; of a sunk body there
/// may be a second one at which it ends too, which shares a straight edge with the first (a door
/// that reaches the ground). The first contact gets a hole with the body's outline, or both get a
/// notch; all other sides of the body become new facets without polygons.
///
/// The result is closed and exact by construction: its vertices are meetings of three planes, those
/// of `planes` and of the contacts. It is refused with a reason
///  - if the body is empty or not bounded, or more than three planes meet in a point of it;
///  - if its outline does not lie inside the contact, at least `clear_m` off its edges;
///  - if the body comes nearer than `clear_m` to any other facet; what lies beyond the contacts'
///    planes does not count. Decided in doubles, whose error is far below a `clear_m` of 1 mm or
///    more, the least that is taken.
/// `planes` must have coefficients as exact.h allows and offsets on the solid's grid.
Attached attach(const Solid& solid, const std::vector<FacetId>& contacts,
                const std::vector<Plane>& planes, Attach kind, double clear_m);

/// The plane with the normal of an existing plane of the solid (or of its opposite) that is no more
/// than `within_deg` off `direction`, else with `direction` itself rounded to integers, through
/// `point`. So what is added does not bring new directions where there are old ones.
Plane plane_through(const Solid& solid, Vec3 direction, Vec3 point, double within_deg);

}  // namespace oriel
