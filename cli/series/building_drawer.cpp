#include "cli/series/building_drawer.h"

#include "cli/pipeline/mended_line.h"
#include "cli/pipeline/written_proof.h"
#include "generalise/invariants/fineness.h"
#include "generalise/to_lod.h"
#include "interpret/plan/plan.h"
#include "kernel/mesh/hausdorff.h"
#include "kernel/validate/validate.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// False if there is an error: the building is set aside.
bool keep(const std::vector<Issue>& issues, Product& told) {
  told.issues.insert(told.issues.end(), issues.begin(), issues.end());
  return !has_errors(issues);
}

/// What nothing was done to stays as it came, unless it came as no valid solid and its solid is
/// valid: then that is drawn.
void mend_unchanged(const Document& document, const Building& building, const OnLine& line,
                    Generalised& generalised, Product& told) {
  if (!generalised.removed.empty() || !generalised.changed.empty()) return;
  const auto findings = validate(building);
  if (findings.empty()) return;
  if (prove_written(document, building, *line.solid).fault) {
    if (building.is_solid)
      told.issues.push_back(excuse_of(
          building, fmt::format("{} {}", to_string(findings[0].code), findings[0].sentence)));
    return;
  }
  generalised.is_drawn_anew = true;
  told.issues.push_back(
      building_issue(Severity::note, Code::G419, building.id,
                     fmt::format("was not valid as it was read ({}) and is drawn anew",
                                 to_string(findings[0].code))));
}

/// A mended solid of more facets is drawn without its steps being judged: with all that lies within
/// millimetres of each other in it, that takes minutes and helps little.
constexpr std::size_t kIntricateFacets = 1000;

/// Of each target how fine the file has to be; what is valid at no scale is the fault.
std::optional<Issue> prove(const Document& document, const OnLine& line, DrawnBuilding& drawn) {
  std::optional<Issue> fault;
  for (Redrawn& redrawn : drawn.all) {
    if (!redrawn.labelled.geometry) continue;
    WrittenProof proof = prove_redrawn(document, document.buildings[drawn.building], *line.solid,
                                       *redrawn.labelled.geometry);
    redrawn.labelled.digits = proof.digits;
    if (proof.fault) fault = std::move(proof.fault);
    if (proof.excuse) drawn.told.issues.push_back(std::move(*proof.excuse));
  }
  return fault;
}

bool tells(const Product& told, Code code) {
  return std::ranges::find(told.issues, code, &Issue::code) != told.issues.end();
}

}  // namespace

bool DrawnBuilding::is_excused() const { return tells(told, Code::G413); }

bool DrawnBuilding::is_given_up() const { return tells(told, Code::G410); }

DrawnBuilding BuildingDrawer::draw(const Document& document, std::size_t building,
                                   const OnLine& line, Judging judging) const {
  DrawnBuilding drawn{building, {}, {}};
  const Building& its = document.buildings[building];
  const LabelledBuilding labelled = outputs_.annotated(its, line);
  const std::size_t count = targets_.has_lods() ? targets_.profiles.size() : 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Profile* profile = i < targets_.profiles.size() ? &targets_.profiles[i] : nullptr;
    auto redrawn = draw_for(profile, {document, its, line, labelled}, judging, drawn.told);
    if (!redrawn) {
      drawn.all.clear();
      break;
    }
    drawn.all.push_back(std::move(*redrawn));
  }
  return drawn;
}

void BuildingDrawer::keep_valid(const Document& document, const OnLine& line,
                                DrawnBuilding& drawn) const {
  std::optional<Issue> fault = prove(document, line, drawn);
  if (!fault) return;
  DrawnBuilding again = draw(document, drawn.building, line, Judging::thorough);
  if (!again.all.empty() && !prove(document, line, again)) {
    drawn = std::move(again);
    return;
  }
  give_up(document, line, std::move(*fault), drawn);
}

void BuildingDrawer::give_up(const Document& document, const OnLine& line, Issue fault,
                             DrawnBuilding& drawn) const {
  drawn.all.clear();
  if (targets_.has_lods()) {
    drawn.told.issues.push_back(fault);
    return;
  }
  fault.severity = Severity::warning;
  fault.sentence += "; it stays as it came";
  drawn.told.issues.push_back(fault);
  drawn.all.push_back(untouched(document, document.buildings[drawn.building], line, drawn.told));
}

std::optional<OnLine> BuildingDrawer::mend(const Document& document, const OnLine& line,
                                           DrawnBuilding& drawn, Timings& timings) const {
  auto mended =
      mended_line(arguments_, &rules_, document, document.buildings[drawn.building], line, timings);
  if (!mended) return mended;
  const bool is_intricate = mended->solid->facets.size() > kIntricateFacets;
  DrawnBuilding again = timings.measure(Stage::generalise, [&] {
    return draw(document, drawn.building, *mended, is_intricate ? Judging::none : Judging::refused);
  });
  timings.measure(Stage::write, [&] {
    for (Redrawn& redrawn : again.all)
      part_written(document, document.buildings[drawn.building], redrawn.labelled);
    if (!is_intricate) return keep_valid(document, *mended, again);
    if (auto fault = prove(document, *mended, again))
      give_up(document, *mended, std::move(*fault), again);
  });
  if (drawn.is_given_up() && again.is_given_up()) return std::nullopt;
  drawn = std::move(again);
  drawn.told.issues.insert(drawn.told.issues.begin(), mended->issues.back());
  return mended;
}

/// The building without any operation.
Redrawn BuildingDrawer::untouched(const Document& document, const Building& building,
                                  const OnLine& line, Product& told) const {
  LabelledBuilding labelled = outputs_.annotated(building, line);
  Generalised whole{*line.solid, {}};
  mend_unchanged(document, building, line, whole, told);
  if (!whole.is_drawn_anew) return {std::move(labelled), {}, {}};
  Redrawn redrawn = redraw(building, labelled, *line.segmentation, line.description.table,
                           line.interpretation, std::move(whole), line.tolerances);
  redrawn.labelled.digits = prove_written(document, building, *redrawn.labelled.geometry).digits;
  return redrawn;
}

std::optional<Redrawn> BuildingDrawer::draw_for(const Profile* profile, const Subject& of,
                                                Judging judging, Product& told) const {
  const OnLine& line = of.line;
  const FeatureTable& table = line.description.table;
  Plan plan = plan_for(profile, line, told);
  auto made = carried_out(profile, line, invariants_for(profile, of, judging), plan);
  if (!keep(made.issues, told) || !made.value) return std::nullopt;
  // Levels of detail are drawn in any case, and judged as they are drawn.
  if (!targets_.has_lods()) mend_unchanged(of.document, of.building, line, *made.value, told);
  if (accounts_.has_any())
    told[Part::deeds] += accounts_.text(of.building.id, target_text(profile),
                                        account(plan, *made.value, table, line.interpretation));
  // What is kept of it is not known any more once it is redrawn.
  const Generalised changes{{},    made.value->removed, made.value->refused,
                            false, made.value->changed, made.value->uncleared};
  std::optional<Redrawn> redrawn;
  if (targets_.has_lods()) {
    auto level = to_lod(of.building, of.labelled, *line.segmentation, table, line.interpretation,
                        *profile, std::move(*made.value), line.tolerances);
    if (!keep(level.issues, told)) return std::nullopt;
    redrawn = std::move(level.value);
  } else {
    redrawn = redraw(of.building, of.labelled, *line.segmentation, table, line.interpretation,
                     std::move(*made.value), line.tolerances);
  }
  keep_figures(profile, of, changes, *redrawn, told);
  return redrawn;
}

Plan BuildingDrawer::plan_for(const Profile* profile, const OnLine& line, Product& told) const {
  const auto& [table, graph] = line.description;
  Plan asked;
  if (targets_.scale) asked = plan(rules_, table, graph, line.interpretation, *targets_.scale);
  if (profile != nullptr)
    asked = plan_by_profile(std::move(asked), *profile, rules_, *line.segmentation, table,
                            line.interpretation, targets_.scale);
  keep(asked.issues, told);
  return asked;
}

Invariants BuildingDrawer::invariants_for(const Profile* profile, const Subject& of,
                                          Judging judging) const {
  Invariants invariants = beside_others(invariants_of(profile, rules_, targets_.scale), of.document,
                                        of.building, *of.line.solid);
  if (judging != Judging::none)
    invariants.validator =
        judge_as_written(of.document, of.building, *of.line.solid, judging == Judging::thorough);
  return invariants;
}

/// With what has too fine edges taken off, if the profile asks for that; its steps are added to the
/// plan.
Checked<Generalised> BuildingDrawer::carried_out(const Profile* profile, const OnLine& line,
                                                 const Invariants& invariants, Plan& plan) const {
  const FeatureTable& table = line.description.table;
  const auto carry_out = [&] {
    return generalise(*line.solid, *line.segmentation, table, line.interpretation, plan,
                      arguments_.segment_options(line.tolerances), invariants);
  };
  auto made = carry_out();
  if (profile == nullptr || !profile->edge_min_m || !profile->edge_owner_b_m) return made;
  while (made.value &&
         add_fine_owners(*made.value, *line.segmentation, table, *profile->edge_min_m,
                         *profile->edge_owner_b_m, profile->title() + "/edge-min", plan))
    made = carry_out();
  return made;
}

void BuildingDrawer::keep_figures(const Profile* profile, const Subject& of,
                                  const Generalised& changes, const Redrawn& redrawn,
                                  Product& told) const {
  const double least_m = least_edge_m(profile, targets_.scale);
  const Solid& before = *of.line.solid;
  const Solid& after = redrawn.labelled.geometry ? *redrawn.labelled.geometry : before;
  Fineness asked{least_m, profile != nullptr && profile->edge_min_m.has_value()};
  if (profile != nullptr && profile->form != Profile::Form::as_is)
    asked.why_not_tried = "blocks keep the footprint and the heights of the roof";
  keep(fineness_issues(of.building, before, after, *of.line.segmentation, of.line.description.table,
                       changes, asked),
       told);
  if (!accounts_.has_metrics()) return;
  told[Part::figures] +=
      accounts_.text(of.building.id, target_text(profile), least_m, figures_of(before, least_m),
                     figures_of(after, least_m), hausdorff_m(before, after));
}

std::string BuildingDrawer::target_text(const Profile* profile) const {
  return targets_.has_lods() ? "LoD " + profile->level : targets_.text();
}

}  // namespace oriel::cli
