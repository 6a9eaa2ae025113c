#include "oriel/label.h"

#include "interpret/surfaces/annotate.h"
#include "kernel/base/sha256.h"
#include "oriel/explain.h"
#include "oriel/pipeline/outlook.h"
#include "oriel/pipeline/pipeline.h"

#include <utility>

#include <fmt/format.h>

namespace oriel {

SegmentOptions segment_options(const PipelineOptions& options, const Tolerances& fitted) {
  SegmentOptions segmenting;
  segmenting.order = options.order;
  segmenting.tolerances = fitted;
  segmenting.budget = options.budget;
  return segmenting;
}

std::string configuration(const PipelineOptions& options) {
  const Tolerances& tolerances = options.tolerances;
  return fmt::format(
             "lod={} order={} coplanar_deg={} plane_offset_m={} weld_m={} value_rel={} budget={} "
             "close={} close_area_m2={} crossings={}",
             options.lod, options.order == Order::paper ? "paper" : "natural",
             tolerances.coplanar_deg, tolerances.plane_offset_m, tolerances.weld_m,
             tolerances.value_rel, options.budget, to_string(options.repair.close),
             options.repair.cap_area_m2,
             options.repair.crossings == Crossings::leave ? "leave" : "cut") +
         (options.fits_noise ? " fitted_to_noise" : "") +
         (options.ignores_semantics ? " ignore_semantics" : "");
}

std::string configuration(const LabelOptions& options) {
  const auto& of_pipeline = static_cast<const PipelineOptions&>(options);
  return configuration(of_pipeline) +
         (options.corrections ? " corrections=" + options.corrections->sha256() : "") +
         (options.neighbours ? " neighbours=" + options.neighbours->sha256() : "");
}

namespace {

/// Adds what is written of the building, if it was asked for.
PipelineResult with_output(const Building& building, PipelineResult labelled, const RuleBase& rules,
                           const LabelOptions& options) {
  if (!options.has_output || !labelled.has_surfaces()) return labelled;
  try {
    labelled.output = annotate(building, labelled, rules, options);
    for (Issue& issue : report_untyped(count_labels(labelled.interpretation), rules)) {
      issue.place.building = building.id;
      labelled.issues.push_back(std::move(issue));
    }
  } catch (const std::exception& fault) {
    labelled.issues.push_back(own_fault(building, fault));
  }
  return labelled;
}

}  // namespace

PipelineResult label(const Building& building, const RuleBase& rules, const LabelOptions& options) {
  return with_output(building, run_pipeline(building, &rules, options), rules, options);
}

PipelineResult label(const Building& building, PipelineResult segmented, const RuleBase& rules,
                     const LabelOptions& options) {
  return with_output(building, name_segmented(building, std::move(segmented), rules, options),
                     rules, options);
}

LabelledBuilding annotate(const Building& building, const PipelineResult& result,
                          const RuleBase& rules, const LabelOptions& options) {
  static const Segmentation none;
  AnnotateOptions annotating;
  annotating.codelist = options.codelist;
  annotating.has_reasons = options.has_reasons;
  if (options.has_reasons && !result.corrections.empty())
    for (const Explanation& explanation : explain_features(result, rules))
      annotating.feature_reasons.push_back(reason(explanation));
  annotating.surfaces = result.named_surfaces;
  if (result.owners) annotating.owners = &*result.owners;
  annotating.attributes.emplace_back("oriel_config_sha256", sha256(configuration(options)));
  LabelledBuilding out = annotate(building, result.segmentation ? *result.segmentation : none,
                                  result.description.table, result.description.graph,
                                  result.surfaces, result.interpretation, rules, annotating);
  add_outlook(building, result, out);
  return out;
}

}  // namespace oriel
