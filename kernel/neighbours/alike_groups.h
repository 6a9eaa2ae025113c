#pragma once

#include "kernel/neighbours/footprint_union.h"
#include "kernel/neighbours/kept_ground.h"
#include "kernel/neighbours/neighbours.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace oriel {

/// Which buildings become one.
struct GroupingLimits {
  /// Gaps that are narrower are closed, m.
  double gap_m = 0;
  /// Roofs of two that adjoin differ by no more in their mean height, m.
  double like_height_m = 3;
  /// A gap is closed only where it covers nothing of it. Null: nothing is kept free.
  const KeptGround* kept = nullptr;
};

/// Buildings that adjoin each other.
struct AlikeGroup {
  /// Positions in NeighbourSearch::buildings(), ascending, two at least.
  std::vector<std::size_t> members;
  /// The ground that they cover, and the gaps between them: outlines in the frame of the first
  /// member, the largest area first. One area, unless the group falls apart.
  std::vector<detail::PlanArea> areas;
  double ground_m2 = 0;  ///< of the members alone
  /// z in the frame of the first member: of the lowest ground, and the mean of the roofs by area.
  double ground_m = 0, roof_m = 0;
  /// Where the roofs of members with more than half of the ground have parallel ridges: their
  /// heights are means by ground, in the frame of the first member.
  std::optional<GabledRoof> gable{};
  double grid_m = 0;         ///< what all corners and heights are whole multiples of
  std::int64_t used_up = 0;  ///< the work budget that uniting the areas used up; 0: they are united
};

/// What adjoins, and what does not though it touches.
struct AlikeGroups {
  /// By their first member.
  std::vector<AlikeGroup> groups;
  /// Buildings that touch, or would by a closed gap, whose roofs differ by more, the lesser first.
  std::vector<std::pair<std::size_t, std::size_t>> unlike;
  /// Buildings between which a gap stays open because of ground that is to be kept free, likewise.
  std::vector<std::pair<std::size_t, std::size_t>> kept_apart{};
};

/// Groups of buildings that adjoin, directly or by others: they touch, or stand across a gap that
/// is to be closed, and their roofs are alike in height. A gap is closed by the strip between two
/// walls that face each other (detail::gaps_between), unless a third building stands in it or it is
/// to be kept free.
/// Outlines have corners on the grid of 1 mm, if all corners of the members are, or of 1
/// micrometre.
AlikeGroups alike_groups(const NeighbourSearch& search, const GroupingLimits& limits);

}  // namespace oriel
