#pragma once

#include "interpret/surfaces/surfaces.h"
#include "kernel/base/issue.h"
#include "kernel/describe/describe.h"
#include "kernel/neighbours/neighbours.h"
#include "model/description/surface_table.h"
#include "model/interpretation.h"
#include "model/labelled_building.h"
#include "model/polygon_owners.h"
#include "model/repair.h"
#include "model/segmentation.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// A label that somebody corrected.
struct LabelCorrection {
  /// What the rules said.
  Verdict before;
  /// Who corrected it, why, and where that stands.
  std::string by;
  std::string why;
  Place place;
};

/// What the solid of a building is.
enum class BodyKind {
  solid,           ///< its own, closed
  supposed_solid,  ///< what it would be if the faces that are missing were there: it stayed open
  open_shell       ///< the facets that there are: it stayed open, and nothing was cut
};

/// The features of a building with all that is known of them, or none.
struct FoundFeatures {
  std::optional<Segmentation> segmentation;
  Description description;
  /// Empty without rules.
  Interpretation interpretation;
  /// Of the verdicts: those that were corrected, in feature order.
  std::vector<LabelCorrection> corrections;
};

/// What is known of the surfaces of a building: nothing without rules.
struct FoundSurfaces {
  /// Also of a building that was rejected; no rows if describing failed.
  SurfaceTable surfaces;
  /// What the surfaces are, where only their names were asked for; then `surfaces` is not complete.
  std::vector<SurfaceVerdict> named_surfaces;
  /// Found with them.
  std::optional<PolygonOwners> owners;
};

/// All that is known of one building, as far as it came in the pipeline
/// solidify → segment → describe → interpret.
struct PipelineResult : FoundFeatures, FoundSurfaces {
  /// Missing: nothing could be made of the polygons, and `issues` says why.
  std::optional<Solid> solid;
  RepairReport repair;
  /// What `solid` is, if it is there.
  BodyKind body = BodyKind::solid;
  /// Those it was cut with: fitted to its noise.
  Tolerances tolerances;
  /// What write() takes: semantic surfaces, installations and attributes (docs/formats.md); made by
  /// label(). Of a building that was rejected its surfaces are named all the same. Without id if
  /// it was not made.
  LabelledBuilding output;
  std::vector<Issue> issues;
  /// With LabelOptions::neighbours: what stands around the building.
  std::optional<Neighbourhood> surroundings{};
  /// Nothing was done: a run of the command that selects buildings left this one out.
  bool is_passed_over = false;

  /// It was segmented; if not, `issues` has an error that says why the building was rejected.
  [[nodiscard]] bool is_done() const { return segmentation.has_value(); }
  /// `solid` is closed.
  [[nodiscard]] bool is_solid() const { return solid && body != BodyKind::open_shell; }
  /// The building stayed open, but its features are found: what is written are its own polygons.
  [[nodiscard]] bool is_open() const { return solid && body != BodyKind::solid; }
  /// Its surfaces can be named, though the building may have been rejected.
  [[nodiscard]] bool has_surfaces() const { return surfaces.rows() > 0; }
};

}  // namespace oriel
