#include "oriel/series.h"

#include "generalise/city/group_levels.h"
#include "generalise/series/scale_series.h"
#include "generalise/series/series_levels.h"
#include "interpret/plan/plan.h"
#include "io/levels/level_file.h"
#include "io/levels/written_grid.h"
#include "oriel/drawing/ladder.h"
#include "oriel/drawing/output_check.h"
#include "oriel/drawing/targets.h"
#include "oriel/pipeline/pipeline.h"

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

/// Draws the levels of one building.
class LevelDrawer : public DrawingLadder, public SeriesOrder {
 public:
  /// `scales`: at which it is drawn by itself, of those of the series, the first of which is
  /// `first_scale`.
  LevelDrawer(const Document& document, const Building& building, const RuleBase& rules,
              const SeriesOptions& options, std::vector<double> scales, double first_scale)
      : DrawingLadder(document, building, rules, options),
        profile_(options.profile ? &*options.profile : nullptr),
        scales_(std::move(scales)),
        first_scale_(first_scale) {}

  /// None if one cannot be written as a valid solid (G410, G413); the building as it came need not
  /// be valid, if its levels are.
  void run(const PipelineResult& result) {
    drawn_ = DrawingLadder::run(result);
    from_ = drawn_.source;
    if (drawn_.fault) {
      drawn_.issues.push_back(std::move(*drawn_.fault));
    } else if (drawn_.finest_fault) {
      drawn_.finest_fault->severity = Severity::warning;
      drawn_.finest_fault->sentence += fmt::format("; its levels from 1:{} on are", first_scale_);
      drawn_.issues.push_back(std::move(*drawn_.finest_fault));
    }
    if (drawn_.used_up_budget)
      drawn_.issues.push_back(not_all_drawn(building_, *drawn_.used_up_budget));
  }

  [[nodiscard]] const Drawn& drawn() const { return drawn_; }
  [[nodiscard]] const Building& building() const { return building_; }

  /// All that leads from level to level. At least one scale, though nothing fires between the
  /// building as it came and nothing else.
  [[nodiscard]] ScaleSeries operations(const std::vector<double>& bounds,
                                       const Placer& place) const {
    const FiringScales firing(scales_.empty() ? std::vector<double>{1} : scales_, bounds, *this);
    return scale_series(context_of(drawn_, nullptr), *this, drawn_.levels, firing, place);
  }

  [[nodiscard]] Plan plan_at(double scale) const override {
    return oriel::plan_at(rules_, profile_, *from_->result, scale);
  }
  [[nodiscard]] Invariants invariants_at(double scale) const override {
    return with_party_walls(invariants_of(profile_, rules_, scale), document_, building_,
                            *from_->result);
  }
  void finish(LabelledBuilding& level) const override { DrawingLadder::finish(*from_, level); }
  /// Of a repaired solid each level is judged by itself.
  [[nodiscard]] std::optional<Issue> fault_of(const Solid& solid) const override {
    return from_->is_repaired ? DrawingLadder::fault_of(*from_, solid) : std::nullopt;
  }

 private:
  void draw_levels(Drawn& drawn) override {
    from_ = drawn.source;
    WrittenJudge judge(*check_, *from_->result->solid, from_->is_parted, drawn.source->work);
    auto levels = series_levels(context_of(drawn, &judge), *this, scales_);
    drawn.issues = std::move(levels.issues);
    if (levels.value) drawn.levels = std::move(*levels.value);
  }

  void check(Drawn& drawn) override {
    const auto fault = [&](const SeriesLevel& level) {
      return DrawingLadder::fault_of(*drawn.source, *level.redrawn.labelled.geometry);
    };
    const auto& levels = drawn.levels;
    if (levels.empty()) return;
    drawn.finest_fault = fault(levels[0]);
    for (std::size_t i = 1; i < levels.size() && !drawn.fault; ++i) {
      const bool is_same = levels[i].generalised.removed == levels[i - 1].generalised.removed &&
                           levels[i].generalised.changed.empty();
      if (is_same && i > 1) continue;
      drawn.fault = is_same ? drawn.finest_fault : fault(levels[i]);
    }
  }

  const Profile* profile_;
  std::vector<double> scales_;
  double first_scale_;
  Drawn drawn_;
  std::shared_ptr<const DrawingSource> from_;  ///< of what is drawn at the time
};

/// Draws the levels of a record's buildings.
class SeriesDrawer {
 public:
  SeriesDrawer(const Document& document, const RuleBase& rules, const std::vector<double>& scales,
               const SeriesOptions& options)
      : document_(document),
        rules_(rules),
        scales_(scales),
        asked_(options),
        options_(options),
        profile_(options.profile ? &*options.profile : nullptr),
        grid_(document) {
    // Repairing and labelling again is measured as a part of generalising.
    options_.observer = nullptr;
    if (!options.has_only_levels) bounds_ = plan_bounds(rules);
    for (std::size_t i = 0; i < options.groups.size(); ++i)
      groups_.push_back({scales[i], options.groups[i].get()});
  }

  /// Adds what there is of a building by itself.
  void add(const Building& building, const PipelineResult& result, Series& series) {
    series.finer_digits = grid_.finer_digits();
    if (!building.installations.empty()) {
      const Building alone = without_installations(building);
      return add(alone, label(alone, rules_, asked_), series);
    }
    if (result.surroundings && !groups_.empty()) around_.emplace(building.id, *result.surroundings);
    if (result.is_done())
      measure(asked_.observer, Stage::generalise, [&] { add_levels(building, result, series); });
  }

  /// Adds what there is of groups, after all buildings.
  void add_groups(Series& series) const {
    measure(asked_.observer, Stage::generalise, [&] { add_undrawn(series); });
    for (const Building& building : document_.buildings)
      if (const auto around = around_.find(building.id); around != around_.end())
        std::ranges::move(issues_of_groups(groups_, around->second),
                          std::back_inserter(series.issues));
  }

 private:
  void add_levels(const Building& building, const PipelineResult& result, Series& series) const {
    std::vector<double> scales = scales_;
    scales.resize(std::min(first_in_its_block(building), scales_.size()));
    LevelDrawer one(document_, building, rules_, options_, std::move(scales), scales_.front());
    const Drawn& drawn = logged(
        "drawn at all scales", building,
        [&]() -> const Drawn& {
          one.run(result);
          return one.drawn();
        },
        [](const Drawn& made) {
          return fmt::format("levels={} issues={}", made.levels.size(), made.issues.size());
        });
    const bool is_drawn = !has_errors(drawn.issues);
    series.issues.insert(series.issues.end(), drawn.issues.begin(), drawn.issues.end());
    if (!options_.has_only_levels)
      std::ranges::move(invalid_rest(document_, building, is_drawn),
                        std::back_inserter(series.issues));
    if (!is_drawn) return;
    series.drawn.push_back(building.id);
    add_operations(one, series);
  }

  void add_operations(const LevelDrawer& one, Series& out) const {
    const Building& from = one.building();
    const LabelledBuilding& labelled = one.drawn().source->labelled;
    BuildingSeries building{from.id, from.frame, labelled.attributes, {}, {}, false};
    for (const Installation& installation : labelled.installations)
      building.installations.push_back(installation.id);
    const Placer place = [&](Vec3 local_m) { return grid_.place(local_m, from.frame); };
    try {
      building.series = options_.has_only_levels ? level_series(one.drawn().levels, place)
                                                 : one.operations(bounds_, place);
      add_group_levels(from, place, building.series);
    } catch (const DoubledFacet& fault) {
      out.issues.push_back(doubled(from, fault));
      return;
    } catch (const GeometryError& fault) {
      out.issues.push_back(own_fault(from, fault));
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
    const auto around = around_.find(building.id);
    return around == around_.end() ? scales_.size() : first_in_block(groups_, around->second);
  }

  void add_group_levels(const Building& building, const Placer& place, ScaleSeries& series) const {
    const auto around = around_.find(building.id);
    if (around == around_.end()) return;
    add_group_operations(groups_, building, around->second,
                         fmt::format("{}/buildings", profile_->title()), place, series);
  }

  /// Buildings without levels that become part of a block all the same.
  void add_undrawn(Series& out) const {
    std::set<std::string> drawn;
    for (const BuildingSeries& one : out.buildings) drawn.insert(one.building);
    for (const Building& read : document_.buildings) {
      if (first_in_its_block(read) >= scales_.size() || drawn.contains(read.id)) continue;
      const Building building = without_installations(read);
      BuildingSeries made{building.id, building.frame, {}, {}, {}, true};
      made.series.finest = state_as_read(document_, building);
      add_group_levels(
          building, [&](Vec3 local_m) { return grid_.place(local_m, building.frame); },
          made.series);
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
  const SeriesOptions& asked_;
  SeriesOptions options_;
  const Profile* profile_;
  std::vector<double> bounds_;
  std::vector<GroupsAtScale> groups_;
  WrittenGrid grid_;
  /// What stands around the document's buildings, by id, if there are groups.
  std::map<std::string, Neighbourhood> around_;
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
  Series all;
  SeriesDrawer drawer(document, rules, scales, options);
  for (std::size_t i = 0; i < results.size(); ++i)
    drawer.add(document.buildings[i], results[i], all);
  drawer.add_groups(all);
  return all;
}

Series series(const Document& document, const Building& building, const PipelineResult& result,
              const RuleBase& rules, const std::vector<double>& scales,
              const SeriesOptions& options) {
  Series one;
  SeriesDrawer(document, rules, scales, options).add(building, result, one);
  return one;
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
