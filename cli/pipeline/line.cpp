#include "cli/pipeline/line.h"

#include "interpret/labelling/interpret.h"
#include "kernel/segment/flush/imprints.h"
#include "kernel/segment/rings/ring_features.h"
#include "kernel/segment/segment_open.h"
#include "kernel/solidify/open_shell.h"
#include "kernel/solidify/solidify.h"

#include <algorithm>
#include <exception>
#include <iterator>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

void append(std::vector<Issue>& all, std::vector<Issue> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// The facets of a building that solidify found open, or nothing if it found something else: what
/// was an error then is a warning.
std::optional<Solid> opened(const Building& building, std::vector<Issue>& issues,
                            const Tolerances& tolerances) {
  const auto is_geometry = [](const Issue& issue) {
    return issue.severity != Severity::error || is_about_geometry(issue.code);
  };
  if (!std::ranges::all_of(issues, is_geometry)) return std::nullopt;
  auto shell = open_shell(building, tolerances);
  if (!shell) return shell;
  for (Issue& issue : issues) {
    if (issue.severity != Severity::error) continue;
    issue.severity = Severity::warning;
    issue.sentence += "; features are taken from its rings, nothing is cut";
  }
  return shell;
}

void make_solid(const Building& building, const Tolerances& tolerances, const RepairOptions& repair,
                Timings& timings, OnLine& out) {
  auto solid =
      timings.measure(Stage::solidify, [&] { return solidify(building, tolerances, repair); });
  append(out.issues, std::move(solid.issues));
  out.repair = std::move(solid.report);
  out.solid = std::move(solid.value);
}

Issue fault_of_ours(const Building& building, const std::exception& fault) {
  return building_issue(Severity::error, Code::E901, building.id,
                        fmt::format("a fault of oriel's own: {}", fault.what()));
}

}  // namespace

OnLine run_to_solid(const Building& building, const Tolerances& tolerances,
                    const RepairOptions& repair, Timings& timings) {
  OnLine out;
  try {
    make_solid(building, tolerances, repair, timings, out);
  } catch (const std::exception& fault) {
    out.issues.push_back(fault_of_ours(building, fault));
  }
  return out;
}

OnLine run_line(const Building& building, const SegmentOptions& options,
                const RepairOptions& repair, const RuleBase* rules, Timings& timings) {
  return run_from_solid(run_to_solid(building, options.tolerances, repair, timings), building,
                        options, rules, timings);
}

OnLine run_from_solid(OnLine out, const Building& building, const SegmentOptions& options,
                      const RuleBase* rules, Timings& timings, const DescribeOptions& describing) {
  const auto is_ours = [](const Issue& issue) { return issue.code == Code::E901; };
  if (std::ranges::any_of(out.issues, is_ours)) return out;
  try {
    if (!out.solid) {
      out.solid = timings.measure(Stage::solidify,
                                  [&] { return opened(building, out.issues, options.tolerances); });
      out.is_open = out.solid.has_value();
    }
    if (!out.solid) return out;
    Segmentation segmentation = timings.measure(Stage::segment, [&] {
      Segmentation found =
          out.is_open ? segment_open(*out.solid) : segment(building, *out.solid, options);
      add_ring_features(building, *out.solid, found, options.tolerances);
      add_imprints(building, *out.solid, found, options.tolerances);
      return found;
    });
    append(out.issues, segmentation.issues);
    out.description = timings.measure(Stage::describe,
                                      [&] { return describe(building, segmentation, describing); });
    if (rules != nullptr) {
      out.interpretation = timings.measure(Stage::interpret, [&] {
        return interpret(*rules, out.description.table, out.description.graph);
      });
      append(out.issues, out.interpretation.issues);
    }
    out.segmentation = std::move(segmentation);
  } catch (const std::exception& fault) {
    out.issues.push_back(fault_of_ours(building, fault));
  }
  return out;
}

}  // namespace oriel::cli
