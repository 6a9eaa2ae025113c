#pragma once

#include "kernel/base/code.h"
#include "model/plan.h"
#include "model/solid.h"

#include <string>
#include <vector>

namespace oriel {

/// A change that would let a refused operator act.
struct Need {
  /// What would have to be less: "gap" or "to", an argument of the operator, in metres; "ratio",
  /// the share that stays; "count", how many features there are.
  std::string what;
  /// By how much.
  double less = 0;
  /// What it would be then: in metres, a share, or a count.
  double then = 0;
};

/// What stands in the way of an operator that was refused, as far as it is known.
struct Hindrance {
  /// Each would do by itself; those of the least change first.
  std::vector<Need> needs{};
  /// Features that it would come too near to.
  std::vector<FeatureId> beside{};
};

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

/// A face of a solid that oriel closed a hole with: no polygon of the input lies in it.
struct ClosingFace {
  Plane plane;
  std::vector<std::vector<Vec3>> outlines;
};

/// A step that was not carried out, and why; Code::none: the feature is as its operator wants it
/// already.
struct RefusedStep {
  FeatureId feature;
  Code code = Code::none;
  std::string reason;
  Hindrance hindrance{};
};

/// A building after the steps of a plan: all that the log of a series, reports of changes, figures
/// and refusals are read from.
struct Generalised {
  /// Closed; what was taken off leaves no seams.
  Solid solid;
  /// The features that are gone: those of the plan and all that sat on them. Ascending.
  std::vector<FeatureId> removed;
  /// Steps of the plan that were not carried out, by feature.
  std::vector<RefusedStep> refused{};
  /// To be drawn even if nothing is gone: its own solid instead of the input's polygons.
  bool is_drawn_anew = false;
  /// Features that look different now; they are not among the removed. Ascending.
  std::vector<FeatureId> changed{};
  std::vector<UnclearedEdge> uncleared{};
  /// Of the solid that it was made from.
  std::vector<ClosingFace> closing{};
  /// Those of the changed that have no step: openings that made room.
  std::vector<PushedFeature> pushed{};
  /// Those of the removed that went along with others; by feature.
  std::vector<AlongFeature> along{};
  /// Those of the changed that moved or grew with others; by feature.
  std::vector<FollowingFeature> following{};
};

}  // namespace oriel
