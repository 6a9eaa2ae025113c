#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/mend/exposed_faces.h"
#include "kernel/solidify/soup/soup.h"
#include "model/repair.h"
#include "model/tolerances.h"

namespace oriel::detail {

/// What is left of a soup once it is mended.
struct Mended {
  /// The boundary of what the polygons enclose, every polygon's front outside (of cavities: in the
  /// void). Caps have source -1.
  Soup soup;
  /// The polygons enclose less of themselves than is left over (a hole lets the outside in), or the
  /// solid would leave out polygons that can be seen from outside.
  bool is_open = false;
  /// If it stays open because the solid would not show them (area in m²); else none.
  ExposedFaces exposed;
  RepairReport report;
};

/// Makes the boundary of a solid of polygons that are no closed shell:
/// 1. one of equal polygons stays (duplicates.h);
/// 2. vertices on the edge of a neighbour are put into it (t_vertices.h);
/// 3. polygons are cut where the edges of others lie on them (crossings.h);
/// 4. the cells between the polygons are found, polygons sorted round the edges (cells.h);
/// 5. if the outer cell has got in, holes are closed, the small ones first (caps.h); before larger
///    ones (of any size, or a ground and walls: cap_kinds.h), polygons are cut where they run
///    through each other, if asked for (crossings.h);
/// 6. if the solid would not show what can be seen from outside it is none (exposed_faces.h);
/// 7. shells in the material of others are dropped or become cavities;
/// 8. what has the outer cell on one side only stays.
/// `is_solid`: Building::is_solid. It stays open once `work` is used up.
Mended mend(const Soup& soup, bool is_solid, const Tolerances& tolerances,
            const RepairOptions& options, Work& work);

}  // namespace oriel::detail
