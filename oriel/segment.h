#pragma once

#include "kernel/base/work.h"
#include "kernel/neighbours/neighbours.h"
#include "kernel/segment/tree/balance.h"
#include "model/building.h"
#include "model/cell_complex.h"
#include "oriel/options.h"
#include "oriel/result.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace oriel {

/// The solid of a building and nothing more: PipelineResult::solid, `repair` and `issues`.
/// Tolerances are taken as they are given, not fitted to noise. Never throws: a fault of oriel's
/// own is an error E901 of the building.
PipelineResult solid_of(const Building& building, const PipelineOptions& options = {});

/// The features of a building, without labels and without surfaces.
///
/// 1. Tolerances are fitted to the noise of the building (PipelineOptions::fits_noise).
/// 2. solidify; of a building that stays open, open_shell, from whose rings features are taken.
/// 3. segment, ring features, imprints (paper, section 4; docs/segmentation.md).
/// 4. describe: attributes and relations of every feature (docs/describe.md).
///
/// PipelineResult::is_done() says whether it came to the end; if not, `issues` has the error. Never
/// throws: a fault of oriel's own is an error E901 of the building. The result depends on the
/// building and the options only.
/// `neighbours` are LabelOptions::neighbours.
PipelineResult segment(const Building& building, const PipelineOptions& options = {},
                       std::shared_ptr<const NeighbourSearch> neighbours = nullptr);

/// Which cell of a building meets which, and where (docs/segmentation.md). `result` is what
/// segment() or label() said of it, is_done().
CellComplex cell_complex(const PipelineResult& result);

/// The same within `budget` steps (PipelineOptions::budget); nothing if they are used up.
std::optional<CellComplex> cell_complex(const PipelineResult& result, std::int64_t budget);

/// The CSG tree of a building as it was cut, and arranged anew (paper, section 6).
struct TreeComparison {
  TreeFigures cut, balanced, merged;
  BalanceProof balanced_proof, merged_proof;
  /// Balanced, with touching parts merged.
  BalancedTree tree;

  /// The proofs asked fewer points than there are: their work was used up.
  bool is_used_up = false;

  /// All are the same body; false is a fault of oriel's own.
  [[nodiscard]] bool is_same_body() const { return balanced_proof.holds() && merged_proof.holds(); }
};

/// `result` is what segment() or label() said of a building, is_done() and not open. The proofs
/// take no more than `budget` steps.
TreeComparison compare_trees(const PipelineResult& result, std::int64_t budget = kWorkBudget);

}  // namespace oriel
