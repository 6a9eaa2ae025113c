#include "oriel/series.h"

#include "generalise/city/group_levels.h"
#include "generalise/series/scale_series.h"
#include "generalise/series/series_levels.h"
#include "interpret/plan/plan.h"
#include "io/levels/level_file.h"
#include "io/levels/written_grid.h"
#include "oriel/pipeline/faulty_imprints.h"
#include "oriel/pipeline/output_check.h"
#include "oriel/pipeline/pipeline.h"
#include "oriel/pipeline/repair_and_retry.h"
#include "oriel/pipeline/targets.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// One building with its levels, before the grid of the file is known.
struct LeveledBuilding {
  const Building* building = nullptr;
  const PipelineResult* result = nullptr;
  LabelledBuilding labelled;
  bool is_judged = false;  ///< each step of its levels is, which takes long
  /// It is drawn from a repaired solid: folded facets are parted, and each level judged by itself.
  bool is_repaired = false;
  std::vector<SeriesLevel> levels{};
  std::unique_ptr<FiringScales> firing{};  ///< none if only levels are asked for
  FaultyImprints undrawn{};
  std::vector<Issue> issues{};  ///< of its levels
  /// Of the building as it came, before anything is done for a scale.
  std::optional<Issue> finest_fault{};
  std::unique_ptr<const PipelineResult> repaired{};  ///< what `result` is, if it was repaired
  std::shared_ptr<Work> work{};                      ///< of all its levels and operations
  std::vector<double> scales{};                      ///< at which it is drawn by itself

  /// All levels are valid solids in the file, and so is the building as it came.
  [[nodiscard]] bool is_valid() const { return !has_errors(issues) && !finest_fault; }
};

/// Draws the levels of a record's buildings.
class SeriesDrawer {
 public:
  SeriesDrawer(const Document& document, const RuleBase& rules, const std::vector<double>& scales,
               const SeriesOptions& options)
      : document_(document),
        rules_(rules),
        scales_(scales),
        options_(options),
        profile_(options.profile ? &*options.profile : nullptr),
        bounds_(plan_bounds(rules)) {
    // Repairing and labelling again is measured as a part of generalising.
    options_.observer = nullptr;
    for (std::size_t i = 0; i < options.groups.size(); ++i)
      groups_.push_back({scales[i], options.groups[i].get()});
  }

  Series draw(const std::vector<PipelineResult>& results, const StageObserver& observer) {
    Series series;
    std::vector<LeveledBuilding> all;
    for (std::size_t i = 0; i < results.size() && !groups_.empty(); ++i)
      if (results[i].surroundings)
        around_.emplace(&document_.buildings[i], &*results[i].surroundings);
    measure(observer, Stage::generalise, [&] {
      for (std::size_t i = 0; i < results.size(); ++i)
        if (results[i].is_done()) add_levels(document_.buildings[i], results[i], all, series);
    });
    const WrittenGrid grid(document_);
    series.finer_digits = grid.finer_digits();
    measure(observer, Stage::generalise, [&] {
      for (const LeveledBuilding& one : all) add_operations(one, grid, series);
      add_undrawn(grid, series);
    });
    for (const Building& building : document_.buildings)
      if (const auto around = around_.find(&building); around != around_.end())
        std::ranges::move(issues_of_groups(groups_, *around->second),
                          std::back_inserter(series.issues));
    return series;
  }

 private:
  /// The levels of a building; none if one cannot be written as a valid solid (G410, G413). First
  /// its steps are judged, then it is repaired, where either helps.
  void add_levels(const Building& building, const PipelineResult& result,
                  std::vector<LeveledBuilding>& all, Series& series) {
    LeveledBuilding one = logged(
        "drawn at all scales", building,
        [&] {
          return result.is_open() ? open_levels(building, result) : valid_levels(building, result);
        },
        [](const LeveledBuilding& made) {
          return fmt::format("levels={} issues={}", made.levels.size(), made.issues.size());
        });
    series.issues.insert(series.issues.end(), one.issues.begin(), one.issues.end());
    if (one.work->is_used_up()) series.issues.push_back(not_all_drawn(building, *one.work));
    if (!options_.has_only_levels)
      std::ranges::move(invalid_rest(document_, building, !has_errors(one.issues)),
                        std::back_inserter(series.issues));
    if (has_errors(one.issues)) return;
    series.drawn.push_back(building.id);
    all.push_back(std::move(one));
  }

  [[nodiscard]] LeveledBuilding valid_levels(const Building& building,
                                             const PipelineResult& result) const {
    const auto work = std::make_shared<Work>(drawing_work(options_.budget));
    LeveledBuilding one = with_levels(building, result, work);
    if (has_errors(one.issues) && !work->is_used_up()) judge(one);
    if (!one.is_valid()) repair(one);
    if (!one.is_valid()) draw_without_imprints(one);
    if (one.finest_fault) {
      one.finest_fault->sentence += fmt::format("; its levels from 1:{} on are", scales_.front());
      one.issues.push_back(std::move(*one.finest_fault));
    }
    return one;
  }

  /// Of an open building, from what repair_open() makes of it.
  [[nodiscard]] LeveledBuilding open_levels(const Building& building,
                                            const PipelineResult& result) const {
    const auto work = std::make_shared<Work>(drawing_work(options_.budget));
    auto repaired = repair_open(document_, building, result, rules_, options_, *work);
    if (!repaired) {
      LeveledBuilding none{&building, &result, {}};
      none.work = work;
      none.issues.push_back(stays_open(building));
      return none;
    }
    auto closed = std::make_unique<const PipelineResult>(std::move(*repaired));
    LeveledBuilding one = valid_levels(building, *closed);
    one.issues.insert(one.issues.begin(), closed->issues.back());
    if (!one.repaired) one.repaired = std::move(closed);
    return one;
  }

  [[nodiscard]] LeveledBuilding with_levels(const Building& building, const PipelineResult& result,
                                            const std::shared_ptr<Work>& work,
                                            bool is_repaired = false) const {
    LeveledBuilding one{&building, &result, annotate(building, result, rules_, options_)};
    one.is_repaired = is_repaired;
    one.work = work;
    one.scales = scales_;
    one.scales.resize(std::min(first_in_its_block(building), scales_.size()));
    draw_levels(one);
    return one;
  }

  /// Draws them again without the imprints that keep them from being valid, if they are then.
  void draw_without_imprints(LeveledBuilding& one) const {
    while (!one.is_valid() && !one.work->is_used_up() && add_faulty(one)) draw_levels(one);
    if (one.undrawn.ids().empty()) return;
    if (one.is_valid()) {
      const auto issues = one.undrawn.issues(one.result->description.table);
      one.issues.insert(one.issues.end(), issues.begin(), issues.end());
    } else {
      one.undrawn = {};
      draw_levels(one);
    }
  }

  /// False if there are no more than were known.
  bool add_faulty(LeveledBuilding& one) const {
    bool has_more = false;
    for (const SeriesLevel& level : one.levels)
      has_more |= one.undrawn.add(document_, *one.building, one.result->segmentation.value(),
                                  *level.redrawn.labelled.geometry);
    return has_more;
  }

  /// Draws them again with every step judged.
  void judge(LeveledBuilding& one) const {
    one.is_judged = true;
    draw_levels(one);
  }

  /// Draws them from the repaired solid, if they are valid then.
  void repair(LeveledBuilding& one) const {
    const auto work = std::make_shared<Work>(options_.budget);
    auto repaired =
        repair_and_retry(document_, *one.building, *one.result, rules_, options_, *work);
    if (!repaired) return;
    auto result = std::make_unique<const PipelineResult>(std::move(*repaired));
    LeveledBuilding anew = with_levels(*one.building, *result, work, true);
    if (!anew.is_valid()) return;
    anew.issues.insert(anew.issues.begin(), result->issues.back());
    anew.repaired = std::move(result);
    one = std::move(anew);
  }

  [[nodiscard]] SeriesInput input_of(const LeveledBuilding& one) const {
    SeriesInput input{*one.building,
                      one.labelled,
                      *one.result->solid,
                      *one.result->segmentation,
                      one.result->description.table,
                      one.result->interpretation,
                      segment_options(options_, one.result->tolerances),
                      [this, &one](double scale) { return invariants_at(one, scale); },
                      nullptr,
                      nullptr,
                      one.work.get(),
                      one.undrawn.ids()};
    if (!one.is_repaired) return input;
    input.finish = [this, building = one.building](LabelledBuilding& labelled) {
      part_written(document_, *building, labelled);
    };
    input.fault_of = [this, building = one.building, result = one.result](const Solid& solid) {
      return check_redrawn(document_, *building, *result->solid, solid);
    };
    return input;
  }

  [[nodiscard]] Invariants invariants_at(const LeveledBuilding& one, double scale) const {
    const Solid& solid = *one.result->solid;
    Invariants invariants = with_party_walls(invariants_of(profile_, rules_, scale), document_,
                                             *one.building, *one.result);
    invariants.work = one.work.get();
    if (!one.is_repaired || !is_intricate(*one.result))
      invariants.validator =
          counted(judge_as_written(document_, *one.building, solid, one.is_judged), *one.work);
    return invariants;
  }

  void draw_levels(LeveledBuilding& one) const {
    const PipelineResult& result = *one.result;
    const auto& [table, graph, issues] = result.description;
    const PlanAt plan_at = [&](double scale) {
      Plan asked = plan(rules_, table, graph, result.interpretation, scale);
      if (profile_ != nullptr)
        asked = plan_by_profile(std::move(asked), *profile_, rules_, *result.segmentation, table,
                                result.interpretation, scale);
      return asked;
    };
    auto levels = series_levels(input_of(one), one.scales, plan_at);
    one.issues = std::move(levels.issues);
    one.levels.clear();
    one.finest_fault.reset();
    if (!levels.value) return;
    one.levels = std::move(*levels.value);
    check(one);
    if (options_.has_only_levels) return;
    // At least one scale, though nothing fires between the building as it came and nothing else.
    one.firing = std::make_unique<FiringScales>(
        one.scales.empty() ? std::vector<double>{1} : one.scales, bounds_, plan_at);
  }

  /// A level that is not valid as it is written is an error; the building as it came need not be,
  /// if its levels are.
  void check(LeveledBuilding& one) const {
    one.finest_fault = fault_of(one, one.levels[0]);
    for (std::size_t i = 1; i < one.levels.size() && !has_errors(one.issues); ++i) {
      const SeriesLevel& level = one.levels[i];
      const bool is_same = level.generalised.removed == one.levels[i - 1].generalised.removed &&
                           level.generalised.changed.empty();
      if (is_same && i > 1) continue;
      std::optional<Issue> fault = is_same ? one.finest_fault : fault_of(one, level);
      if (!fault) continue;
      fault->severity = Severity::error;
      one.issues.push_back(std::move(*fault));
    }
    if (one.finest_fault) one.finest_fault->severity = Severity::warning;
    if (has_errors(one.issues)) one.finest_fault.reset();
  }

  [[nodiscard]] std::optional<Issue> fault_of(const LeveledBuilding& one,
                                              const SeriesLevel& level) const {
    return check_redrawn(document_, *one.building, *one.result->solid,
                         *level.redrawn.labelled.geometry);
  }

  void add_operations(const LeveledBuilding& one, const WrittenGrid& grid, Series& out) const {
    const Frame& frame = one.building->frame;
    BuildingSeries building{one.building->id, frame, one.labelled.attributes, {}, {}, false};
    for (const Installation& installation : one.labelled.installations)
      building.installations.push_back(installation.id);
    const Placer place = [&](Vec3 local_m) { return grid.place(local_m, frame); };
    try {
      building.series = one.firing ? scale_series(input_of(one), one.levels, *one.firing, place)
                                   : level_series(one.levels, place);
      add_groups(*one.building, place, building.series);
    } catch (const DoubledFacet& fault) {
      out.issues.push_back(doubled(*one.building, fault));
      return;
    } catch (const GeometryError& fault) {
      out.issues.push_back(own_fault(*one.building, fault));
      return;
    }
    add(std::move(building), out);
  }

  void add(BuildingSeries building, Series& out) const {
    for (SeriesOperation& operation : building.series.operations) operation.lod = options_.lod;
    out.buildings.push_back(std::move(building));
  }

  /// The number of the first scale at which it is in a block, or one that is no scale's.
  [[nodiscard]] std::size_t first_in_its_block(const Building& building) const {
    const auto around = around_.find(&building);
    return around == around_.end() ? scales_.size() : first_in_block(groups_, *around->second);
  }

  void add_groups(const Building& building, const Placer& place, ScaleSeries& series) const {
    const auto around = around_.find(&building);
    if (around == around_.end()) return;
    add_group_operations(groups_, building, *around->second,
                         fmt::format("{}/buildings", profile_->title()), place, series);
  }

  /// Buildings without levels that become part of a block all the same.
  void add_undrawn(const WrittenGrid& grid, Series& out) const {
    std::set<std::string> drawn;
    for (const BuildingSeries& one : out.buildings) drawn.insert(one.building);
    for (const Building& building : document_.buildings) {
      if (first_in_its_block(building) >= scales_.size() || drawn.contains(building.id)) continue;
      BuildingSeries made{building.id, building.frame, {}, {}, {}, true};
      made.series.finest = state_as_read(document_, building);
      add_groups(
          building, [&](Vec3 local_m) { return grid.place(local_m, building.frame); }, made.series);
      add(std::move(made), out);
    }
  }

  /// No valid solid has such, so it was none when it was read, and its levels are none.
  static Issue doubled(const Building& building, const DoubledFacet& fault) {
    const Vec3 p = metres_of(fault.corner());
    return building_issue(Severity::error, Code::G410, building.id,
                          fmt::format("is not a series: {} at ({:.3f}, {:.3f}, {:.3f})",
                                      fault.what(), p.x, p.y, p.z));
  }

  const Document& document_;
  const RuleBase& rules_;
  const std::vector<double>& scales_;
  SeriesOptions options_;
  const Profile* profile_;
  std::vector<double> bounds_;
  std::vector<GroupsAtScale> groups_;
  /// What stands around the document's buildings, if there are groups.
  std::map<const Building*, const Neighbourhood*> around_;
};

}  // namespace

std::vector<SeriesOperation> Series::operations() const {
  std::vector<SeriesOperation> all;
  for (const BuildingSeries& one : buildings)
    all.insert(all.end(), one.series.operations.begin(), one.series.operations.end());
  return all;
}

Series series(const Document& document, const std::vector<PipelineResult>& results,
              const RuleBase& rules, const std::vector<double>& scales,
              const SeriesOptions& options) {
  if (std::ranges::all_of(document.buildings,
                          [](const Building& b) { return b.installations.empty(); }))
    return SeriesDrawer(document, rules, scales, options).draw(results, options.observer);
  Document alone = document;
  std::vector<PipelineResult> of_alone = results;
  for (std::size_t i = 0; i < alone.buildings.size(); ++i) {
    if (alone.buildings[i].installations.empty()) continue;
    alone.buildings[i] = without_installations(std::move(alone.buildings[i]));
    of_alone[i] = label(alone.buildings[i], rules, options);
  }
  return SeriesDrawer(alone, rules, scales, options).draw(of_alone, options.observer);
}

OutputRecord at(const Series& series, double scale) { return levels(series, {scale})[0]; }

std::vector<OutputRecord> levels(const Series& series, const std::vector<double>& scales) {
  std::vector<OutputRecord> outputs(scales.size());
  for (OutputRecord& output : outputs) output.options.finer_digits = series.finer_digits;
  for (const BuildingSeries& one : series.buildings) {
    LevelState state = one.series.finest;
    double from = 0;
    for (std::size_t i = 0; i < scales.size(); ++i) {
      if (!move_state(state, one.series.operations, std::exchange(from, scales[i]), scales[i]))
        throw GeometryError("an operation of a series does not fit the state before it");
      if (one.is_as_read && state == one.series.finest) continue;
      if (state.facets.empty()) outputs[i].options.emptied.push_back(one.building);
      LabelledBuilding level = labelled_building(state, one.frame);
      for (const std::string& id : one.installations)
        if (!state.installations.contains(id)) outputs[i].options.removed.push_back(id);
      level.attributes.insert(level.attributes.begin(), one.attributes.begin(),
                              one.attributes.end());
      outputs[i].buildings.push_back(std::move(level));
    }
  }
  return outputs;
}

}  // namespace oriel
