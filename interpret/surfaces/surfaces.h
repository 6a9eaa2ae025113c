#pragma once

#include "interpret/pack/rule_base.h"
#include "model/building.h"
#include "model/description/surface_table.h"
#include "model/interpretation.h"
#include "model/polygon_owners.h"
#include "model/segmentation.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// What a surface is.
struct SurfaceVerdict {
  /// WallSurface, RoofSurface, GroundSurface, OuterCeilingSurface, OuterFloorSurface or
  /// ClosureSurface.
  std::string type;
  /// The entry of `surfaces:` that said so; empty: `hosts:` and `emit:` did.
  std::string rule;
};

/// The table with its column `part`: the label of the smallest feature that lists the polygon and
/// has a label that `emit:` writes; if none has, the smallest that has a label.
SurfaceTable with_parts(SurfaceTable table, const Building& building,
                        const Segmentation& segmentation, const Interpretation& interpretation,
                        const RuleBase& base);

/// The same for some rows only, with the features of all polygons.
SurfaceTable with_parts(SurfaceTable table, const Building& building, const PolygonOwners& owners,
                        const Interpretation& interpretation, const RuleBase& base,
                        std::span<const int> rows);

/// Names every surface of a table, in its order. The first entry of the pack's `surfaces:` whose
/// conditions all hold decides; a condition on a missing value does not hold. Where none does, the
/// inclination decides by `hosts:`: walls, and what has no inclination, are WallSurface; what looks
/// up is the `top` of its part (emit:), OuterFloorSurface in a recess of a wall, else RoofSurface;
/// what looks down is GroundSurface within `ground_reach` of the lowest point, else
/// OuterCeilingSurface.
std::vector<SurfaceVerdict> interpret_surfaces(const RuleBase& base, const SurfaceTable& table);

/// The rows of the polygons that annotate() names by interpret_surfaces: those in no opening.
/// `owners` are the features of all polygons.
std::vector<int> rows_to_name(const Building& building, const PolygonOwners& owners,
                              const Interpretation& interpretation, const RuleBase& base);

/// Numbers of a table that are measured when they are asked for.
class MoreAttributes {
 public:
  virtual ~MoreAttributes() = default;
  /// Whether an attribute is still to be measured.
  [[nodiscard]] virtual bool is_pending(SurfaceAttribute attribute) const = 0;
  /// Sets one pending attribute or more in those rows of the table.
  virtual void measure(std::span<const int> rows) = 0;
};

/// The same of some rows of a table that is being filled: `more` is asked for numbers of those rows
/// that cannot be named without them. The verdicts of other rows are empty.
std::vector<SurfaceVerdict> interpret_surfaces(const RuleBase& base, const SurfaceTable& table,
                                               std::span<const int> rows, MoreAttributes& more);

/// Why a surface is what it is, for a reader at a terminal: its attributes, then every entry of
/// `surfaces:` up to the one that decided with what came of its conditions and where they stand.
std::string explain_surface(const RuleBase& base, const SurfaceTable& table, std::size_t row);

/// The same of every surface of the table, in its order.
std::vector<std::string> explain_surfaces(const RuleBase& base, const SurfaceTable& table);

/// The reason of each verdict in one line: "GroundSurface by ground.plate: looks_down; base_height
/// <= $ground_reach". `verdicts` are those of interpret_surfaces for the table.
std::vector<std::string> surface_reasons(const RuleBase& base, const SurfaceTable& table,
                                         const std::vector<SurfaceVerdict>& verdicts);

}  // namespace oriel
