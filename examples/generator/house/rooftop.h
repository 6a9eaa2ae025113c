#pragma once

#include "examples/generator/house/house.h"

namespace oriel::generator {

/// A rectangle of the roof plane as a rectangle seen from above (u = x, v = y), and back.
Rect to_plan(const RoofPlane& plane, const Rect& rect);
Rect to_plane(const RoofPlane& plane, const Rect& plan);

/// True if nothing on the roof comes nearer than `distance` to the rectangle, seen from above.
/// Whether it stands on the roof at all is not asked.
bool is_roof_free(const House& house, const Rect& plan, Um distance);

/// Keeps what is placed later away from the rectangle.
void reserve_roof(House& house, const Rect& plan);

/// Stands a prism on the roof: the footprint (counter-clockwise, convex) is cut out of the planes
/// it meets, its walls rise from there to the height z, its top is summed into `top`. Returns the
/// facets of the walls, one for each edge of the footprint.
std::vector<FacetId> stand_on_roof(Draft& draft, const House& house, const Ring& footprint, Um z,
                                   Owner owner, FacetId top);

/// The object of the roof plane below the middle of the rectangle; -1 if there is none.
int host_below(const Draft& draft, const House& house, const Rect& plan);

/// An upright shaft that stands on whatever planes of the roof it meets: one, both sides of the
/// ridge, or the four around an apex.
struct Chimney {
  /// Seen from above; exact if ridges and hips run along an axis or diagonally.
  Rect plan;
  /// Height of its top, absolute.
  Um top = 0;
  /// Pockets in the top side by side.
  int flues = 1;
  /// How far a cap 80 mm thick sticks out below the top; 0 = none.
  Um cap = 0;
};
int add_chimney(Draft& draft, House& house, const Chimney& chimney);

/// A small box on the roof (`top` absolute), or, if round, a pipe of eight sides. A round one must
/// stand on one plane.
int add_vent(Draft& draft, House& house, const Rect& plan, Um top, bool is_round);

/// A dormer standing on a roof plane: its front at v0, u0 to u1 wide, its roof ending in the plane
/// at v1 > v0.
struct Dormer {
  Um u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  /// Gabled: where the eaves of its own roof end in the plane; v0 < eaves < v1. 0 = a shed dormer.
  Um eaves = 0;
  /// Shed: the slope of its roof, less than that of the plane.
  Slope slope;
};
/// Returns the panel that is the dormer's front.
Panel add_dormer(Draft& draft, RoofPlane& plane, const Dormer& dormer);

}  // namespace oriel::generator
