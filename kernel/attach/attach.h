#pragma once

#include "model/solid.h"

#include <optional>
#include <string>
#include <utility>
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

/// How far a body keeps from what is around it.
struct Clearance {
  Clearance(double least, std::vector<std::vector<Vec3>> outlines = {})
      : least_m(least), before(std::move(outlines)) {}

  /// From edges of its contacts and from other facets; no less than 1 mm.
  double least_m;
  /// The outlines on the first contact of what the body takes the place of: to what was nearer than
  /// `least_m` to one of them it may come as near.
  std::vector<std::vector<Vec3>> before;
  /// Facets of what the body belongs to, such as a window of its sill: it may come as near to them
  /// as is possible at all.
  std::vector<FacetId> own{};
};

/// Puts a convex body onto a planar facet, or sinks it into the solid behind that facet.
///
/// The body is what lies behind all `planes`, whose normals point out of it, and in front of the
/// first contact's plane (raise) or behind it (sink). `contacts` is one facet, or two that share a
/// straight edge if the body ends at the second one, too (a door that reaches the ground, or stands
/// on the slab before it, a sill that ends where its window begins). The first contact gets a hole
/// with the body's outline; at a second one it gets a notch, and the second one a notch or a tab,
/// whichever closes the solid. The edge that they share is longer than the body there or, if the
/// second one gets a tab, shorter. All other sides of the body become new facets without polygons.
///
/// The result is closed and exact by construction: its vertices are meetings of three planes, those
/// of `planes` and of the contacts. It is refused with a reason
///  - if the body is empty or not bounded, or more than three planes meet in a point of it;
///  - if its outline does not lie inside the contact, at least the clearance off its edges;
///  - if the body comes nearer than the clearance to any other facet; what lies beyond the
///  contacts'
///    planes does not count. Decided in doubles, whose error is far below 1 mm, the least clearance
///    that is taken.
/// `planes` must have coefficients as exact.h allows and offsets on the solid's grid.
///
/// `spare`, if given, is `solid` itself: the result is made of it, not of a copy. It stays as it is
/// if the body is refused.
Attached attach(const Solid& solid, const std::vector<FacetId>& contacts,
                const std::vector<Plane>& planes, Attach kind, const Clearance& clearance,
                Solid* spare = nullptr);

/// The plane with the normal of an existing plane of the solid (or of its opposite) that is no more
/// than `within_deg` off `direction`, else with `direction` itself rounded to integers, through
/// `point`. So what is added does not bring new directions where there are old ones.
Plane plane_through(const Solid& solid, Vec3 direction, Vec3 point, double within_deg);

}  // namespace oriel
