#include "oriel/pipeline/pipeline.h"

#include "interpret/labelling/interpret.h"
#include "kernel/segment/flush/imprints.h"
#include "kernel/segment/rings/ring_features.h"
#include "kernel/solidify/noise.h"
#include "kernel/solidify/open_shell.h"
#include "kernel/solidify/solidify.h"
#include "kernel/solidify/supposed_solid.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <span>

#include <fmt/format.h>

namespace oriel {

namespace {

void append(std::vector<Issue>& all, std::vector<Issue> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// What stood for an error is a warning now, and says how it goes on.
void continue_with(const char* what, std::vector<Issue>& issues) {
  for (Issue& issue : issues) {
    if (issue.severity != Severity::error) continue;
    issue.severity = Severity::warning;
    issue.sentence += what;
  }
}

Issue supposed_faces(const Building& building, std::span<const Cap> faces) {
  double sum = 0, largest = 0;
  for (const Cap& face : faces) {
    sum += face.area_m2;
    largest = std::max(largest, face.area_m2);
  }
  return building_issue(Severity::warning, Code::E319, building.id,
                        fmt::format("{} missing faces were supposed, {:.2f} m² together, the "
                                    "largest {:.2f} m²: features are found as if they were there",
                                    faces.size(), sum, largest));
}

/// Goes on with a building that solidify found open: with the solid that it would be if the faces
/// that are missing were there, if holes may be closed at all, else with the facets that there are.
/// Returns what is to be said of the features that are found so.
std::vector<Issue> open_up(const Building& building, const Tolerances& tolerances, Closing closing,
                           PipelineResult& out) {
  const auto is_geometry = [](const Issue& issue) {
    return issue.severity != Severity::error || is_about_geometry(issue.code);
  };
  if (!std::ranges::all_of(out.issues, is_geometry)) return {};
  std::vector<Issue> of_features;
  auto supposed = closing == Closing::none ? std::nullopt : supposed_solid(building, tolerances);
  if (supposed) {
    continue_with("; faces are supposed where they are missing", out.issues);
    append(out.issues, std::move(supposed->issues));
    of_features.push_back(supposed_faces(building, supposed->faces));
    out.solid = std::move(supposed->solid);
    out.is_supposed = true;
  } else if ((out.solid = open_shell(building, tolerances))) {
    continue_with("; features are taken from its rings, nothing is cut", out.issues);
  }
  out.is_open = out.solid.has_value();
  return of_features;
}

/// The building without what its input calls the polygons.
Building without_hints(Building building) {
  for (Polygon& polygon : building.polygons) polygon.hint.clear();
  return building;
}

Issue noise_note(const Building& building, const Tolerances& fitted) {
  return building_issue(
      Severity::note, Code::E126, building.id,
      fmt::format("corners lie up to {:.1f} mm off the planes of nine in ten polygons: what is "
                  "within {:.1f} mm is one plane (--plane-offset)",
                  1e3 * noise_of(building), 1e3 * fitted.plane_offset_m));
}

/// Only what the rules read, where nothing else was asked for.
DescribeOptions describe_options(const RuleBase* rules, const LabelOptions& options) {
  if (rules == nullptr || options.measures_features) return {};
  return {rules->attributes_read(), rules->relations_read()};
}

Segmentation all_features(const Building& building, const PipelineResult& result,
                          const SegmentOptions& options) {
  const Solid& solid = *result.solid;
  Segmentation found = result.is_solid() ? segment(building, solid, options) : segment_open(solid);
  add_ring_features(building, solid, found, options.tolerances);
  add_imprints(building, solid, found, options.tolerances);
  return found;
}

/// Fills what stands between the solid and the surfaces.
void find_features(const Building& building, const RuleBase* rules, const Tolerances& tolerances,
                   const LabelOptions& options, PipelineResult& out) {
  const StageObserver& observer = options.observer;
  std::vector<Issue> of_features;
  if (!out.solid)
    of_features = measure(observer, Stage::solidify,
                          [&] { return open_up(building, tolerances, options.repair.close, out); });
  if (!out.solid) return;
  Segmentation segmentation = measured(
      observer, Stage::segment, "segmented", building,
      [&] { return all_features(building, out, segment_options(options, tolerances)); },
      [](const Segmentation& found) { return fmt::format("features={}", found.features.size()); });
  segmentation.issues.insert(segmentation.issues.begin(), of_features.begin(), of_features.end());
  append(out.issues, segmentation.issues);
  out.description = measured(
      observer, Stage::describe, "described", building,
      [&] { return describe(building, segmentation, describe_options(rules, options)); },
      [](const Description& found) { return fmt::format("features={}", found.table.rows()); });
  if (rules != nullptr) {
    out.interpretation = measured(
        observer, Stage::interpret, "interpreted", building,
        [&] { return interpret(*rules, out.description.table, out.description.graph); },
        [](const Interpretation& found) {
          return fmt::format("labelled={}",
                             std::ranges::count_if(found.verdicts, [](const Verdict& verdict) {
                               return !verdict.label.empty();
                             }));
        });
    append(out.issues, out.interpretation.issues);
  }
  out.segmentation = std::move(segmentation);
}

}  // namespace

Issue own_fault(const Building& building, const std::exception& fault) {
  return building_issue(Severity::error, Code::E901, building.id,
                        fmt::format("a fault of oriel's own: {}", fault.what()));
}

PipelineResult run_to_solid(const Building& building, const Tolerances& tolerances,
                            const RepairOptions& repair, const StageObserver& observer) {
  PipelineResult out;
  try {
    auto solid = measured(
        observer, Stage::solidify, "solidified", building,
        [&] { return solidify(building, tolerances, repair); },
        [](const auto& made) {
          return fmt::format("facets={} issues={}", made.value ? made.value->facets.size() : 0,
                             made.issues.size());
        });
    append(out.issues, std::move(solid.issues));
    out.repair = std::move(solid.report);
    out.solid = std::move(solid.value);
  } catch (const std::exception& fault) {
    out.issues.push_back(own_fault(building, fault));
  }
  return out;
}

PipelineResult run_from_solid(PipelineResult out, const Building& building, const RuleBase* rules,
                              const Tolerances& tolerances, const LabelOptions& options) {
  const auto is_ours = [](const Issue& issue) { return issue.code == Code::E901; };
  if (std::ranges::none_of(out.issues, is_ours)) {
    try {
      if (options.ignores_semantics)
        find_features(without_hints(building), rules, tolerances, options, out);
      else
        find_features(building, rules, tolerances, options, out);
    } catch (const std::exception& fault) {
      out.issues.push_back(own_fault(building, fault));
    }
  }
  out.tolerances = tolerances;
  if (rules != nullptr && options.measures_surfaces)
    describe_all_surfaces(building, tolerances, options.observer, out);
  else if (rules != nullptr)
    name_surfaces(building, tolerances, *rules, options.observer, out);
  return out;
}

PipelineResult run_pipeline(const Building& building, const RuleBase* rules,
                            const LabelOptions& options) {
  const Tolerances& given = options.tolerances;
  const Tolerances fitted = options.fits_noise ? fitted_to_noise(given, noise_of(building)) : given;
  PipelineResult result =
      run_from_solid(run_to_solid(building, fitted, options.repair, options.observer), building,
                     rules, fitted, options);
  if (fitted.plane_offset_m != given.plane_offset_m)
    result.issues.push_back(noise_note(building, fitted));
  return result;
}

}  // namespace oriel
