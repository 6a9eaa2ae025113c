#include "oriel/segment.h"

#include "kernel/segment/complex/cell_complex.h"
#include "oriel/pipeline/pipeline.h"

#include <utility>

namespace oriel {

PipelineResult solid_of(const Building& building, const PipelineOptions& options) {
  if (auto issue = no_body(building, options)) {
    PipelineResult without;
    without.issues.push_back(std::move(*issue));
    return without;
  }
  Work work(options.budget);
  return run_to_solid(building, options.tolerances, options.repair, work, options.observer);
}

PipelineResult segment(const Building& building, const PipelineOptions& options,
                       std::shared_ptr<const NeighbourSearch> neighbours) {
  LabelOptions labelling;
  static_cast<PipelineOptions&>(labelling) = options;
  labelling.neighbours = std::move(neighbours);
  return run_pipeline(building, nullptr, labelling);
}

CellComplex cell_complex(const PipelineResult& result) {
  return cell_complex(*result.segmentation, result.tolerances);
}

std::optional<CellComplex> cell_complex(const PipelineResult& result, std::int64_t budget) {
  Work work(budget);
  return cell_complex(*result.segmentation, result.tolerances, work);
}

TreeComparison compare_trees(const PipelineResult& result, std::int64_t budget) {
  const Segmentation& segmentation = *result.segmentation;
  TreeComparison found;
  Work work(budget);
  found.cut = figures_of(segmentation);
  found.tree = balance(segmentation);
  found.balanced = figures_of(found.tree, segmentation);
  found.balanced_proof = prove(found.tree, segmentation, work);
  merge_touching(found.tree, segmentation);
  found.merged = figures_of(found.tree, segmentation);
  found.merged_proof = prove(found.tree, segmentation, work);
  found.is_used_up = work.is_used_up();
  return found;
}

}  // namespace oriel
