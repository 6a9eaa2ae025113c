#include "oriel/generalise.h"

#include "generalise/invariants/fineness.h"
#include "generalise/to_lod.h"
#include "interpret/plan/plan.h"
#include "io/levels/written_grid.h"
#include "kernel/mesh/measures.h"
#include "kernel/validate/validate.h"
#include "oriel/pipeline/drawing_quality.h"
#include "oriel/pipeline/faulty_imprints.h"
#include "oriel/pipeline/output_check.h"
#include "oriel/pipeline/pipeline.h"
#include "oriel/pipeline/repair_and_retry.h"
#include "oriel/pipeline/targets.h"

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

/// False if there is an error: the building is rejected.
bool keep(const std::vector<Issue>& issues, GeneralisedBuilding& out) {
  out.issues.insert(out.issues.end(), issues.begin(), issues.end());
  return !has_errors(issues);
}

/// It could not be drawn as a valid solid of its own.
bool is_invalid(const GeneralisedBuilding& drawn) {
  return std::ranges::any_of(drawn.issues, [](const Issue& issue) {
    return issue.place.feature.empty() && (issue.code == Code::G413 || issue.code == Code::G410);
  });
}

/// How what is cut is judged on the way, by how it would be written.
enum class Judging {
  none,      ///< not at all: it would take too long
  refused,   ///< where features do not come off, what is left instead
  thorough,  ///< every step (SolidValidator::is_thorough)
};

/// Draws one building for its targets, so that it is valid as it is written. Refers to all that it
/// is made of.
class BuildingDrawer {
 public:
  BuildingDrawer(const Document& document, const Building& building, const RuleBase& rules,
                 const Targets& targets, const GeneraliseOptions& options, Work& work)
      : document_(document),
        building_(building),
        rules_(rules),
        targets_(targets),
        options_(options),
        work_(work) {}

  /// `result` has a solid that is closed.
  [[nodiscard]] GeneralisedBuilding draw(const PipelineResult& result,
                                         Judging judging = Judging::refused,
                                         const std::vector<FeatureId>& undrawn = {}) const;

  /// What is not valid as it is written is drawn again with each step judged; if that is not valid
  /// either it stays unchanged, levels of detail are rejected (G410).
  void keep_valid(const PipelineResult& result, GeneralisedBuilding& drawn) const;

  /// Draws a building that is not valid, or was given up, from its repair_and_retry(), with as much
  /// work again, which becomes drawn.repaired; nothing is done if there is none, or if what was
  /// given up is so again.
  void repair(const PipelineResult& result, GeneralisedBuilding& drawn) const;

  /// Draws what was given up once more, without the imprints that are in the way of a valid solid,
  /// if it is valid then.
  void draw_without_imprints(const PipelineResult& result, GeneralisedBuilding& drawn) const;

  [[nodiscard]] std::optional<PipelineResult> repaired_open(const PipelineResult& result) const {
    return repair_open(document_, building_, result, rules_, options_, work_);
  }

  /// What comes of a building that stays open.
  [[nodiscard]] GeneralisedBuilding open() const {
    GeneralisedBuilding drawn;
    drawn.building = building_.id;
    drawn.issues.push_back(stays_open(building_));
    flag_unfinished(drawn);
    return drawn;
  }

  /// Says so if the work is used up: not all was tried.
  void flag_unfinished(GeneralisedBuilding& drawn) const {
    if (work_.is_used_up()) drawn.issues.push_back(not_all_drawn(building_, work_));
  }

 private:
  struct LabelledResult {
    const PipelineResult& result;
    const LabelledBuilding& labelled;
    const std::vector<FeatureId>& undrawn;  ///< Generalised::undrawn
  };

  [[nodiscard]] std::optional<Redrawn> draw_for(const Profile* profile, const LabelledResult& of,
                                                Judging judging, GeneralisedBuilding& out) const;
  [[nodiscard]] Plan plan_for(const Profile* profile, const PipelineResult& result,
                              GeneralisedBuilding& out) const;
  [[nodiscard]] Invariants invariants_for(const Profile* profile, const PipelineResult& result,
                                          Judging judging) const;
  [[nodiscard]] Checked<Generalised> carried_out(const Profile* profile,
                                                 const PipelineResult& result,
                                                 const Invariants& invariants, Plan& plan) const;
  [[nodiscard]] std::optional<Issue> check(const PipelineResult& result,
                                           GeneralisedBuilding& drawn) const;
  void redraw_unchanged(const PipelineResult& result, Generalised& generalised,
                        GeneralisedBuilding& out) const;
  void keep_fineness(const Profile* profile, const PipelineResult& result,
                     const Generalised& changes, const Redrawn& redrawn,
                     GeneralisedBuilding& out) const;
  /// Once that is so there is no work left either.
  bool is_given_up(Stage stage) const {
    const bool is_it = options_.is_given_up && options_.is_given_up(stage);
    if (is_it) work_ = Work(-1);
    return is_it;
  }
  [[nodiscard]] SolidValidator asking(SolidValidator validator) const;
  void give_up(const PipelineResult& result, Issue fault, GeneralisedBuilding& drawn) const;
  [[nodiscard]] Redrawn untouched(const PipelineResult& result, GeneralisedBuilding& out) const;
  [[nodiscard]] std::string target_text(const Profile* profile) const;

  const Document& document_;
  const Building& building_;
  const RuleBase& rules_;
  const Targets& targets_;
  const GeneraliseOptions& options_;
  Work& work_;  ///< of all targets and all ways that are tried with one solid
};

GeneralisedBuilding BuildingDrawer::draw(const PipelineResult& result, Judging judging,
                                         const std::vector<FeatureId>& undrawn) const {
  GeneralisedBuilding drawn;
  drawn.building = building_.id;
  const LabelledBuilding labelled = annotate(building_, result, rules_, options_);
  const std::size_t count = targets_.has_lods() ? targets_.profiles.size() : 1;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_given_up(Stage::generalise)) break;
    const Profile* profile = i < targets_.profiles.size() ? &targets_.profiles[i] : nullptr;
    auto redrawn = draw_for(profile, {result, labelled, undrawn}, judging, drawn);
    if (!redrawn) {
      drawn.levels.clear();
      break;
    }
    drawn.levels.push_back(std::move(*redrawn));
  }
  return drawn;
}

void BuildingDrawer::keep_valid(const PipelineResult& result, GeneralisedBuilding& drawn) const {
  std::optional<Issue> fault = check(result, drawn);
  if (!fault) return;
  if (work_.is_used_up()) return give_up(result, std::move(*fault), drawn);
  // Where not even the solid itself is valid no step can be told to spoil it.
  if (fault->code != Code::G413) {
    GeneralisedBuilding again = draw(result, Judging::thorough);
    if (!again.levels.empty() && !check(result, again)) {
      drawn = std::move(again);
      return;
    }
  }
  give_up(result, std::move(*fault), drawn);
}

void BuildingDrawer::draw_without_imprints(const PipelineResult& result,
                                           GeneralisedBuilding& drawn) const {
  FaultyImprints faulty;
  while (!work_.is_used_up()) {
    GeneralisedBuilding again = draw(result, Judging::refused, faulty.ids());
    if (again.levels.empty()) return;
    if (!check(result, again)) {
      keep(faulty.issues(result.description.table), again);
      drawn = std::move(again);
      return;
    }
    bool has_more = false;
    for (const Redrawn& level : again.levels)
      if (const auto& solid = level.labelled.geometry)
        has_more |= faulty.add(document_, building_, *result.segmentation, *solid);
    if (!has_more) return;
  }
}

void BuildingDrawer::repair(const PipelineResult& result, GeneralisedBuilding& drawn) const {
  Work work(options_.budget);
  if (is_given_up(Stage::solidify)) return;
  auto repaired = repair_and_retry(document_, building_, result, rules_, options_, work);
  if (!repaired) return;
  const BuildingDrawer anew(document_, building_, rules_, targets_, options_, work);
  const bool is_intricate = oriel::is_intricate(*repaired);
  GeneralisedBuilding again = measure(options_.observer, Stage::generalise, [&] {
    return anew.draw(*repaired, is_intricate ? Judging::none : Judging::refused);
  });
  measure(options_.observer, Stage::write, [&] {
    for (Redrawn& redrawn : again.levels) part_written(document_, building_, redrawn.labelled);
    if (!is_intricate) return anew.keep_valid(*repaired, again);
    if (auto fault = check(*repaired, again)) give_up(*repaired, std::move(*fault), again);
  });
  anew.flag_unfinished(again);
  if (is_invalid(drawn) && is_invalid(again)) return;
  drawn = std::move(again);
  drawn.issues.insert(drawn.issues.begin(), repaired->issues.back());
  drawn.repaired = std::move(repaired);
}

/// What is not valid as it is written is the fault.
std::optional<Issue> BuildingDrawer::check(const PipelineResult& result,
                                           GeneralisedBuilding& drawn) const {
  std::optional<Issue> fault;
  for (Redrawn& redrawn : drawn.levels) {
    if (!redrawn.labelled.geometry) continue;
    if (is_given_up(Stage::write)) return std::nullopt;
    if (auto found = check_redrawn(document_, building_, *result.solid, *redrawn.labelled.geometry))
      fault = std::move(found);
  }
  return fault;
}

void BuildingDrawer::give_up(const PipelineResult& result, Issue fault,
                             GeneralisedBuilding& drawn) const {
  drawn.levels.clear();
  std::erase_if(drawn.issues, [](const Issue& issue) { return issue.code == Code::G413; });
  if (targets_.has_lods() || fault.code == Code::G413) {
    fault.severity = Severity::error;
    drawn.issues.push_back(fault);
    return;
  }
  fault.severity = Severity::warning;
  fault.sentence += "; it stays unchanged";
  drawn.issues.push_back(fault);
  drawn.levels.push_back(untouched(result, drawn));
}

/// What nothing was done to stays unchanged, unless it came as no valid solid and its solid is
/// valid: then that is drawn.
void BuildingDrawer::redraw_unchanged(const PipelineResult& result, Generalised& generalised,
                                      GeneralisedBuilding& out) const {
  if (!generalised.removed.empty() || !generalised.changed.empty()) return;
  const auto findings = validate(building_);
  if (findings.empty()) return;
  if (check_output(document_, building_, *result.solid)) {
    out.issues.push_back(invalid_before(
        building_, fmt::format("{} {}", to_string(findings[0].code), findings[0].sentence)));
    return;
  }
  generalised.is_drawn_anew = true;
  out.issues.push_back(building_issue(
      Severity::note, Code::G419, building_.id,
      fmt::format("was not valid in the input ({}) and is redrawn", to_string(findings[0].code))));
}

/// The building without any operation.
Redrawn BuildingDrawer::untouched(const PipelineResult& result, GeneralisedBuilding& out) const {
  LabelledBuilding labelled = annotate(building_, result, rules_, options_);
  Generalised whole{*result.solid, {}};
  whole.closing = closing_faces(whole.solid);
  redraw_unchanged(result, whole, out);
  if (!whole.is_drawn_anew) return {std::move(labelled), {}, {}};
  FaultyImprints faulty;
  while (true) {
    Redrawn redrawn = redraw(building_, labelled, *result.segmentation, result.description.table,
                             result.interpretation, whole, result.tolerances);
    if (!faulty.add(document_, building_, *result.segmentation, *redrawn.labelled.geometry)) {
      keep(faulty.issues(result.description.table), out);
      return redrawn;
    }
    whole.undrawn = faulty.ids();
  }
}

std::optional<Redrawn> BuildingDrawer::draw_for(const Profile* profile, const LabelledResult& of,
                                                Judging judging, GeneralisedBuilding& out) const {
  const PipelineResult& result = of.result;
  const FeatureTable& table = result.description.table;
  Plan plan = plan_for(profile, result, out);
  auto made = carried_out(profile, result, invariants_for(profile, result, judging), plan);
  if (!keep(made.issues, out) || !made.value || is_given_up(Stage::generalise)) return std::nullopt;
  made.value->undrawn = of.undrawn;
  // Levels of detail are drawn in any case, and judged as they are drawn.
  if (!targets_.has_lods()) redraw_unchanged(result, *made.value, out);
  TargetReport& report = out.reports.emplace_back();
  report.target = target_text(profile);
  if (options_.reports_changes)
    report.changes = feature_outcomes(plan, *made.value, table, result.interpretation);
  // What is kept of it is not known any more once it is redrawn.
  const Generalised changes{{},    made.value->removed, made.value->refused,
                            false, made.value->changed, made.value->uncleared};
  std::optional<Redrawn> redrawn;
  if (targets_.has_lods()) {
    PlanLimits limits;
    if (profile->footprint_edge_m > 0)
      limits = plan_limits(document_, building_, result, options_.neighbours.get());
    // What is left of the drawing's work may be nothing; blocks have as much for themselves.
    Work drawing(work_.budget());
    auto level = to_lod(building_, of.labelled, *result.segmentation, table, result.interpretation,
                        *profile, std::move(*made.value), result.tolerances, drawing,
                        std::move(limits.may_cover), std::move(limits.is_shared));
    if (!keep(level.issues, out)) return std::nullopt;
    redrawn = std::move(level.value);
  } else {
    redrawn = redraw(building_, of.labelled, *result.segmentation, table, result.interpretation,
                     std::move(*made.value), result.tolerances);
  }
  keep_fineness(profile, result, changes, *redrawn, out);
  return redrawn;
}

Plan BuildingDrawer::plan_for(const Profile* profile, const PipelineResult& result,
                              GeneralisedBuilding& out) const {
  const auto& [table, graph, issues] = result.description;
  Plan asked;
  if (targets_.scale) asked = plan(rules_, table, graph, result.interpretation, *targets_.scale);
  if (profile != nullptr)
    asked = plan_by_profile(std::move(asked), *profile, rules_, *result.segmentation, table,
                            result.interpretation, targets_.scale);
  keep(asked.issues, out);
  return asked;
}

Invariants BuildingDrawer::invariants_for(const Profile* profile, const PipelineResult& result,
                                          Judging judging) const {
  Invariants invariants = with_party_walls(invariants_of(profile, rules_, targets_.scale),
                                           document_, building_, result);
  invariants.work = &work_;
  if (judging != Judging::none)
    invariants.validator = asking(
        counted(judge_as_written(document_, building_, *result.solid, judging == Judging::thorough),
                work_));
  return invariants;
}

/// Before each of its judgements.
SolidValidator BuildingDrawer::asking(SolidValidator validator) const {
  if (!options_.is_given_up) return validator;
  validator.fitness_of = [this, inner = std::move(validator.fitness_of)](const Solid& solid) {
    return is_given_up(Stage::generalise) ? Fitness::unfit : inner(solid);
  };
  return validator;
}

/// With what has too fine edges taken off, if the profile asks for that; its steps are added to the
/// plan.
Checked<Generalised> BuildingDrawer::carried_out(const Profile* profile,
                                                 const PipelineResult& result,
                                                 const Invariants& invariants, Plan& plan) const {
  const FeatureTable& table = result.description.table;
  const auto carry_out = [&] {
    is_given_up(Stage::generalise);
    return oriel::generalise(*result.solid, *result.segmentation, table, result.interpretation,
                             plan, segment_options(options_, result.tolerances), invariants);
  };
  auto made = carry_out();
  if (profile == nullptr || !profile->edge_min_m || !profile->edge_owner_b_m) return made;
  while (made.value && !work_.is_used_up() &&
         add_fine_owners(*made.value, *result.segmentation, table, *profile->edge_min_m,
                         *profile->edge_owner_b_m, profile->title() + "/edge-min", plan))
    made = carry_out();
  return made;
}

void BuildingDrawer::keep_fineness(const Profile* profile, const PipelineResult& result,
                                   const Generalised& changes, const Redrawn& redrawn,
                                   GeneralisedBuilding& out) const {
  const double least_m = least_edge_m(profile, targets_.scale);
  const Solid& before = *result.solid;
  const Solid& after = redrawn.labelled.geometry ? *redrawn.labelled.geometry : before;
  Fineness asked{least_m, profile != nullptr && profile->edge_min_m.has_value()};
  if (profile != nullptr && profile->form != Profile::Form::as_is && profile->footprint_edge_m == 0)
    asked.why_not_tried = "blocks keep the footprint and the heights of the roof";
  keep(fineness_issues(building_, before, after, *result.segmentation, result.description.table,
                       changes, asked),
       out);
  // They are measured when it is known what is written.
  if (!options_.reports_figures) return;
  TargetFigures& figures = out.reports.back().figures.emplace();
  figures.least_edge_m = least_m;
  figures.map_scale = targets_.scale.value_or(0);
}

std::string BuildingDrawer::target_text(const Profile* profile) const {
  return targets_.has_lods() ? "LoD " + profile->level : targets_.text();
}

bool has_imprints(const Segmentation& segmentation) {
  return std::ranges::find(segmentation.features, Sense::imprint, &Feature::sense) !=
         segmentation.features.end();
}

/// Where the solid that is drawn comes from.
enum class Origin { input, repaired };

/// What is not valid is drawn from a repaired solid, but for one that is repaired already: its
/// features were found in a solid that is valid.
GeneralisedBuilding valid_drawing(const BuildingDrawer& drawer, const PipelineResult& result,
                                  Origin origin, const StageObserver& observer) {
  GeneralisedBuilding drawn =
      measure(observer, Stage::generalise, [&] { return drawer.draw(result); });
  measure(observer, Stage::write, [&] { drawer.keep_valid(result, drawn); });
  drawer.flag_unfinished(drawn);
  if (is_invalid(drawn) && origin == Origin::input) drawer.repair(result, drawn);
  if (is_invalid(drawn) && has_imprints(*result.segmentation))
    measure(observer, Stage::generalise, [&] { drawer.draw_without_imprints(result, drawn); });
  return drawn;
}

/// Of an open building, from what repair_open() makes of it.
GeneralisedBuilding open_drawing(const BuildingDrawer& drawer, const PipelineResult& result,
                                 const StageObserver& observer) {
  auto repaired = drawer.repaired_open(result);
  if (!repaired) return drawer.open();
  GeneralisedBuilding drawn = valid_drawing(drawer, *repaired, Origin::repaired, observer);
  drawn.issues.insert(drawn.issues.begin(), repaired->issues.back());
  if (!drawn.repaired) drawn.repaired = std::move(repaired);
  return drawn;
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
                               const Targets& targets, const GeneraliseOptions& asked) {
  if (asked.groups && result.surroundings)
    if (auto grouped = as_part_of_group(building, result, rules, asked)) return *grouped;
  if (!building.installations.empty()) {
    const Building alone = without_installations(building);
    return generalise(document, alone, label(alone, rules, asked), rules, targets, asked);
  }
  GeneralisedBuilding drawn;
  drawn.building = building.id;
  if (!result.is_done()) return drawn;
  GeneraliseOptions options = asked;
  bool is_given_up = false;
  if (asked.is_given_up)
    options.is_given_up = [&](Stage stage) {
      return is_given_up = is_given_up || asked.is_given_up(stage);
    };
  Work work = drawing_work(options.budget);
  const BuildingDrawer drawer(document, building, rules, targets, options, work);
  return logged(
      "generalised", building,
      [&] {
        GeneralisedBuilding made =
            result.is_open() ? open_drawing(drawer, result, options.observer)
                             : valid_drawing(drawer, result, Origin::input, options.observer);
        drawn.is_given_up = is_given_up;
        if (is_given_up) return drawn;
        if (has_errors(made.issues)) made.levels.clear();
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
                           made.issues.size(), made.repaired.has_value());
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
