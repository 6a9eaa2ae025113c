#include "cli/mended_line.h"

#include "cli/line_surfaces.h"
#include "cli/written_proof.h"
#include "kernel/validate/validate.h"

#include <array>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// By how much tolerances are made coarser where what crosses is cut: fewer, larger pieces come of
/// surfaces that run through each other at a hair's breadth. At the defaults up to 10 mm, as where
/// they are fitted to noise.
constexpr std::array kCoarser{1.0, 2.5, 5.0};

Building hintless(Building building) {
  for (Polygon& polygon : building.polygons) polygon.hint.clear();
  return building;
}

RepairOptions cutting_closed(const LineArguments& arguments) {
  RepairOptions repair = arguments.repair_options();
  repair.crossings = Crossings::cut_closed;
  return repair;
}

Issue mended_warning(const Building& building, const MendedSolid& mended) {
  const auto findings = validate(building);
  return building_issue(
      Severity::warning, "G417", building.id,
      fmt::format("runs through itself ({} {}); it is redrawn as the boundary of its inside: {} "
                  "polygons were cut, within {:g} mm",
                  findings.empty() ? "E318" : findings[0].code,
                  findings.empty() ? "" : findings[0].sentence, mended.line.repair.cut,
                  1e3 * mended.line.tolerances.plane_offset_m));
}

}  // namespace

OnLine run_whole_line(const LineArguments& arguments, const RuleBase* rules,
                      const Building& building, const Tolerances& tolerances,
                      const RepairOptions& repair, Timings& timings) {
  const SegmentOptions options = arguments.segment_options(tolerances);
  OnLine line = arguments.ignores_semantics
                    ? run_line(hintless(building), options, repair, rules, timings)
                    : run_line(building, options, repair, rules, timings);
  line.tolerances = tolerances;
  if (rules != nullptr) describe_line_surfaces(building, tolerances, timings, line);
  return line;
}

std::optional<MendedSolid> mended_solid(const LineArguments& arguments, const Document& document,
                                        const Building& building, const Tolerances& tolerances,
                                        Timings& timings) {
  for (const double times : kCoarser) {
    Tolerances coarser = tolerances;
    coarser.plane_offset_m *= times;
    coarser.weld_m *= times;
    OnLine line = run_to_solid(building, coarser, cutting_closed(arguments), timings);
    if (!line.solid) continue;
    const WrittenProof proof = prove_written(document, building, *line.solid);
    if (proof.fault) continue;
    line.tolerances = coarser;
    return MendedSolid{std::move(line), proof.digits};
  }
  return std::nullopt;
}

std::optional<OnLine> mended_line(const LineArguments& arguments, const RuleBase* rules,
                                  const Document& document, const Building& building,
                                  const OnLine& line, Timings& timings) {
  const auto mended = mended_solid(arguments, document, building, line.tolerances, timings);
  if (!mended) return std::nullopt;
  OnLine whole = run_whole_line(arguments, rules, building, mended->line.tolerances,
                                cutting_closed(arguments), timings);
  if (!whole.is_done() || whole.is_open) return std::nullopt;
  whole.issues.push_back(mended_warning(building, *mended));
  return whole;
}

}  // namespace oriel::cli
