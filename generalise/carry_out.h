#pragma once

#include "generalise/invariants.h"
#include "kernel/model/plan.h"
#include "kernel/segment/remove.h"

#include <vector>

namespace oriel {

/// A building after the steps of a plan.
struct CarriedOut {
  Solid solid;
  /// The features that are gone, ascending.
  std::vector<FeatureId> removed;
  /// Steps that were not carried out, by feature, each with its code.
  struct Refused {
    FeatureId feature;
    std::string code;
    std::string reason;
  };
  std::vector<Refused> refused;
  /// Features that look different now; they are not among the removed. Ascending.
  std::vector<FeatureId> changed{};
};

/// Carries out the steps of a plan on its solid, one operator after the other, and takes back, one
/// by one, the steps by which an invariant would break (G405), or something would
/// hang in the air (G411). Which one that is, is found by halving: the last of the fewest first
/// steps that break it.
CarriedOut carry_out(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
                     const SegmentOptions& options, const Invariants& invariants = {});

}  // namespace oriel
