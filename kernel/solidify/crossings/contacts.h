#pragma once

#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

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
/// out.
SoupWithContacts cut_at_contacts(const Soup& soup, const std::vector<PolygonShape>& shapes,
                                 double reach);

}  // namespace oriel::detail
