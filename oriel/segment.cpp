#include "oriel/segment.h"

#include "kernel/segment/complex/cell_complex.h"
#include "oriel/pipeline/pipeline.h"

#include <utility>

namespace oriel {

PipelineResult solid_of(const Building& building, const PipelineOptions& options) {
  Work work(options.budget);
  return run_to_solid(building, options.tolerances, options.repair, work, options.observer);
}

PipelineResult segment(const Building& building, const PipelineOptions& options) {
  LabelOptions labelling;
  static_cast<PipelineOptions&>(labelling) = options;
  return run_pipeline(building, nullptr, labelling);
}

CellComplex cell_complex(const PipelineResult& result) {
  return cell_complex(*result.segmentation, result.tolerances);
}

TreeComparison compare_trees(const PipelineResult& result) {
  const Segmentation& segmentation = *result.segmentation;
  TreeComparison found;
  found.cut = figures_of(segmentation);
  found.tree = balance(segmentation);
  found.balanced = figures_of(found.tree, segmentation);
  found.balanced_proof = prove(found.tree, segmentation);
  merge_touching(found.tree, segmentation);
  found.merged = figures_of(found.tree, segmentation);
  found.merged_proof = prove(found.tree, segmentation);
  return found;
}

}  // namespace oriel
