#pragma once

#include "generalise/invariants/invariants.h"
#include "generalise/needs.h"
#include "kernel/base/code.h"
#include "kernel/segment/remove.h"
#include "model/plan.h"

#include <vector>

namespace oriel {

/// An edge that is new and too short, of a part that changed, and why it could not be cleared.
struct UnclearedEdge {
  Vec3 from, to;
  std::string reason;
};

/// An opening that was moved aside, and the feature that it made room for.
struct PushedFeature {
  FeatureId feature, by;
};

/// A feature that is gone without a step that removes it, and the one that it went along with: what
/// it belongs to (Step::with), what stands for it in its row, or what it is on or in.
struct AlongFeature {
  FeatureId feature, with;
  /// Why it could not follow what it belongs to (Step::follows), and what it would come too near
  /// to; empty: it was not to follow.
  std::string reason{};
  std::vector<FeatureId> beside{};
};

/// What belongs to an opening and was drawn again with it (Step::follows).
struct FollowingFeature {
  FeatureId feature, with;
  Belonging belonging = Belonging::moves;
  Box box{};  ///< where it is now
};

/// A building after the steps of a plan.
struct CarriedOut {
  Solid solid;
  /// The features that are gone, ascending.
  std::vector<FeatureId> removed;
  /// Steps that were not carried out, by feature, each with its code; Code::none: the feature is
  /// as its operator wants it already.
  struct Refused {
    FeatureId feature;
    Code code = Code::none;
    std::string reason;
    Hindrance hindrance{};
  };
  std::vector<Refused> refused;
  /// Features that look different now; they are not among the removed. Ascending.
  std::vector<FeatureId> changed{};
  std::vector<UnclearedEdge> uncleared{};
  /// Those of the changed that have no step: openings that made room.
  std::vector<PushedFeature> pushed{};
  /// Those of the removed that went along with others; by feature.
  std::vector<AlongFeature> along{};
  /// Those of the changed that moved or grew with others; by feature.
  std::vector<FollowingFeature> following{};
};

/// Features that may be pieces of something larger: a plinth, the eaves, a parapet.
struct Pieces {
  /// What is to be taken off for its size, or has no name. Ascending.
  std::vector<FeatureId> may_stay;
  /// By feature its shortest extent, the paper's c; infinite where it is not known.
  std::vector<double> c_m;
};

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
/// Once Invariants::work is used up, what was taken off by then is kept if nothing is violated;
/// else nothing is carried out. The rest is refused (E502).
///
/// Of the new edges that are still too short those are cleared that can be (clear_edges), except
/// those of parts that stay as they were (without_whole_edges).
CarriedOut carry_out(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
                     const SegmentOptions& options, const Invariants& invariants = {},
                     const Pieces& pieces = {});

/// Carries out steps without looking at invariants: first all features of all steps are taken off
/// at once, then those operators that leave something put it in their place, in the order of the
/// features; what moves facets (flatten) and outlines come last. What cannot be taken off (G401) or
/// put back (G403) is left as it was, and the rest is done again without it: no feature is ever
/// half changed. Steps for groups are carried out together or not at all, but for those of which
/// some may stay (Operator::takes_some). Openings that are in the way of one that is enlarged are
/// moved aside with it (pushes_of); where they have no room, it grows less. Last, what belongs to
/// openings follows them (Step::follows), or goes where it cannot. `validator` as omit() takes it.
CarriedOut carry_out_steps(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
                           const SegmentOptions& options, const SolidValidator& validator);

/// The solid as it is, all steps refused as the work budget is used up (E502).
CarriedOut nothing_carried_out(const Solid& solid, const Plan& plan);

}  // namespace oriel
