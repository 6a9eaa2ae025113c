#pragma once

#include "generalise/generalise.h"
#include "kernel/model/description/feature_table.h"
#include "kernel/model/interpretation.h"
#include "kernel/model/plan.h"
#include "kernel/model/solid.h"

#include <string>
#include <vector>

namespace oriel {

/// What became of one feature, and why.
struct FeatureOutcome {
  std::string feature;    ///< its id
  std::string label;      ///< empty: unknown
  std::string operation;  ///< of the plan; empty: none was asked for
  std::string rule;       ///< the pack's entry or the profile's verdict that asked for it
  /// "kept": nothing was asked for, or is_part(); "omitted"; "changed"; "went along": with what
  /// carries it or with its row; "refused": it is as it was.
  std::string outcome;
  Code code = Code::none;  ///< of a refusal, and of a part
  std::string reason;      ///< of a refusal, and of a part
};

/// One for each feature, in their order.
std::vector<FeatureOutcome> feature_outcomes(const Plan& plan, const Generalised& generalised,
                                             const FeatureTable& table,
                                             const Interpretation& interpretation);

/// Figures of a solid.
struct SolidFigures {
  std::size_t facets = 0;
  std::size_t normals = 0;      ///< different directions of facets
  std::size_t short_edges = 0;  ///< shorter than the given length
  double volume_m3 = 0;
  double footprint_m2 = 0;
};

SolidFigures figures_of(const Solid& solid, double least_edge_m);

}  // namespace oriel
