#pragma once

#include "generalise/context.h"
#include "generalise/generalised.h"
#include "model/plan.h"

#include <map>

namespace oriel {

/// What the step takes off may turn out to be a piece of something larger: it goes for its size
/// only, or has no name.
bool is_piece(const Step& step, const Interpretation& interpretation);

/// Carries out the steps of a plan on its solid, one operator after the other, and takes steps back
/// where something is violated that must hold:
///
/// - What follows an opening (Step::follows) goes where that violates something, or draws an edge
///   that is too short, before the step itself is taken back.
/// - An invariant (G405; G411 if something would hang in the air, G412 if the building would reach
///   out of its box): the first step that violates it, found by bisection, and so on until none is
///   violated.
/// - A piece that carries what it is a piece of does not go without that, if it may stay (G411).
/// - What an operator draws with an edge that is too short is taken back, with all that it draws
///   together (G403).
/// - A piece is torn off if a new edge that is too short arises at it, no longer than the piece is
///   thin, and belongs to something thin that stays or to what carries the piece, or if an edge of
///   the body arises within it: its step is taken back, if it may stay (G418).
///
/// Once RedrawContext::work is used up, what was taken off by then is kept if nothing is violated;
/// else nothing is carried out. The rest is refused (E502).
///
/// Of the new edges that are still too short those are cleared that can be (clear_edges), except
/// those of parts that stay as they were (without_whole_edges).
Generalised carry_out(const RedrawContext& context, const Plan& plan);

/// Carries out steps without looking at invariants: first all features of all steps are taken off
/// at once, then those operators that leave something put it in their place, in the order of the
/// features; what moves facets (flatten) and outlines come last. What cannot be taken off (G401) or
/// put back (G403) is left as it was, and the rest is done again without it: no feature is ever
/// half changed. Steps for groups are carried out together or not at all, but for those of which
/// some may stay (OperatorScope::wall). Openings that are in the way of one that is enlarged are
/// moved aside with it (pushes_of); where they have no room, it grows less. Last, what belongs to
/// openings follows them (Step::follows), or goes where it cannot. `hindrances`
/// keeps what hinders operators, by feature, from the first time that they are refused.
Generalised carry_out_steps(const RedrawContext& context, const Plan& plan,
                            std::map<FeatureId, Hindrance>& hindrances);

/// The solid as it is, all steps refused as the work budget is used up (E502).
Generalised nothing_carried_out(const RedrawContext& context, const Plan& plan);

}  // namespace oriel
