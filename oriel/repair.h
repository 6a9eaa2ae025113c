#pragma once

#include "io/document.h"
#include "kernel/base/issue.h"
#include "model/labelled_building.h"
#include "oriel/options.h"
#include "oriel/result.h"

#include <optional>

namespace oriel {

/// The defaults of repair(): polygons that run through each other are cut.
PipelineOptions repair_defaults();

/// A building whose polygons were made a valid solid, or that was rejected.
struct Repaired {
  /// The solid that was written; missing if there is none that is valid.
  std::optional<Solid> solid;
  /// What was done to the polygons.
  RepairReport report;
  /// The solid in the place of the polygons, with counts of what was repaired as attributes.
  LabelledBuilding output;
  /// Those of solidify, then E321 of what stays beside the solid and is not valid, and E318 if the
  /// solid would not be valid when it is read again.
  std::vector<Issue> issues;
};

/// Makes a valid solid of a building: closed, oriented, with plane faces (docs/solidify.md).
/// `building` is one of the document. The solid is checked as it is written (validate, on the grid
/// of the document, as fine as it needs to be); where that fails and crossings may be cut, it is
/// redrawn from the boundary of its inside. Tolerances are taken as they are given. Installations
/// that were joined to it (ReadOptions) stay as they are. What was repaired can be repaired again,
/// but need not stay the same: planes are fitted anew to corners that the file's grid has moved.
Repaired repair(const Document& document, const Building& building,
                const PipelineOptions& options = repair_defaults());

/// The same for a building without joined installations of which solid_of() with the same options
/// gave `solid`.
Repaired repair(const Document& document, const Building& building, PipelineResult solid,
                const PipelineOptions& options);

/// The labels of a building on the facets of its solid instead of on its polygons. `result` is what
/// label() said of it, is_done(), with crossings cut and without joined installations
/// (ReadOptions); `labelled` its output. No value if the building is open (G404), or if the solid
/// would not be valid when it is read again (E318).
Checked<LabelledBuilding> on_solid(const Document& document, const Building& building,
                                   const PipelineResult& result, const LabelledBuilding& labelled);

}  // namespace oriel
