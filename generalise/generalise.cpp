#include "generalise/generalise.h"

#include "generalise/invariants/invariants.h"
#include "interpret/score/significance.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

Issue refusal_issue(const CarriedOut::Refused& refusal, const Segmentation& segmentation,
                    const FeatureTable& table, const Interpretation& interpretation,
                    const Plan& plan, const std::string& target) {
  const FeatureId parent = segmentation.features[refusal.feature.index()].parent;
  const std::string& label = interpretation.verdicts[refusal.feature.index()].label;
  if (is_part(refusal, plan, interpretation)) {
    Issue note =
        building_issue(Severity::note, refusal.code, table.building(),
                       fmt::format("is a part of the building and stays at {}: without it {}",
                                   target, reason_of(refusal, table)));
    note.place.feature = table.id(refusal.feature);
    return note;
  }
  const bool is_piece = parent.is_valid() && label.empty();
  Issue issue =
      building_issue(is_piece ? Severity::note : Severity::warning, refusal.code, table.building(),
                     is_piece ? fmt::format("is a piece of {} and stays with it at {}: {}",
                                            table.id(parent), target, reason_of(refusal, table))
                              : fmt::format("is not {} at {}: {}",
                                            refusal.code == Code::G403 ? "changed" : "omitted",
                                            target, reason_of(refusal, table)));
  issue.place.feature = table.id(refusal.feature);
  return issue;
}

Issue unfollowed_issue(const AlongFeature& one, const FeatureTable& table,
                       const std::string& target) {
  Issue note = building_issue(Severity::note, Code::G424, table.building(),
                              fmt::format("goes along with {} at {}, as it cannot follow: {}",
                                          table.id(one.with), target, one.reason));
  note.place.feature = table.id(one.feature);
  return note;
}

bool is_unnamed(FeatureId id, const Interpretation& interpretation) {
  return interpretation.verdicts[id.index()].label.empty();
}

bool is_for_size(const Step& step) {
  return is_verdict_of_size(step.rule.substr(step.rule.find('/') + 1));
}

/// What is taken off for its size only, or has no name, may turn out to be a part of the building.
Pieces pieces_of(const Plan& plan, const FeatureTable& table,
                 const Interpretation& interpretation) {
  Pieces pieces;
  for (const Step& step : plan.steps)
    if (step.operation == "omit" && (is_unnamed(step.feature, interpretation) || is_for_size(step)))
      pieces.may_stay.push_back(step.feature);
  std::ranges::sort(pieces.may_stay);
  for (int i = 0; i < static_cast<int>(table.rows()); ++i)
    pieces.c_m.push_back(table.number(FeatureId{i}, Attribute::c).value_or(Box::kInfinity));
  return pieces;
}

/// What pushed a feature, or the feature.
FeatureId cause_of_push(FeatureId id, const Generalised& generalised) {
  const auto pushed = std::ranges::find(generalised.pushed, id, &PushedFeature::feature);
  return pushed == generalised.pushed.end() ? id : pushed->by;
}

/// What has no step of its own has that of what it made room for, followed, or went along with;
/// `cause` has the step.
void tell_cause(FeatureId cause, FeatureId with, const std::string& what, const Plan& plan,
                const FeatureTable& table, FeatureOutcome& outcome) {
  outcome.reason = what + table.id(with);
  const auto step = std::ranges::find(plan.steps, cause, &Step::feature);
  if (step == plan.steps.end() || !outcome.operation.empty()) return;
  outcome.operation = step->operation;
  outcome.rule = step->rule;
}

void tell_gone(FeatureId id, const Plan& plan, const Generalised& generalised,
               const FeatureTable& table, FeatureOutcome& outcome) {
  const bool is_omitted = outcome.operation == "omit" || outcome.operation == "flatten";
  outcome.outcome = is_omitted ? "omitted" : "went along";
  const auto along = std::ranges::find(generalised.along, id, &AlongFeature::feature);
  if (is_omitted || along == generalised.along.end()) return;
  tell_cause(cause_of_push(along->with, generalised), along->with, "went along with ", plan, table,
             outcome);
  if (along->reason.empty()) return;
  outcome.code = Code::G424;
  outcome.reason += ": " + along->reason;
  for (const FeatureId other : along->beside) outcome.beside.push_back(table.id(other));
}

void tell_changed(FeatureId id, const Plan& plan, const Generalised& generalised,
                  const FeatureTable& table, FeatureOutcome& outcome) {
  outcome.outcome = "changed";
  const auto pushed = std::ranges::find(generalised.pushed, id, &PushedFeature::feature);
  if (pushed != generalised.pushed.end())
    tell_cause(pushed->by, pushed->by, "pushed by ", plan, table, outcome);
  const auto follows = std::ranges::find(generalised.following, id, &FollowingFeature::feature);
  if (follows != generalised.following.end())
    tell_cause(cause_of_push(follows->with, generalised), follows->with,
               follows->belonging == Belonging::grows ? "grew with " : "moved with ", plan, table,
               outcome);
}

/// As many features in the way are named in a sentence.
constexpr std::size_t kMostBeside = 3;

std::string text_of(const Need& need) {
  if (need.what == "count") return fmt::format("{:.0f} fewer in the row", need.less);
  if (need.what == "ratio") return fmt::format("a ratio of {:.2f}", need.then);
  return fmt::format("a {} of {:.3f} m, {:.3f} m less", need.what == "to" ? "size" : need.what,
                     need.then, need.less);
}

}  // namespace

bool is_part(const CarriedOut::Refused& refused, const Plan& plan,
             const Interpretation& interpretation) {
  if (refused.code != Code::G411 && refused.code != Code::G412 && refused.code != Code::G418)
    return false;
  const auto step = std::ranges::find(plan.steps, refused.feature, &Step::feature);
  return is_unnamed(refused.feature, interpretation) ||
         (step != plan.steps.end() && is_for_size(*step));
}

Checked<Generalised> generalise(const Solid& solid, const Segmentation& segmentation,
                                const FeatureTable& table, const Interpretation& interpretation,
                                const Plan& plan, const SegmentOptions& options,
                                const Invariants& invariants) {
  Checked<Generalised> out;
  const std::string target =
      plan.scale > 0 ? fmt::format("1:{}", plan.scale) : std::string("this level of detail");
  CarriedOut done = carry_out(solid, segmentation, plan, options, invariants,
                              pieces_of(plan, table, interpretation));
  // What there was no work left for is told of the building as a whole, by who gave the work.
  for (const CarriedOut::Refused& refusal : done.refused)
    if (refusal.code != Code::E502 && refusal.code != Code::none)
      out.issues.push_back(
          refusal_issue(refusal, segmentation, table, interpretation, plan, target));
  for (const AlongFeature& one : done.along)
    if (!one.reason.empty()) out.issues.push_back(unfollowed_issue(one, table, target));
  if (done.solid.facets.empty() || volume_m3(done.solid) <= 0 || !is_closed(done.solid)) {
    out.issues.push_back(building_issue(
        Severity::error, Code::G402, table.building(),
        fmt::format("no closed solid would be left at {}; it stays unchanged", target)));
    return out;
  }
  out.value = Generalised{
      std::move(done.solid),   std::move(done.removed),   std::move(done.refused),  false,
      std::move(done.changed), std::move(done.uncleared), closing_faces(solid),     {},
      std::move(done.pushed),  std::move(done.along),     std::move(done.following)};
  return out;
}

std::string reason_of(const CarriedOut::Refused& refused, const FeatureTable& table) {
  const auto& [needs, beside] = refused.hindrance;
  std::string text = refused.reason;
  for (std::size_t i = 0; i < std::min(beside.size(), kMostBeside); ++i)
    text += (i == 0 ? ", beside " : ", ") + table.id(beside[i]);
  if (beside.size() > kMostBeside) text += fmt::format(" and {} more", beside.size() - kMostBeside);
  for (std::size_t i = 0; i < needs.size(); ++i)
    text += (i == 0 ? "; it would with " : " or ") + text_of(needs[i]);
  return text;
}

std::vector<FeatureOutcome> feature_outcomes(const Plan& plan, const Generalised& generalised,
                                             const FeatureTable& table,
                                             const Interpretation& interpretation) {
  std::vector<FeatureOutcome> outcomes;
  for (int i = 0; i < static_cast<int>(table.rows()); ++i) {
    const FeatureId id{i};
    FeatureOutcome one;
    one.feature = table.id(id);
    one.label = interpretation.verdicts[id.index()].label;
    const auto step = std::ranges::find(plan.steps, id, &Step::feature);
    const auto refused = std::ranges::find(generalised.refused, id, &CarriedOut::Refused::feature);
    if (step != plan.steps.end()) {
      one.operation = step->operation;
      one.rule = step->rule;
    }
    if (std::ranges::binary_search(generalised.removed, id)) {
      tell_gone(id, plan, generalised, table, one);
    } else if (std::ranges::binary_search(generalised.changed, id)) {
      tell_changed(id, plan, generalised, table, one);
    } else if (refused != generalised.refused.end()) {
      one.outcome = refused->code == Code::none || is_part(*refused, plan, interpretation)
                        ? "kept"
                        : "refused";
      one.code = refused->code;
      one.reason = reason_of(*refused, table);
      one.needs = refused->hindrance.needs;
      for (const FeatureId other : refused->hindrance.beside) one.beside.push_back(table.id(other));
    } else {
      one.outcome = "kept";
    }
    outcomes.push_back(std::move(one));
  }
  return outcomes;
}

SolidFigures figures_of(const Solid& solid, double least_edge_m) {
  SolidFigures out;
  out.facets = solid.facets.size();
  std::set<std::array<std::int64_t, 3>> normals;
  std::size_t half_edges = 0;
  for (const Facet& facet : solid.facets) {
    normals.insert(solid.planes[facet.plane.index()].coefficients);
    for (const Loop& loop : facet.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 p = solid.vertices[static_cast<std::size_t>(loop[i])].point;
        const Vec3 q = solid.vertices[static_cast<std::size_t>(loop[(i + 1) % loop.size()])].point;
        if (length(q - p) < least_edge_m) ++half_edges;
      }
  }
  out.normals = normals.size();
  out.short_edges = half_edges / 2;  // each edge is met from two facets
  const Measures measures = measures_of(solid);
  out.volume_m3 = measures.volume_m3;
  out.footprint_m2 = measures.footprint_m2;
  return out;
}

}  // namespace oriel
