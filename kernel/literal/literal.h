#pragma once

#include "kernel/base/work.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace oriel {

/// The paper's ways to try fewer combinations of planes (section 4), each on or off, and one of
/// oriel's.
struct Heuristics {
  /// "The first step is to use only one split-plane at a time, and only if there is no result then
  /// two planes or more will be used." Off: every body is tested with all combinations of one to
  /// four planes, and the best of all features is taken.
  bool fewest_planes_first = true;
  /// "Only parts with a value smaller than one (v < 1) are considered as valid." Off: with any.
  bool values_below_one = true;
  /// "Only combinations of planes with different normals are possible." Off: parallel planes with
  /// the same orientation are combined, too.
  bool different_normals = true;
  /// "If some features are found with the same split-planes and the same value, they all can be
  /// separated at the same time." Off: one a recursion.
  bool equal_features_together = true;
  /// Not in the paper, which tests all planes of the convex chimney: a body without reflex edge is
  /// a leaf, and nothing of it is tested.
  bool convex_bodies_untested = false;
};

/// What one recursion did: one body, which becomes a leaf or a node.
struct LiteralStep {
  /// Oriented planes of the body.
  int planes = 0;
  /// Combinations of 1, 2, 3 and 4 of them that there are…
  std::array<std::int64_t, 4> combinations{};
  /// …and those that were tested.
  std::array<std::int64_t, 4> tested{};
  std::int64_t protrusion_tests = 0;
  std::int64_t hole_tests = 0;
  /// Features that were found and given a value.
  std::int64_t evaluated = 0;
  /// Planes of the cut: 1…4; 0 where cavities or several lumps are separated, untested; -1 of a
  /// leaf.
  int cut = -1;
  bool is_hole = false;
  /// The quality value of the best feature.
  double value = 0;
  /// Features that were separated.
  int parts = 0;
};

/// What the paper's algorithm did to one body.
struct LiteralCount {
  /// In the order of the recursion: a body, then what is left of it with all that follows, then its
  /// features.
  std::vector<LiteralStep> steps;
  std::size_t leaves = 0;
  std::size_t inner = 0;
  /// True: the budget was used up, and all counts are of what was done until then.
  bool is_used_up = false;

  /// The numbers of all steps added up; its cut, kind and value are those of no step.
  [[nodiscard]] LiteralStep sum() const;
};

/// Runs the algorithm of the paper (Thiemann & Sester 2004, section 4) on a solid as it is written
/// there, combination by combination, and counts. Slow and plain; it shares no code with segment()
/// and is no part of it.
///
/// Where the paper is silent (docs/segmentation.md): a feature must have new area in each of its
/// planes; the wall of a hole must hold a reflex edge of the body (without this a plain gabled
/// house is filled up without end); a value is below one, and features of one test are separated
/// together, within `tolerances.value_rel`; of values that tie (Tolerances::tie_rel) holes come
/// first, then the larger volume, then the order of the planes; several lumps are separated first,
/// then cavities, without a test; a body that came before on its path is a leaf.
///
/// `budget`: a step is a combination, or a look at a region of space in it. Same everywhere.
///
/// One count for each of `heuristics`, each with that budget, and as much for what they share; if
/// that is used up, all of them are empty.
std::vector<LiteralCount> count_literally(const Solid& solid,
                                          std::span<const Heuristics> heuristics,
                                          const Tolerances& tolerances = {},
                                          std::int64_t budget = kWorkBudget);
LiteralCount count_literally(const Solid& solid, const Heuristics& heuristics,
                             const Tolerances& tolerances = {}, std::int64_t budget = kWorkBudget);

}  // namespace oriel
