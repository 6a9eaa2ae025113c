#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <span>

namespace oriel::detail {

/// A soup in which polygons are cut along the edges of others that lie on them.
struct SoupWithContacts {
  Soup soup;
  /// Polygons that were cut.
  int cut = 0;
};

/// Cuts polygons where an edge of one other polygon only lies on them, within `reach` (grid units)
/// and not along their rim: two boxes that touch with parts of their faces. Edges must not run past
/// each other's ends (t_vertices.h). Edges that lead into a polygon and part nothing of it are left
/// out. Once `work` is used up no more are looked for.
SoupWithContacts cut_at_contacts(const Soup& soup, std::span<const PolygonShape> shapes,
                                 double reach, Work& work);

/// A soup whose polygons meet in common points and edges only.
struct SoupWithoutCrossings {
  Soup soup;
  /// Polygons that were parted.
  int cut = 0;
};

/// What becomes of the faces of polygons whose rings cross each other.
enum class RingKind {
  /// They are not looked at: polygons are taken to be simple.
  simple,
  /// add_signed_faces().
  crossing
};

/// Cuts the polygons of each body along the lines where others of it run through them, and along
/// the edges of others that lie on them, within `reach`. Points closer than `weld` become one (both
/// in grid units). Neighbours across an edge get the points that it was cut at from
/// insert_t_vertices(). Once `work` is used up no more are looked for: then the soup is of no use.
SoupWithoutCrossings cut_at_crossings(const Soup& soup, double reach, double weld, Work& work,
                                      RingKind rings = RingKind::simple);

}  // namespace oriel::detail
