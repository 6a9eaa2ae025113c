#include "cli/batch/run.h"
#include "cli/batch/work_place.h"
#include "cli/pipeline/mended_line.h"
#include "kernel/base/sha256.h"
#include "kernel/solidify/noise.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

Issue noise_note(const Building& building, const Tolerances& fitted) {
  return building_issue(
      Severity::note, Code::E126, building.id,
      fmt::format("corners lie up to {:.1f} mm off the planes of nine in ten polygons: what is "
                  "within {:.1f} mm is one plane (--plane-offset)",
                  1e3 * noise_of(building), 1e3 * fitted.plane_offset_m));
}

}  // namespace

OnLine Run::on_line(const Building& building, Timings& timings) const {
  if (arguments_.ends_at_reading) return {};
  if (arguments_.ends_at_solid)
    return run_to_solid(building, arguments_.tolerances, arguments_.repair_options(), timings);
  const Tolerances fitted = arguments_.tolerances_for(building);
  OnLine line = run_whole_line(arguments_, rules_, building, fitted, timings);
  if (fitted.plane_offset_m != arguments_.tolerances.plane_offset_m)
    line.issues.push_back(noise_note(building, fitted));
  return line;
}

/// The line keeps everything but its issues.
BuildingOutcome Run::outcome_of(OnLine& line) const {
  BuildingOutcome outcome;
  outcome.is_passed_over = line.is_passed_over;
  outcome.is_open = line.is_open;
  outcome.is_done = arguments_.ends_at_reading ||
                    (arguments_.ends_at_solid ? line.solid.has_value() : line.is_done());
  for (const Verdict& verdict : line.interpretation.verdicts) ++outcome.labels[verdict.label];
  outcome.issues = line.issues;
  return outcome;
}

/// Takes from an earlier run what came of the same source.
void Run::reuse(Arrival& arrival) const {
  if (arrival.header_sha256.empty() || arrival.was_done) return;
  arrival.source_sha256 =
      sha256(arrival.header_sha256 + std::string(source_line(*arrival.record.value)));
  auto outcome = earlier_->find(arrival.source_sha256);
  arrival.is_reused =
      outcome && outcome->buildings.size() == arrival.record.value->buildings.size();
  if (!arrival.is_reused) return;
  arrival.outcome = std::move(*outcome);
  drop_unselected(arrival);
}

/// Touches nothing but the arrival.
void Run::work_on(Arrival& arrival, const Visitor& visitor) const {
  if (!arrival.record.value || arrival.was_done || arrival.is_reused) return;
  const Document& document = *arrival.record.value;
  const std::vector<Building>& buildings = document.buildings;
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    now_at_building(i);
    if (!arguments_.selection.takes(buildings[i], document.feature_type))
      arrival.lines.emplace_back().is_passed_over = true;
    else if (const auto lost = arrival.lost.find(i); lost != arrival.lost.end())
      arrival.lines.emplace_back().issues.push_back(lost->second);
    else
      arrival.lines.push_back(on_line(buildings[i], arrival.timings));
    arrival.outcome.buildings.push_back(outcome_of(arrival.lines.back()));
  }
  now_at_building(kNoBuilding);
  drop_unselected(arrival);
  if (visitor.make && !is_passed_over(arrival)) make_product(arrival, visitor);
}

/// As if none of its buildings had come to the end.
void Run::set_all_aside(Arrival& arrival, Code code, const std::string& sentence) const {
  const std::vector<Building>& buildings = arrival.record.value->buildings;
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    BuildingOutcome& outcome = arrival.outcome.buildings[i];
    if (outcome.is_passed_over) continue;
    arrival.lines[i] = {};
    if (std::exchange(outcome.is_done, false))
      outcome.issues.push_back(building_issue(Severity::error, code, buildings[i].id, sentence));
    outcome.is_open = false;
    outcome.labels.clear();
  }
}

/// A fault of ours costs the record's buildings; the record stays as it came.
void Run::make_product(Arrival& arrival, const Visitor& visitor) const {
  const Document& document = *arrival.record.value;
  try {
    arrival.outcome.product = visitor.make(arrival.input, document, arrival.lines, arrival.timings);
  } catch (const std::exception& fault) {
    set_all_aside(arrival, Code::E901, fmt::format("a fault of oriel's own: {}", fault.what()));
    arrival.outcome.product = visitor.make(arrival.input, document, arrival.lines, arrival.timings);
  }
  arrival.lines = {};
}

/// Of a file with many records those go on that have something selected; other files stay as they
/// are.
bool Run::is_passed_over(const Arrival& arrival) const {
  const Document& document = *arrival.record.value;
  return !arguments_.selection.is_all() && !arrival.is_header &&
         document.format != Format::cityjson && arrival.record.issues.empty() &&
         std::ranges::all_of(arrival.outcome.buildings, &BuildingOutcome::is_passed_over) &&
         !(document.buildings.empty() &&
           arguments_.selection.takes_feature(document.feature_id, document.feature_type));
}

/// What was found in buildings that are not asked for is not told.
void Run::drop_unselected(Arrival& arrival) const {
  const auto& outcomes = arrival.outcome.buildings;
  if (arguments_.selection.is_all() || !arrival.record.value || arrival.was_done) return;
  const std::vector<Building>& buildings = arrival.record.value->buildings;
  std::erase_if(arrival.record.issues, [&](const Issue& issue) {
    if (issue.place.building.empty()) return false;
    const auto read = std::ranges::find(buildings, issue.place.building, &Building::id);
    if (read != buildings.end())
      return outcomes[static_cast<std::size_t>(read - buildings.begin())].is_passed_over;
    return !arguments_.selection.takes(issue.place.building, arrival.record.value->feature_type);
  });
}

}  // namespace oriel::cli
