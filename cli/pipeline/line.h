#pragma once

#include "cli/terminal/timings.h"
#include "interpret/pack/rule_base.h"
#include "interpret/surfaces/surfaces.h"
#include "kernel/base/issue.h"
#include "kernel/describe/describe.h"
#include "kernel/describe/surfaces.h"
#include "kernel/model/building.h"
#include "kernel/model/interpretation.h"
#include "kernel/model/polygon_owners.h"
#include "kernel/model/repair.h"
#include "kernel/model/segmentation.h"
#include "kernel/model/solid.h"
#include "kernel/segment/segment.h"

#include <optional>
#include <vector>

namespace oriel::cli {

/// One building on the straight line, as far as it came.
struct OnLine {
  std::optional<Solid> solid;
  RepairReport repair;
  /// The building stayed open: `solid` is no solid but its open_shell, and nothing was cut.
  bool is_open = false;
  std::optional<Segmentation> segmentation;
  /// Those it was cut with: fitted to its noise.
  Tolerances tolerances;
  Description description;
  Interpretation interpretation;  ///< empty without rules
  /// With rules, also of a building that was set aside; no rows if that failed.
  SurfaceTable surfaces;
  /// What they are, where nothing else was asked of them; then `surfaces` is not complete.
  std::vector<SurfaceVerdict> named_surfaces;
  /// Found with them.
  std::optional<PolygonOwners> owners;
  std::vector<Issue> issues;

  /// It was not selected: nothing was done.
  bool is_passed_over = false;

  /// It came to the end; if not, `issues` has an error that says why it was set aside.
  [[nodiscard]] bool is_done() const { return segmentation.has_value(); }
  /// Its surfaces can be named, though it may have been set aside.
  [[nodiscard]] bool has_surfaces() const { return surfaces.rows() > 0; }
};

/// Solidifies, segments, describes and, with `rules`, interprets a building. A fault of ours in one
/// building is an error E901 of that building, so that the others go on.
OnLine run_line(const Building& building, const SegmentOptions& options,
                const RepairOptions& repair, const RuleBase* rules, Timings& timings);

/// The rest of it, for a building that has come to its solid, or to none.
/// `describing`: what is read of its description.
OnLine run_from_solid(OnLine line, const Building& building, const SegmentOptions& options,
                      const RuleBase* rules, Timings& timings,
                      const DescribeOptions& describing = {});

/// The first step of it only.
OnLine run_to_solid(const Building& building, const Tolerances& tolerances,
                    const RepairOptions& repair, Timings& timings);

}  // namespace oriel::cli
