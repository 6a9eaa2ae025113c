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

PipelineResult RecordWorker::result_of(WorkItem& item, std::size_t i) const {
  const Document& document = *item.record()->document.value;
  PipelineResult result;
  if (!options_.selection.takes(document.buildings[i], document.feature_type))
    result.is_passed_over = true;
  else if (const auto lost = item.lost.find(i); lost != item.lost.end())
    result.issues.push_back(lost->second);
  else
    result = result_of(document.buildings[i], item.timings);
  item.outcome.buildings.push_back(outcome_of(result));
  return result;
}

void RecordWorker::work_on(WorkItem& item) const {
  if (!item.needs_work()) return;
  std::vector<Building>& buildings = item.record()->document.value->buildings;
  std::unique_ptr<ProductMaker> maker;
  std::optional<Issue> fault;
  const auto guarded = [&](const auto& step) {
    if (fault) return;
    try {
      step();
    } catch (const OutputError&) {
      throw;  // a scratch file that fails is no fault of the record's
    } catch (const std::exception& thrown) {
      fault = own_fault(thrown);
    }
  };
  if (producer_ != nullptr) guarded([&] { maker = maker_of(item); });
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    now_at_building(i);
    PipelineResult result = result_of(item, i);
    now_at_building(i);
    if (producer_ == nullptr)
      item.results.push_back(std::move(result));
    else
      guarded([&] { maker->add(i, std::move(result)); });
    if (producer_ != nullptr && !producer_->needs_polygons()) {
      buildings[i].polygons = std::vector<Polygon>();
      buildings[i].vertices = std::vector<Vec3>();
    }
  }
  now_at_building(kNoBuilding);
  drop_unselected(item);
  if (producer_ == nullptr || is_passed_over(item)) return;
  guarded([&] { item.outcome.product = maker->finish(); });
  if (fault) set_all_aside(item, std::move(*fault));
}

std::unique_ptr<ProductMaker> RecordWorker::maker_of(WorkItem& item) const {
  const Record& record = *item.record();
  return producer_->maker(record.input, *record.document.value, item.timings);
}

/// A fault of ours, or memory that is used up, costs the record's buildings, as if none had come to
/// the end; the record is written unchanged.
void RecordWorker::set_all_aside(WorkItem& item, Issue why) const {
  const std::vector<Building>& buildings = item.record()->document.value->buildings;
  const auto maker = maker_of(item);
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    BuildingOutcome& outcome = item.outcome.buildings[i];
    PipelineResult nothing;
    nothing.is_passed_over = outcome.is_passed_over;
    maker->add(i, std::move(nothing));
    if (outcome.is_passed_over) continue;
    why.place.building = buildings[i].id;
    if (std::exchange(outcome.is_done, false)) outcome.issues.push_back(why);
    outcome.is_open = outcome.has_features = false;
    outcome.labels.clear();
  }
  item.outcome.product = maker->finish();
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
