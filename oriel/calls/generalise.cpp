#include "oriel/generalise.h"

#include "generalise/invariants/fineness.h"
#include "generalise/to_lod.h"
#include "io/levels/written_grid.h"
#include "kernel/mesh/measures.h"
#include "oriel/drawing/drawing_quality.h"
#include "oriel/drawing/faulty_imprints.h"
#include "oriel/drawing/ladder.h"
#include "oriel/drawing/output_check.h"
#include "oriel/drawing/targets.h"
#include "oriel/pipeline/pipeline.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace {

/// Draws one building for its targets.
class TargetDrawer : public DrawingLadder {
 public:
  TargetDrawer(const Document& document, const Building& building, const RuleBase& rules,
               const Targets& targets, const GeneraliseOptions& options)
      : DrawingLadder(document, building, rules, options), targets_(targets), asked_(options) {}

  GeneralisedBuilding drawing(const PipelineResult& result) {
    Drawn drawn = run(result);
    GeneralisedBuilding out;
    out.building = building_.id;
    out.is_given_up = is_given_up_;
    if (is_given_up_) return out;
    if (drawn.fault) leave(drawn);
    if (drawn.used_up_budget)
      drawn.issues.push_back(not_all_drawn(building_, *drawn.used_up_budget));
    if (!has_errors(drawn.issues))
      for (SeriesLevel& level : drawn.levels) out.levels.push_back(std::move(level.redrawn));
    out.reports = std::move(drawn.reports);
    out.issues = std::move(drawn.issues);
    if (drawn.source && drawn.source->result.get() != &result)
      out.repaired = std::move(drawn.source->result);
    return out;
  }

 private:
  /// Judge as long as somebody waits.
  class WaitedForJudge : public WrittenJudge {
   public:
    WaitedForJudge(TargetDrawer& drawer, OutputCheck& check, const Solid& own, bool is_parted,
                   Work& work)
        : WrittenJudge(check, own, is_parted, work), drawer_(drawer) {}

   private:
    bool is_given_up() override { return drawer_.is_given_up(Stage::generalise); }

    TargetDrawer& drawer_;
  };

  void draw_levels(Drawn& drawn) override;
  void check(Drawn& drawn) override;
  /// Asks whoever waits, until nobody does.
  bool is_given_up(Stage stage) override {
    return is_given_up_ = is_given_up_ || (asked_.is_given_up && asked_.is_given_up(stage));
  }

  bool draw_for(const Profile* profile, RedrawContext& context, Drawn& drawn);
  [[nodiscard]] Plan plan_for(const Profile* profile, Drawn& drawn) const;
  Checked<Generalised> carried_out(const Profile* profile, const RedrawContext& context,
                                   Plan& plan);
  void redraw_unchanged(const DrawingSource& source, Generalised& generalised, Drawn& drawn) const;
  void keep_fineness(const Profile* profile, const RedrawContext& context, const SeriesLevel& level,
                     Drawn& drawn) const;
  void leave(Drawn& drawn) const;
  [[nodiscard]] SeriesLevel untouched(Drawn& drawn) const;
  [[nodiscard]] std::string target_text(const Profile* profile) const;

  const Targets& targets_;
  const GeneraliseOptions& asked_;
  bool is_given_up_ = false;
};

/// False if there is an error: the building is rejected.
bool keep(const std::vector<Issue>& issues, Drawn& drawn) {
  drawn.issues.insert(drawn.issues.end(), issues.begin(), issues.end());
  return !has_errors(issues);
}

void TargetDrawer::draw_levels(Drawn& drawn) {
  const PipelineResult& result = *drawn.source->result;
  WaitedForJudge judge(*this, *check_, *result.solid, drawn.source->is_parted, drawn.source->work);
  RedrawContext context = context_of(drawn, &judge);
  const std::size_t count = targets_.has_lods() ? targets_.profiles.size() : 1;
  for (std::size_t i = 0; i < count && !is_given_up(Stage::generalise); ++i) {
    const Profile* profile = i < targets_.profiles.size() ? &targets_.profiles[i] : nullptr;
    if (draw_for(profile, context, drawn)) continue;
    drawn.levels.clear();
    return;
  }
}

void TargetDrawer::check(Drawn& drawn) {
  for (const SeriesLevel& level : drawn.levels) {
    const auto& solid = level.redrawn.labelled.geometry;
    if (!solid) continue;
    if (is_given_up(Stage::write)) return;
    if (auto found = fault_of(*drawn.source, *solid)) drawn.fault = std::move(found);
  }
}

/// False if the building is rejected.
bool TargetDrawer::draw_for(const Profile* profile, RedrawContext& context, Drawn& drawn) {
  const PipelineResult& result = *drawn.source->result;
  Plan plan = plan_for(profile, drawn);
  context.invariants = with_party_walls(invariants_of(profile, rules_, targets_.scale), document_,
                                        building_, result);
  auto made = carried_out(profile, context, plan);
  if (!keep(made.issues, drawn) || !made.value || is_given_up(Stage::generalise)) return false;
  // Levels of detail are drawn in any case, and judged as they are drawn.
  if (!targets_.has_lods()) redraw_unchanged(*drawn.source, *made.value, drawn);
  TargetReport& report = drawn.reports.emplace_back();
  report.target = target_text(profile);
  if (asked_.reports_changes)
    report.changes = feature_outcomes(plan, *made.value, context.table, context.interpretation);
  SeriesLevel level;
  level.generalised = *made.value;
  if (targets_.has_lods()) {
    PlanLimits limits;
    if (profile->footprint_edge_m > 0)
      limits = plan_limits(document_, building_, result, options_.neighbours.get());
    // What is left of the drawing's work may be nothing; blocks have as much for themselves.
    Work drawing(context.work->budget());
    auto redrawn = to_lod(context, *profile, std::move(*made.value), drawing,
                          std::move(limits.may_cover), std::move(limits.is_shared));
    if (!keep(redrawn.issues, drawn)) return false;
    level.redrawn = std::move(*redrawn.value);
  } else {
    level.redrawn = redraw(context, std::move(*made.value));
  }
  keep_fineness(profile, context, level, drawn);
  finish(*drawn.source, level.redrawn.labelled);
  drawn.levels.push_back(std::move(level));
  return true;
}

Plan TargetDrawer::plan_for(const Profile* profile, Drawn& drawn) const {
  Plan asked = plan_at(rules_, profile, *drawn.source->result, targets_.scale);
  keep(asked.issues, drawn);
  return asked;
}

/// With what has too fine edges taken off, if the profile asks for that; its steps are added to the
/// plan.
Checked<Generalised> TargetDrawer::carried_out(const Profile* profile, const RedrawContext& context,
                                               Plan& plan) {
  Checked<Generalised> made;
  const bool takes_owners =
      profile != nullptr && profile->edge_min_m.has_value() && profile->edge_owner_b_m.has_value();
  do {
    if (is_given_up(Stage::generalise)) return {};
    made = generalise(context, plan);
  } while (takes_owners && made.value && !context.has_no_work_left() &&
           add_fine_owners(context, *made.value, *profile->edge_min_m, *profile->edge_owner_b_m,
                           profile->title() + "/edge-min", plan));
  return made;
}

/// What nothing was done to stays unchanged, unless it came as no valid solid and its solid is
/// valid: then that is drawn.
void TargetDrawer::redraw_unchanged(const DrawingSource& source, Generalised& generalised,
                                    Drawn& drawn) const {
  if (!generalised.removed.empty() || !generalised.changed.empty()) return;
  const auto& findings = check_->findings_as_read();
  if (findings.empty()) return;
  if (!source.is_parted && !check_->findings(*source.result->solid).empty()) {
    drawn.fault = invalid_before(
        building_, fmt::format("{} {}", to_string(findings[0].code), findings[0].sentence));
    return;
  }
  generalised.is_drawn_anew = true;
  drawn.issues.push_back(building_issue(
      Severity::note, Code::G419, building_.id,
      fmt::format("was not valid in the input ({}) and is redrawn", to_string(findings[0].code))));
}

void TargetDrawer::keep_fineness(const Profile* profile, const RedrawContext& context,
                                 const SeriesLevel& level, Drawn& drawn) const {
  const double least_m = least_edge_m(profile, targets_.scale);
  const auto& geometry = level.redrawn.labelled.geometry;
  Fineness asked{least_m, profile != nullptr && profile->edge_min_m.has_value()};
  if (profile != nullptr && profile->form != Profile::Form::as_is && profile->footprint_edge_m == 0)
    asked.why_not_tried = "blocks keep the footprint and the heights of the roof";
  keep(fineness_issues(context, geometry ? *geometry : context.solid, level.generalised, asked),
       drawn);
  // They are measured when it is known what is written.
  if (!asked_.reports_figures) return;
  TargetFigures& figures = drawn.reports.back().figures.emplace();
  figures.least_edge_m = least_m;
  figures.map_scale = targets_.scale.value_or(0);
}

/// What is valid in no way stays unchanged at a scale; levels of detail, and what was not valid
/// when it was read, are rejected.
void TargetDrawer::leave(Drawn& drawn) const {
  Issue fault = std::move(*drawn.fault);
  drawn.levels.clear();
  if (targets_.has_lods() || fault.code == Code::G413) {
    fault.severity = Severity::error;
    drawn.issues.push_back(std::move(fault));
    return;
  }
  fault.severity = Severity::warning;
  fault.sentence += "; it stays unchanged";
  drawn.issues.push_back(std::move(fault));
  drawn.fault.reset();
  SeriesLevel level = untouched(drawn);
  if (drawn.fault) drawn.issues.push_back(std::move(*drawn.fault));
  drawn.levels.push_back(std::move(level));
}

/// The building without any operation.
SeriesLevel TargetDrawer::untouched(Drawn& drawn) const {
  const PipelineResult& result = *drawn.source->result;
  drawn.undrawn.clear();
  RedrawContext context = context_of(drawn, nullptr);
  SeriesLevel level;
  level.generalised = Generalised{*result.solid, {}};
  level.generalised.closing = closing_faces(*result.solid);
  redraw_unchanged(*drawn.source, level.generalised, drawn);
  level.redrawn = {context.labelled, {}, {}};
  if (!level.generalised.is_drawn_anew) return level;
  FaultyImprints faulty;
  do {
    context.undrawn = faulty.ids();
    level.redrawn = redraw(context, level.generalised);
    finish(*drawn.source, level.redrawn.labelled);
  } while (faulty.add(*check_, *result.segmentation, *level.redrawn.labelled.geometry));
  keep(faulty.issues(result.description.table), drawn);
  return level;
}

std::string TargetDrawer::target_text(const Profile* profile) const {
  return targets_.has_lods() ? "LoD " + profile->level : targets_.text();
}

/// Measures what is written for each target.
void measure_figures(const Document& document, const Building& building,
                     const PipelineResult& result, const RuleBase& rules,
                     const GeneraliseOptions& options, GeneralisedBuilding& drawn) {
  const PipelineResult& from = drawn.repaired ? *drawn.repaired : result;
  const std::size_t count = std::min(drawn.levels.size(), drawn.reports.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (!drawn.reports[i].figures) continue;
    TargetFigures& figures = *drawn.reports[i].figures;
    const double least_m = figures.least_edge_m;
    const LabelledBuilding& written = drawn.levels[i].labelled;
    figures.before = figures.after = figures_of(*from.solid, least_m);
    figures.quality_before = quality_before(building, from, rules, options, least_m);
    if (!written.geometry) {
      figures.quality_after = figures.quality_before;
      for (const auto& [label, number] : count_labels(from.interpretation))
        if (!label.empty()) figures.found_again[label] = {number, number};
      continue;
    }
    figures.after = figures_of(*written.geometry, least_m);
    figures.hausdorff_m = hausdorff_m(*from.solid, *written.geometry);
    figures.quality_after =
        quality_after(document, building, written, rules, options, least_m, figures.found_again);
  }
  // Of what was given up at all targets nothing is written.
  for (std::size_t i = count; i < drawn.reports.size(); ++i) drawn.reports[i].figures.reset();
}

bool has_installation(const Redrawn& level, const std::string& id) {
  const auto& list = level.labelled.installations;
  return std::ranges::find(list, id, &Installation::id) != list.end();
}

}  // namespace

std::string Targets::recipe() const {
  std::string text = fmt::format("scale={}", scale.value_or(0));
  for (const Profile& profile : profiles)
    text += fmt::format(" {}={} edge={}", profile.level, profile.sha256,
                        profile.edge_min_m.value_or(0));
  return text;
}

std::string Targets::text() const {
  if (scale) return fmt::format("1:{}", *scale);
  std::string text;
  for (const Profile& profile : profiles) text += (text.empty() ? "LoD " : ", ") + profile.level;
  return text;
}

Targets at_scale(double denominator) { return {denominator, {}}; }

namespace {

/// Nothing for a building that is in no group.
std::optional<GeneralisedBuilding> as_part_of_group(const Building& building,
                                                    const PipelineResult& result,
                                                    const RuleBase& rules,
                                                    const GeneraliseOptions& options) {
  const CityGroups& groups = *options.groups;
  const auto place = groups.place_of(*result.surroundings);
  if (!place) return std::nullopt;
  GeneralisedBuilding out;
  out.building = building.id;
  out.issues = groups.issues_of(*result.surroundings);
  out.leads_group = place->leads;
  out.is_gone = !place->leads;
  if (place->leads)
    out.levels.push_back(drawn_group(annotate(building, result, rules, options),
                                     groups.solid(place->group), groups.members(place->group)));
  return out;
}

/// Of a building that stands for others of its row.
void add_stood_for(const std::vector<std::string>& ids, GeneralisedBuilding& made) {
  if (ids.empty() || made.levels.empty()) return;
  made.levels[0].labelled.attributes.emplace_back("oriel_members",
                                                  fmt::format("{}", fmt::join(ids, ";")));
}

}  // namespace

GeneralisedBuilding generalise(const Document& document, const Building& building,
                               const PipelineResult& result, const RuleBase& rules,
                               const Targets& targets, const GeneraliseOptions& options) {
  if (options.groups && result.surroundings)
    if (auto grouped = as_part_of_group(building, result, rules, options)) return *grouped;
  if (!building.installations.empty()) {
    const Building alone = without_installations(building);
    return generalise(document, alone, label(alone, rules, options), rules, targets, options);
  }
  if (!result.is_done()) {
    GeneralisedBuilding none;
    none.building = building.id;
    return none;
  }
  return logged(
      "generalised", building,
      [&] {
        GeneralisedBuilding made =
            TargetDrawer(document, building, rules, targets, options).drawing(result);
        if (made.is_given_up) return made;
        if (options.reports_figures)
          measure_figures(document, building, result, rules, options, made);
        if (options.groups && result.surroundings) {
          const auto more = options.groups->issues_of(*result.surroundings);
          made.issues.insert(made.issues.end(), more.begin(), more.end());
          add_stood_for(options.groups->stood_for(*result.surroundings), made);
        }
        const bool is_redrawn = std::ranges::any_of(
            made.levels, [](const Redrawn& level) { return level.labelled.geometry.has_value(); });
        std::ranges::move(invalid_rest(document, building, is_redrawn),
                          std::back_inserter(made.issues));
        return made;
      },
      [](const GeneralisedBuilding& made) {
        return fmt::format("targets={} issues={} repaired={}", made.levels.size(),
                           made.issues.size(), made.repaired != nullptr);
      });
}

void add(GeneralisedBuilding building, OutputRecord& output) {
  if (building.is_gone) output.options.gone.push_back(building.building);
  if (building.leads_group) output.options.bared.push_back(building.building);
  for (std::size_t i = 0; i < building.levels.size(); ++i) {
    Redrawn& level = building.levels[i];
    for (const std::string& id : level.removed_ids)
      if (std::ranges::none_of(building.levels,
                               [&](const Redrawn& other) { return has_installation(other, id); }))
        output.options.removed.push_back(id);
    if (i > 0) level.labelled.attributes.clear();
  }
  for (Redrawn& level : building.levels) output.buildings.push_back(std::move(level.labelled));
}

std::vector<Issue> overlaps_as_written(const Document& document, const OutputRecord& output) {
  std::map<std::size_t, std::vector<const Building*>> families;
  for (std::size_t i = 0; i < document.families.size() && document.buildings.size() > 1; ++i)
    if (document.families[i] != kNoFamily)
      families[document.families[i]].push_back(&document.buildings[i]);
  std::erase_if(families, [](const auto& family) { return family.second.size() < 2; });
  if (families.empty()) return {};
  std::multimap<std::string_view, const LabelledBuilding*> redrawn;
  for (const LabelledBuilding& one : output.buildings)
    if (one.geometry) redrawn.emplace(one.building, &one);
  std::set<std::string_view> left(output.options.gone.begin(), output.options.gone.end());
  left.insert(output.options.emptied.begin(), output.options.emptied.end());
  std::vector<Issue> issues;
  for (const auto& [_, members] : families) {
    std::map<std::string, std::vector<Building>> levels;
    for (const Building* member : members) {
      if (left.contains(member->id)) continue;
      const auto [first, end] = redrawn.equal_range(member->id);
      for (auto at = first; at != end; ++at)
        levels[at->second->lod.empty() ? member->lod : at->second->lod].push_back(
            as_written(document, *member, *at->second->geometry));
      if (first == end && member->is_solid && validate(*member).empty())
        levels[member->lod].push_back(without_installations(*member));
    }
    for (const auto& [lod, parts] : levels) {
      std::vector<const Building*> pointers;
      for (const Building& part : parts) pointers.push_back(&part);
      for (const auto& [part, finding] : overlapping_parts(pointers))
        issues.push_back(building_issue(Severity::error, finding.code, parts[part].id,
                                        fmt::format("{} as it is written at lod {} (val3dity {})",
                                                    finding.sentence, lod, finding.val3dity)));
    }
  }
  return issues;
}

}  // namespace oriel
