#include "generalise/generalise.h"

#include "generalise/carry_out.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

Issue refusal_issue(const RedrawContext& context, const Plan& plan, const RefusedStep& refusal,
                    const std::string& target) {
  const FeatureTable& table = context.table;
  const std::string reason = reason_of(refusal, table);
  const FeatureId id = refusal.feature, parent = context.feature(id).parent;
  if (is_part(refusal, plan, context.interpretation))
    return context.issue(
        Severity::note, refusal.code, id,
        fmt::format("is a part of the building and stays at {}: without it {}", target, reason));
  if (parent.is_valid() && context.interpretation.verdicts[id.index()].label.empty())
    return context.issue(Severity::note, refusal.code, id,
                         fmt::format("is a piece of {} and stays with it at {}: {}",
                                     table.id(parent), target, reason));
  return context.issue(
      Severity::warning, refusal.code, id,
      fmt::format("is not {} at {}: {}", refusal.code == Code::G403 ? "changed" : "omitted", target,
                  reason));
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

bool is_part(const RefusedStep& refused, const Plan& plan, const Interpretation& interpretation) {
  if (refused.code != Code::G411 && refused.code != Code::G412 && refused.code != Code::G418)
    return false;
  const auto step = std::ranges::find(plan.steps, refused.feature, &Step::feature);
  return is_piece(step == plan.steps.end() ? Step{refused.feature, {}, {}} : *step, interpretation);
}

Checked<Generalised> generalise(const RedrawContext& context, const Plan& plan) {
  Checked<Generalised> out;
  const std::string target =
      plan.scale > 0 ? fmt::format("1:{}", plan.scale) : std::string("this level of detail");
  Generalised done = carry_out(context, plan);
  // What there was no work left for is told of the building as a whole, by who gave the work.
  for (const RefusedStep& refusal : done.refused)
    if (refusal.code != Code::E502 && refusal.code != Code::none)
      out.issues.push_back(refusal_issue(context, plan, refusal, target));
  for (const AlongFeature& one : done.along)
    if (!one.reason.empty())
      out.issues.push_back(
          context.issue(Severity::note, Code::G424, one.feature,
                        fmt::format("goes along with {} at {}, as it cannot follow: {}",
                                    context.table.id(one.with), target, one.reason)));
  if (done.solid.facets.empty() || volume_m3(done.solid) <= 0 || !is_closed(done.solid)) {
    out.issues.push_back(context.issue(
        Severity::error, Code::G402, {},
        fmt::format("no closed solid would be left at {}; it stays unchanged", target)));
    return out;
  }
  done.closing = closing_faces(context.solid);
  out.value = std::move(done);
  return out;
}

std::string reason_of(const RefusedStep& refused, const FeatureTable& table) {
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
    const auto refused = std::ranges::find(generalised.refused, id, &RefusedStep::feature);
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
