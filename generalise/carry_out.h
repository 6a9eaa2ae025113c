#pragma once

#include "generalise/invariants/invariants.h"
#include "kernel/base/code.h"
#include "kernel/model/plan.h"
#include "kernel/segment/remove.h"

#include <vector>

namespace oriel {

/// An edge that is new and too short, of a part that changed, and why it could not be cleared.
struct UnclearedEdge {
  Vec3 from, to;
  std::string reason;
};

/// A building after the steps of a plan.
struct CarriedOut {
  Solid solid;
  /// The features that are gone, ascending.
  std::vector<FeatureId> removed;
  /// Steps that were not carried out, by feature, each with its code.
  struct Refused {
    FeatureId feature;
    Code code = Code::none;
    std::string reason;
  };
  std::vector<Refused> refused;
  /// Features that look different now; they are not among the removed. Ascending.
  std::vector<FeatureId> changed{};
  std::vector<UnclearedEdge> uncleared{};
};

/// What may be a piece of something larger: a plinth, the eaves, a parapet.
struct Pieces {
  /// What is to be taken off for its size, or has no name. Ascending.
  std::vector<FeatureId> may_stay;
  /// By feature its shortest extent, the paper's c; infinite where it is not known.
  std::vector<double> c_m;
};

/// Carries out the steps of a plan on its solid, one operator after the other, and takes back, one
/// by one, the steps by which an invariant would break (G405), or something would
/// hang in the air (G411). Which one that is, is found by halving: the last of the fewest first
/// steps that break it. A piece that carries what it is a piece of does not go without that, if it
/// may stay (G411). What an operator draws with an edge that is too short is taken back as well
/// (G403), with all that it draws together. A piece is torn off what it runs on into if a new edge
/// that is too short arises at it, no longer than the piece is thin, and belongs to something thin
/// that stays or to what carries the piece, or if an edge of the body arises within it: then its
/// step is taken back, if it may stay (G418). Of new edges that are too short all the same those
/// are cleared that can be (clear_edges), but for those of parts that stay as they were
/// (without_whole_edges).
CarriedOut carry_out(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
                     const SegmentOptions& options, const Invariants& invariants = {},
                     const Pieces& pieces = {});

}  // namespace oriel
