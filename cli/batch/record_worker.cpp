#include "cli/batch/record_worker.h"

#include "kernel/base/own_fault.h"
#include "oriel/label.h"
#include "oriel/segment.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

PipelineResult RecordWorker::result_of(const Building& building, Timings& timings) const {
  if (options_.ends_at_reading) return {};
  const LabelOptions options = options_.label_options(timings.observer());
  if (options_.ends_at_solid) return solid_of(building, options);
  return rules_ == nullptr ? segment(building, options) : label(building, *rules_, options);
}

BuildingOutcome RecordWorker::outcome_of(const PipelineResult& result) const {
  BuildingOutcome outcome;
  outcome.is_passed_over = result.is_passed_over;
  outcome.is_open = result.is_open();
  outcome.is_done = options_.ends_at_reading ||
                    (options_.ends_at_solid ? result.solid.has_value() : result.is_done());
  outcome.has_features = result.segmentation && !result.segmentation->features.empty();
  outcome.labels = count_labels(result.interpretation);
  outcome.issues = result.issues;
  return outcome;
}

void RecordWorker::work_on(WorkItem& item) const {
  if (!item.needs_work()) return;
  const Document& document = *item.record()->document.value;
  const std::vector<Building>& buildings = document.buildings;
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    now_at_building(i);
    if (!options_.selection.takes(buildings[i], document.feature_type))
      item.results.emplace_back().is_passed_over = true;
    else if (const auto lost = item.lost.find(i); lost != item.lost.end())
      item.results.emplace_back().issues.push_back(lost->second);
    else
      item.results.push_back(result_of(buildings[i], item.timings));
    item.outcome.buildings.push_back(outcome_of(item.results.back()));
  }
  now_at_building(kNoBuilding);
  drop_unselected(item);
  if (producer_ != nullptr && !is_passed_over(item)) make_product(item);
}

/// As if none of its buildings had come to the end.
void RecordWorker::set_all_aside(WorkItem& item, Issue why) {
  const std::vector<Building>& buildings = item.record()->document.value->buildings;
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    BuildingOutcome& outcome = item.outcome.buildings[i];
    if (outcome.is_passed_over) continue;
    item.results[i] = {};
    why.place.building = buildings[i].id;
    if (std::exchange(outcome.is_done, false)) outcome.issues.push_back(why);
    outcome.is_open = outcome.has_features = false;
    outcome.labels.clear();
  }
}

/// A fault of ours, or memory that is used up, costs the record's buildings; the record is written
/// unchanged.
void RecordWorker::make_product(WorkItem& item) const {
  const Record& record = *item.record();
  const auto make = [&] {
    return producer_->make(record.input, *record.document.value, item.results, item.timings);
  };
  try {
    item.outcome.product = make();
  } catch (const OutputError&) {
    throw;  // a scratch file that fails is no fault of the record's
  } catch (const std::exception& fault) {
    set_all_aside(item, own_fault(fault));
    item.outcome.product = make();
  }
  item.results = {};
}

/// Of a file with many records those go on that have something selected; other files are written
/// as a whole.
bool RecordWorker::is_passed_over(const WorkItem& item) const {
  const Record& record = *item.record();
  const Document& document = *record.document.value;
  return !options_.selection.is_all() && !record.is_header && document.format != Format::cityjson &&
         record.document.issues.empty() &&
         std::ranges::all_of(item.outcome.buildings, &BuildingOutcome::is_passed_over) &&
         !(document.buildings.empty() &&
           options_.selection.takes_feature(document.feature_id, document.feature_type));
}

void RecordWorker::drop_unselected(WorkItem& item) const {
  Record* record = item.record();
  if (options_.selection.is_all() || record == nullptr || !record->document.value ||
      record->was_done)
    return;
  const Document& document = *record->document.value;
  std::erase_if(record->document.issues, [&](const Issue& issue) {
    const std::string& id = issue.place.building;
    if (id.empty()) return false;
    const auto read = std::ranges::find(document.buildings, id, &Building::id);
    if (read == document.buildings.end())
      return !options_.selection.takes(id, document.feature_type);
    const auto number = static_cast<std::size_t>(read - document.buildings.begin());
    return item.outcome.buildings[number].is_passed_over;
  });
}

}  // namespace oriel::cli
